// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/attitude_control.hpp"

#include <cmath>

namespace limpet::autopilot {
namespace {

/// Thrust axes closer to opposite than this have no shortest turn between them.
constexpr double kOpposite = 1e-6;
/// Below this weight the heading is not controlled at all.
constexpr double kNoYaw = 1e-4;

/// The attitude nearest to q_WB whose thrust axis is that of the target.
Quaternion reduced_target(const Quaternion& q_WB, const Quaternion& q_WB_target) {
    const Vector3 z = q_WB * Vector3::UnitZ();
    const Vector3 z_target = q_WB_target * Vector3::UnitZ();
    const double w = 1.0 + z.dot(z_target);
    if (w < kOpposite) {
        return q_WB_target;
    }
    const Vector3 axis = z.cross(z_target);
    return Quaternion(w, axis.x(), axis.y(), axis.z()).normalized() * q_WB;
}

/// The target with only `weight` of the turn about the thrust axis that it needs.
Quaternion weighted_target(const Quaternion& q_WB, const Quaternion& q_WB_target, double weight) {
    const Quaternion q_WR = reduced_target(q_WB, q_WB_target);
    const Quaternion q_RT = q_WR.conjugate() * q_WB_target;  // a turn about z alone
    const double sign = q_RT.w() < 0.0 ? -1.0 : 1.0;
    const double half_turn_rad = weight * std::atan2(sign * q_RT.z(), sign * q_RT.w());
    return q_WR * Quaternion(std::cos(half_turn_rad), 0.0, 0.0, std::sin(half_turn_rad));
}

}  // namespace

Vector3 attitude_control(const AutopilotParameters& parameters, const Quaternion& q_WB,
                         const Quaternion& q_WB_target) {
    const double weight = parameters.MC_YAW_WEIGHT;
    const Quaternion q_error =
        q_WB.conjugate() * weighted_target(q_WB, q_WB_target, weight > kNoYaw ? weight : 0.0);
    const Vector3 error = (q_error.w() < 0.0 ? -2.0 : 2.0) * q_error.vec();
    // the weight shrinks a pure heading error too; its gain makes up for that
    const Vector3 gain(parameters.MC_ROLL_P, parameters.MC_PITCH_P,
                       weight > kNoYaw ? parameters.MC_YAW_P / weight : 0.0);
    const Vector3 limit_rad_s(radians(parameters.MC_ROLLRATE_MAX),
                              radians(parameters.MC_PITCHRATE_MAX),
                              radians(parameters.MC_YAWRATE_MAX));
    return error.cwiseProduct(gain).cwiseMax(-limit_rad_s).cwiseMin(limit_rad_s);
}

}  // namespace limpet::autopilot
