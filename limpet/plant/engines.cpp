// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/engines.hpp"

#include <array>

namespace limpet::plant {

std::span<const Engine* const> engines() {
    static constexpr std::array kEngines = {
        &kReducedEngine,
        &kMujocoEngine,
    };
    return kEngines;
}

}  // namespace limpet::plant
