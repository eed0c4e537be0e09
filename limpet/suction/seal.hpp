// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/suction/surface.hpp"

namespace limpet::suction {

/// What this touch needs in order to seal: drawn when the lip meets the wall, because roughness and
/// the spot that is hit differ from touch to touch (paper, section II.D).
struct SealDemand {
    double threshold_N = 0.0;     ///< press force to pass
    double tilt_limit_rad = 0.0;  ///< tilt to stay below
};

[[nodiscard]] SealDemand draw_seal_demand(const Surface& surface, RandomStream& random);

/// @param press_N   force that presses the cup on the wall through its mechanism, > 0 presses [N]
/// @param tilt_rad  angle between the lip's plane and the wall, >= 0 [rad]
[[nodiscard]] bool seals(const SealDemand& demand, double press_N, double tilt_rad);

}  // namespace limpet::suction
