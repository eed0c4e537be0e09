// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace limpet {

/// The user's input cannot be used: one line that names file:line, key, value and what is allowed.
/// The command line turns it into exit code 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A program or a library that is not on this machine: one line that names the package. Who can do
/// without says it and goes on.
class NotInstalled : public InputError {
public:
    using InputError::InputError;
};

/// A fault of ours: a broken promise between two modules. The command line turns it into exit
/// code 70.
class InternalError : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// Ctrl-C or SIGTERM before there was anything to conclude; one line that says what was going on.
/// The command line turns it into exit code 130.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Always-armed check of a programmer's promise.
/// @throws InternalError naming the place when `holds` is false
inline void require(bool holds, const char* promise, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) {
    if (!holds) [[unlikely]] {
        throw InternalError(std::string(file) + ":" + std::to_string(line) +
                            ": broken promise: " + promise);
    }
}

/// The value of an answer that may be none, where the caller's input always has one.
/// @throws InternalError naming the place when there is none
template <class T>
[[nodiscard]] T required(std::optional<T> answer, const char* promise,
                         const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    require(answer.has_value(), promise, file, line);
    return *std::move(answer);
}

}  // namespace limpet
