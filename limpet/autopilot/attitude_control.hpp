// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

/// Attitude error to body rates: proportional in the quaternion's error, tilt before heading. No
/// Euler angles, so that a vehicle that hangs nose up is like any other.
/// @param q_WB         unit quaternion
/// @param q_WB_target  unit quaternion
/// @return rates to fly, in B, within the MC_*RATE_MAX [rad/s]
/// Source: Brescianini, Hehn, D'Andrea, "Nonlinear quadrocopter attitude control", ETH 2013; PX4
/// AttitudeControl @305966ee.
[[nodiscard]] Vector3 attitude_control(const AutopilotParameters& parameters,
                                       const Quaternion& q_WB, const Quaternion& q_WB_target);

}  // namespace limpet::autopilot
