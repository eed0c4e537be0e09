// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/estimator.hpp"
#include "limpet/core/signals/consistency.hpp"
#include "limpet/core/signals/kinematics.hpp"

namespace limpet::autopilot {

/// Truth less belief, in the filter's order: attitude as a rotation vector in B.
/// @param truth  of the base when the filter's last IMU sample was taken
/// @param gyro_bias_rad_s, accelerometer_bias_m_s2  of the sensors then
[[nodiscard]] ErrorVector error_of(const EstimatorState& filter, const Kinematics& truth,
                                   const Vector3& gyro_bias_rad_s,
                                   const Vector3& accelerometer_bias_m_s2);

/// How honest the filter is, at an instant to which it has just brought its covariance.
[[nodiscard]] Consistency consistency_of(const AutopilotParameters& parameters,
                                         const EstimatorState& filter, const ErrorVector& error);

}  // namespace limpet::autopilot
