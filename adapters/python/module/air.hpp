// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "module.hpp"

namespace limpet::python {

/// The interpreter ends: whoever flies comes down. Becomes Python's SystemExit.
struct InterpreterEnds {};

/// This thread will let go of the GIL and take it again. While the interpreter is torn down it ends
/// whoever takes it, through frames that may not be left so; so it waits at its exit, a minute at
/// most, until nobody is in the air (add_air), and nobody takes off any more.
class InTheAir {
public:
    /// With the GIL.
    /// @throws InterpreterEnds
    InTheAir();
    ~InTheAir();
    InTheAir(const InTheAir&) = delete;
    InTheAir& operator=(const InTheAir&) = delete;
};

/// The same, and Python goes on meanwhile.
class FlyFreely {
private:
    InTheAir in_the_air_;
    py::gil_scoped_release released_;
};

/// Registers what waits for them, and what becomes of InterpreterEnds.
void add_air();

/// @return whether those in the air are to come down; asked often, without the GIL
[[nodiscard]] bool interpreter_ends();

}  // namespace limpet::python
