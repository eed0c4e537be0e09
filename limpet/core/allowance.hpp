// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "limpet/core/errors.hpp"

namespace limpet {

/// An allowance is used up: the file as a whole is not read.
struct TooMuch : InputError {
    using InputError::InputError;
};

/// Messages within messages: a definition that goes deeper is one that was made to harm.
inline constexpr int kMostLevels = 16;
/// Characters of a field, of a topic where it becomes a column's or a table's name.
inline constexpr std::size_t kLongestFieldName = 128;

/// What one file of others' may take, all its parts together: memory and time. A reader makes one
/// for a file and hands it to all that read a part of it; each takes its share before it keeps or
/// looks at something. All takes throw TooMuch, "more than ALLOWED WHAT".
class Allowance {
public:
    /// @param bytes  kept in memory
    explicit Allowance(std::uint64_t bytes = 256'000'000)
        : bytes_{"MB in memory", bytes, 1'000'000} {}

    /// Kept in memory: values, names, and what keeps them.
    void take_bytes(std::uint64_t count) { bytes_.take(count); }
    /// Columns, and messages within messages: what takes no column takes time.
    void take_fields(std::uint64_t count) { fields_.take(count); }
    /// Text of message definitions, each time that it is gone through.
    void take_definition(std::uint64_t bytes) { definitions_.take(bytes); }

private:
    struct Share {
        const char* what;
        std::uint64_t most;
        std::uint64_t unit = 1;
        std::uint64_t taken = 0;

        void take(std::uint64_t count) {
            if (count > most - taken) {
                throw TooMuch("more than " + std::to_string(most / unit) + " " + what);
            }
            taken += count;
        }
    };
    Share bytes_;
    Share fields_ = {"fields in its messages", 100'000};
    Share definitions_ = {"bytes of message definitions", 4'000'000};
};

}  // namespace limpet
