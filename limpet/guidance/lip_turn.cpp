// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/lip_turn.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::guidance {
namespace {

Vector3 level_right_W(const Vector3& into_wall_W) {
    return {-into_wall_W.y(), into_wall_W.x(), 0.0};
}

}  // namespace

double lip_turn_rad(const Vector3& into_wall_W, const Quaternion& q_WB) {
    // The joint bends first about the vehicle's y, then about the cup's z, until its x is n.
    const Vector3 n_B = q_WB.conjugate() * into_wall_W;
    const double aside = std::clamp(n_B.y(), -1.0, 1.0);
    const double straight = std::sqrt(1.0 - aside * aside);
    const double down_rad = std::atan2(-n_B.z(), n_B.x());
    const Vector3 right_B(-aside * std::cos(down_rad), straight, aside * std::sin(down_rad));
    const Vector3 right_W = q_WB * right_B;
    return std::atan2(right_W.z(), level_right_W(into_wall_W).dot(right_W));
}

double pitch_on_lip_rad(const Vector3& into_wall_W, const Quaternion& q_WB) {
    const Vector3 n_B = q_WB.conjugate() * into_wall_W;
    return std::atan2(n_B.z(), n_B.x());
}

Vector3 right_of_lip_W(const Vector3& into_wall_W, double turn_rad) {
    return std::cos(turn_rad) * level_right_W(into_wall_W) + Vector3(0.0, 0.0, std::sin(turn_rad));
}

Quaternion attitude_on_lip(double heading_rad, double turn_rad, double pitch_rad, double roll_rad) {
    if (turn_rad == 0.0) {
        return quaternion_from_euler(
            {.roll_rad = roll_rad, .pitch_rad = pitch_rad, .yaw_rad = heading_rad});
    }
    return quaternion_from_euler({.roll_rad = turn_rad, .yaw_rad = heading_rad}) *
           quaternion_from_euler({.roll_rad = roll_rad, .pitch_rad = pitch_rad});
}

}  // namespace limpet::guidance
