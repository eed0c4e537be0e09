// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>

#include "limpet/core/words.hpp"

namespace limpet::remarks {

/// A number as a person writes one that is not exact: 480, 0.035, not 4.8e+02.
[[nodiscard]] inline std::string about(double value, int digits = 2) {
    const std::string rounded = fmt::format("{:.{}g}", value, digits);
    return fmt::format("{}", number_of(rounded).value_or(value));
}

}  // namespace limpet::remarks
