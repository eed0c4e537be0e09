// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/seal.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::suction {
namespace {

double normal_cdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

/// 0 and 1 where there is no spread
double cdf(double value, double median, double sigma) {
    if (sigma <= 0.0) {
        return value > median ? 1.0 : 0.0;
    }
    return normal_cdf((value - median) / sigma);
}

}  // namespace

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

double seal_probability(const Surface& surface, double press_N, double tilt_rad) {
    if (press_N <= 0.0) {
        return 0.0;
    }
    const double force = cdf(std::log(press_N), std::log(surface.seal_threshold_median_N),
                             surface.seal_threshold_sigma);
    const double tilt =
        1.0 - cdf(degrees(tilt_rad), surface.seal_tilt_median_deg, surface.seal_tilt_sigma_deg);
    return force * tilt;
}

}  // namespace limpet::suction
