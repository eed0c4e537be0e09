// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/seal.hpp"

#include <algorithm>

namespace limpet::suction {

SealDemand draw_seal_demand(const Surface& surface, RandomStream& random) {
    SealDemand demand;
    demand.threshold_N =
        random.lognormal(surface.seal_threshold_median_N, surface.seal_threshold_sigma);
    demand.tilt_limit_rad = radians(std::max(
        0.0, surface.seal_tilt_median_deg + surface.seal_tilt_sigma_deg * random.normal()));
    return demand;
}

bool seals(const SealDemand& demand, double press_N, double tilt_rad) {
    return press_N > demand.threshold_N && tilt_rad < demand.tilt_limit_rad;
}

}  // namespace limpet::suction
