// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet {

/// The value of an answer that may be none, where the caller's input always has one.
/// @throws InternalError naming the place when there is none
template <class T>
[[nodiscard]] T required(std::optional<T> answer, const char* promise,
                         const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    require(answer.has_value(), promise, file, line);
    return *std::move(answer);
}

}  // namespace limpet
