// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/wall_angle.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::guidance {

double wall_angle(double left_m, double right_m, double separation_m) {
    return std::atan((left_m - right_m) / separation_m);
}

Vector3 WallSeen::into_wall_W() const {
    return {std::cos(heading_rad), std::sin(heading_rad), 0.0};
}

double WallSeen::distance_m(const PerchingParameters& parameters, const Vector3& p_WB_m) const {
    return offset_m - into_wall_W().dot(p_WB_m) - parameters.lidar_x_m;
}

namespace {

/// How the vehicle stood.
struct Stand {
    Vector3 p_WB_m;
    Euler attitude;
};

/// @param time_s  when the echoes were taken: before guidance receives them, and not when the pose
/// was
Stand stand_at(const Estimate& estimate, double time_s) {
    constexpr double kFar_s =
        0.1;  // no LiDAR is later; beyond it a fault of the clocks, no setting
    const double ahead_s = std::clamp(time_s - (estimate.time_s - estimate.age_s), -kFar_s, kFar_s);
    const Quaternion q_BS = quaternion_from_rotation_vector(ahead_s * estimate.w_WB_B_rad_s);
    return {estimate.p_WB_m + ahead_s * estimate.v_WB_m_s,
            euler_from_quaternion(estimate.q_WB * q_BS)};
}

}  // namespace

void see_wall(const PerchingParameters& parameters, WallSeen& wall, const Readings& readings,
              const Estimate& estimate) {
    const auto& left = readings.lidar_left;
    const auto& right = readings.lidar_right;
    if (!left.newer_than(wall.time_s) || !right.newer_than(wall.time_s) || !left.value.valid ||
        !right.value.valid) {
        return;
    }
    const double mean_m = 0.5 * (left.value.distance_m + right.value.distance_m);
    if (mean_m > parameters.wall_near_limit_m) {
        return;
    }
    // A pitched vehicle's beams run obliquely: their horizontal part is what counts.
    const double time_s = std::min(left.time_s, right.time_s);
    const auto [p_WB_m, attitude] = stand_at(estimate, time_s);
    const double level = std::cos(attitude.pitch_rad);
    wall.alpha_rad = wall_angle(left.value.distance_m * level, right.value.distance_m * level,
                                parameters.lidar_separation_m);
    const double heading_rad = attitude.yaw_rad + wall.alpha_rad;
    const double ahead_m = (mean_m + parameters.lidar_x_m) * level * std::cos(wall.alpha_rad);

    constexpr double kInstant_s = 1e-9;  // wall_filter_s 0: no filter
    const double dt_s = time_s - wall.time_s;
    const double gain =
        wall.ever ? -std::expm1(-dt_s / std::max(parameters.wall_filter_s, kInstant_s)) : 1.0;
    wall.heading_rad = wrap_pi(wall.heading_rad + gain * wrap_pi(heading_rad - wall.heading_rad));
    const double offset_m = wall.into_wall_W().dot(p_WB_m) + ahead_m;
    wall.offset_m += gain * (offset_m - wall.offset_m);
    wall.time_s = time_s;
    wall.ever = true;
}

}  // namespace limpet::guidance
