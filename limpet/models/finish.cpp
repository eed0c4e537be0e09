// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/finish.hpp"

namespace limpet::models {

Finish finish_of(std::string_view surface) {
    const auto has = [surface](std::string_view word) {
        return surface.find(word) != std::string_view::npos;
    };
    if (has("block") || has("brick")) {
        return Finish::blocks;
    }
    if (has("blade") || has("glass") || has("paint")) {
        return Finish::gel_coat;
    }
    if (has("metal") || has("steel") || has("alumin")) {
        return Finish::steel;
    }
    return Finish::concrete;
}

}  // namespace limpet::models
