// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "module.hpp"

namespace limpet::python {

/// The interpreter ends: flights in progress end too. Becomes Python's SystemExit.
struct InterpreterEnds {};

/// A flight in progress on this thread, which releases the GIL and takes it again. An interpreter
/// that is torn down ends a thread that takes the GIL, without unwinding its frames. So the exit
/// waits until no flight is in progress, a minute at most (add_air), and no flight begins any more.
class InTheAir {
public:
    /// With the GIL.
    /// @throws InterpreterEnds
    InTheAir();
    ~InTheAir();
    InTheAir(const InTheAir&) = delete;
    InTheAir& operator=(const InTheAir&) = delete;
};

/// The same, without the GIL: Python goes on meanwhile.
class FlyFreely {
private:
    InTheAir in_the_air_;
    py::gil_scoped_release released_;
};

/// Registers what waits for them, and what becomes of InterpreterEnds.
void add_air();

/// @return whether flights in progress are to end; called often, without the GIL
[[nodiscard]] bool interpreter_ends();

}  // namespace limpet::python
