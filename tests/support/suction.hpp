// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "limpet/core/frames.hpp"
#include "limpet/suction/pressure.hpp"
#include "limpet/suction/surface.hpp"

/// What follows from the cup's laws and no flight needs.
namespace limpet::suction {

/// How long one airflow takes from one pressure to another, by its first-order law.
/// @return [s]; infinity when the flow never gets there
inline double time_to_pressure_s(const Surface& surface, const FirstOrderParameters& cup,
                                 Airflow flow, double from_Pa, double to_Pa) {
    if (from_Pa == to_Pa) {
        return 0.0;
    }
    constexpr double kLong_s = 1e9, kStep_s = 0.1;
    const double target_Pa = pressure_after(surface, cup, flow, from_Pa, kLong_s);
    const double after_Pa = pressure_after(surface, cup, flow, from_Pa, kStep_s);
    const double constant_s = kStep_s / std::log((from_Pa - target_Pa) / (after_Pa - target_Pa));
    const double ratio = (from_Pa - target_Pa) / (to_Pa - target_Pa);
    return ratio >= 1.0 && std::isfinite(ratio) ? constant_s * std::log(ratio)
                                                : std::numeric_limits<double>::infinity();
}

/// Share of the values that are less, where the spread is normal.
inline double share_below(double value, double median, double sigma) {
    if (sigma <= 0.0) {
        return value > median ? 1.0 : 0.0;
    }
    return 0.5 * std::erfc((median - value) / (sigma * std::sqrt(2.0)));
}

/// Probability that a touch with this press force and tilt seals, over the surface's randomness;
/// the dwell that Fig. 6 also requires is not in it.
inline double seal_probability(const Surface& surface, double press_N, double tilt_rad) {
    if (press_N <= 0.0) {
        return 0.0;
    }
    return share_below(std::log(press_N), std::log(surface.seal_threshold_median_N),
                       surface.seal_threshold_sigma) *
           (1.0 - share_below(degrees(tilt_rad), surface.seal_tilt_median_deg,
                              surface.seal_tilt_sigma_deg));
}

}  // namespace limpet::suction
