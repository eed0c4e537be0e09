// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/wall.hpp"

#include <array>

namespace limpet {

extern const WallShape kCylinderWall;

std::span<const WallShape* const> wall_shapes() {
    static constexpr std::array kShapes = {
        &kPlaneWall,
        &kCylinderWall,
    };
    return kShapes;
}

}  // namespace limpet
