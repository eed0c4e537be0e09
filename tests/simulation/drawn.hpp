// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"

namespace limpet::simulation {

/// What says how a flight is flown, not how it is reckoned.
inline bool is_drawn(const std::string& section, const BoundParameter& row) {
    return section == "guidance" || section == "sensors" || section == "environment" ||
           section == "suction" || section == "wall.surface" || section == "vehicle.battery" ||
           (section == "simulation" && row.name.rfind("start_", 0) == 0);
}

/// Somewhere in the range; by its logarithm where that spans decades, a fault within the flight.
inline double drawn(const BoundParameter& row, RandomStream& random) {
    constexpr double kFlight_s = 60.0;
    constexpr double kDecades = 100.0;
    const double highest = row.name.find("_at_s") != row.name.npos ? kFlight_s : row.maximum;
    const double u = random.uniform();
    const double value = row.minimum > 0.0 && highest > kDecades * row.minimum
                             ? row.minimum * std::pow(highest / row.minimum, u)
                             : row.minimum + (highest - row.minimum) * u;
    return row.value.is_whole() ? std::floor(value) : value;
}

/// Up to a factor of 1.3 either way, within the range.
inline double drawn_nearby(const BoundParameter& row, RandomStream& random) {
    constexpr double kBand = 1.3;
    const double factor = std::pow(kBand, 2.0 * random.uniform() - 1.0);
    return std::clamp(row.value.get() * factor, row.minimum, row.maximum);
}

}  // namespace limpet::simulation
