// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/guidance/parameters.hpp"

namespace limpet::guidance {

/// Angle between the vehicle and the wall.
/// @param left_m        d_1, distance measured by the left LiDAR [m]
/// @param right_m       d_2, by the right one [m]
/// @param separation_m  l, between the two beams, > 0 [m]
/// @return alpha [rad], > 0: turn right to face the wall
/// Source: paper, eq. (7).
[[nodiscard]] double wall_angle(double left_m, double right_m, double separation_m);

/// The wall as the LiDARs saw it, kept in W so that it stays where it is while the vehicle turns:
/// a vertical plane, horizontal n into it, all its points p have n . p = offset_m.
struct WallSeen {
    double time_s = -std::numeric_limits<double>::infinity();  ///< of the last pair of echoes
    double heading_rad = 0.0;                                  ///< of n
    double offset_m = 0.0;
    double alpha_rad = 0.0;  ///< of the last pair, unfiltered
    bool ever = false;

    [[nodiscard]] Vector3 into_wall_W() const;
    /// What the LiDARs would read at p_WB, heading for the wall [m].
    [[nodiscard]] double distance_m(const PerchingParameters& parameters,
                                    const Vector3& p_WB_m) const;
};

/// Takes in a pair of echoes that are new since wall.time_s; a pair with one missing is no pair.
/// Low-passed with wall_filter_s. The pose is brought to the time of the echoes by the estimate's
/// velocity and rate.
void see_wall(const PerchingParameters& parameters, WallSeen& wall, const Readings& readings,
              const Estimate& estimate);

}  // namespace limpet::guidance
