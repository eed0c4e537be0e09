// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace limpet::models {

/// How a wall looks in pictures; the physics do not know it.
enum class Finish {
    concrete,
    blocks,
    gel_coat,
    steel
};

/// By words in the surface's name; concrete when there is none.
[[nodiscard]] Finish finish_of(std::string_view surface);

}  // namespace limpet::models
