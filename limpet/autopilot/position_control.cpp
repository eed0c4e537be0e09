// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/position_control.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::autopilot {
namespace {

using Vector2 = Eigen::Vector2d;

/// Least collective command: the attitude is read off the thrust vector, which must have a length.
constexpr double kLeastThrust = 1e-3;

/// `first` + `second` cut to a length; `first` is cut only when it is too long by itself.
Vector2 constrain_horizontal(const Vector2& first, const Vector2& second, double longest) {
    if ((first + second).norm() <= longest) {
        return first + second;
    }
    if (first.norm() >= longest) {
        return first.normalized() * longest;
    }
    // first + s * direction on the circle of the longest
    const Vector2 direction = second.normalized();
    const double along = direction.dot(first);
    const double s = -along + std::sqrt(along * along + longest * longest - first.squaredNorm());
    return first + s * direction;
}

Vector3 constrain_velocity(const AutopilotParameters& p, const Vector3& first,
                           const Vector3& second) {
    Vector3 velocity;
    velocity.head<2>() = constrain_horizontal(first.head<2>(), second.head<2>(), p.MPC_XY_VEL_MAX);
    velocity.z() = std::clamp(first.z() + second.z(), -p.MPC_Z_VEL_MAX_UP, p.MPC_Z_VEL_MAX_DN);
    return velocity;
}

/// The vertical share is left as it is, the horizontal one is cut to the cone of the tilt limit.
Vector3 limit_tilt(const Vector3& z_B_W, double tilt_rad) {
    const double horizontal = z_B_W.head<2>().norm();
    if (std::atan2(horizontal, z_B_W.z()) <= tilt_rad) {
        return z_B_W;
    }
    const Vector2 direction = z_B_W.head<2>() / horizontal;
    return {std::sin(tilt_rad) * direction.x(), std::sin(tilt_rad) * direction.y(),
            std::cos(tilt_rad)};
}

/// @return thrust vector in W in units of the motor command, up is negative z
Vector3 thrust_from_acceleration(const AutopilotParameters& p, const Vector3& a_m_s2) {
    // the attitude is made for 1 g along the vertical, whatever the vertical acceleration
    const Vector3 wanted = Vector3(-a_m_s2.x(), -a_m_s2.y(), kGravity_m_s2).normalized();
    const Vector3 z_B_W = limit_tilt(wanted, radians(p.MPC_TILTMAX_AIR));
    const double vertical = p.MPC_THR_HOVER * (a_m_s2.z() / kGravity_m_s2 - 1.0);
    const double least = std::max(p.MPC_THR_MIN, kLeastThrust);
    return z_B_W * std::min(vertical / z_B_W.z(), -least);
}

/// Gives the vertical what it demands, less a margin for the horizontal; the horizontal the rest.
Vector3 limit_thrust(const AutopilotParameters& p, const Vector3& thrust) {
    const double largest = p.MPC_THR_MAX;
    const double horizontal = thrust.head<2>().norm();
    const double margin = std::min({horizontal, p.MPC_THR_XY_MARG, largest});
    Vector3 limited = thrust;
    limited.z() = std::max(thrust.z(), -std::sqrt(largest * largest - margin * margin));
    const double left = std::sqrt(std::max(0.0, largest * largest - limited.z() * limited.z()));
    if (horizontal > left) {
        limited.head<2>() *= left / horizontal;
    }
    return limited;
}

/// Error to integrate: none that would drive a saturated output further.
Vector3 unwound_error(const AutopilotParameters& p, const Vector3& error_m_s,
                      const Vector3& a_asked, const Vector3& thrust_asked,
                      const Vector3& thrust_given) {
    Vector3 error = error_m_s;
    const double least = std::max(p.MPC_THR_MIN, kLeastThrust);
    if ((thrust_asked.z() >= -least && error.z() >= 0.0) ||
        (thrust_asked.z() <= -p.MPC_THR_MAX && error.z() <= 0.0)) {
        error.z() = 0.0;
    }
    // tracking anti-windup: Rundqwist, "Anti-reset windup for PID controllers", IFAC 1990
    const Vector2 a_given = thrust_given.head<2>() * (kGravity_m_s2 / p.MPC_THR_HOVER);
    if (p.MPC_XY_VEL_P_ACC > 0.0 && a_asked.head<2>().squaredNorm() > a_given.squaredNorm()) {
        error.head<2>() -= 2.0 / p.MPC_XY_VEL_P_ACC * (a_asked.head<2>() - a_given);
    }
    return error;
}

/// The attitude whose z axis opposes the thrust and whose nose points as near to yaw as it can.
Quaternion attitude_from_thrust(const Vector3& thrust, double yaw_rad) {
    const Vector3 z = -thrust.normalized();
    const Vector3 right(-std::sin(yaw_rad), std::cos(yaw_rad), 0.0);
    const Vector3 x = right.cross(z).normalized();  // z points down: MPC_TILTMAX_AIR < 90 deg
    Matrix3 R_WB;
    R_WB << x, z.cross(x), z;
    return Quaternion(R_WB);
}

}  // namespace

void filter_acceleration(const AutopilotParameters& parameters, PositionControlState& state,
                         const Estimate& estimate, double dt_s) {
    const Vector3 a_W_m_s2 =
        estimate.q_WB * estimate.specific_force_B_m_s2 + Vector3(0.0, 0.0, kGravity_m_s2);
    const double cutoff_rad_s = 2.0 * kPi * parameters.MPC_VELD_LP;
    const bool pass = !state.filtering || cutoff_rad_s <= 0.0;
    const double share = pass ? 1.0 : dt_s * cutoff_rad_s / (1.0 + dt_s * cutoff_rad_s);
    state.acceleration_m_s2 += share * (a_W_m_s2 - state.acceleration_m_s2);
    state.filtering = true;
}

VelocitySetpoint position_control(const AutopilotParameters& parameters,
                                  const PositionSetpoint& target, const Vector3& p_WB_m) {
    const Vector3 gain(parameters.MPC_XY_P, parameters.MPC_XY_P, parameters.MPC_Z_P);
    const Vector3 towards = gain.cwiseProduct(target.p_W_m - p_WB_m);
    return {.v_W_m_s = constrain_velocity(parameters, towards, target.feedforward_v_W_m_s),
            .yaw_rad = target.yaw_rad};
}

AttitudeSetpoint velocity_control(const AutopilotParameters& parameters,
                                  PositionControlState& state, const VelocitySetpoint& target,
                                  const Vector3& v_WB_m_s, bool hold_integrators, double dt_s) {
    const AutopilotParameters& p = parameters;
    const Vector3 gain_p(p.MPC_XY_VEL_P_ACC, p.MPC_XY_VEL_P_ACC, p.MPC_Z_VEL_P_ACC);
    const Vector3 gain_i(p.MPC_XY_VEL_I_ACC, p.MPC_XY_VEL_I_ACC, p.MPC_Z_VEL_I_ACC);
    const Vector3 gain_d(p.MPC_XY_VEL_D_ACC, p.MPC_XY_VEL_D_ACC, p.MPC_Z_VEL_D_ACC);

    const Vector3 error_m_s = constrain_velocity(p, target.v_W_m_s, Vector3::Zero()) - v_WB_m_s;
    const Vector3 a_asked = target.feedforward_a_W_m_s2 + gain_p.cwiseProduct(error_m_s) +
                            state.integral_m_s2 - gain_d.cwiseProduct(state.acceleration_m_s2);
    const Vector3 thrust_asked = thrust_from_acceleration(p, a_asked);
    const Vector3 thrust_given = limit_thrust(p, thrust_asked);
    if (!hold_integrators) {
        const Vector3 error = unwound_error(p, error_m_s, a_asked, thrust_asked, thrust_given);
        state.integral_m_s2 += dt_s * gain_i.cwiseProduct(error);
        state.integral_m_s2.z() =
            std::clamp(state.integral_m_s2.z(), -kGravity_m_s2, kGravity_m_s2);
    }
    return {.q_WB = attitude_from_thrust(thrust_given, target.yaw_rad),
            .thrust = thrust_given.norm()};
}

}  // namespace limpet::autopilot
