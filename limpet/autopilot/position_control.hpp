// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/setpoint.hpp"

namespace limpet::autopilot {

struct PositionControlState {
    Vector3 integral_m_s2 = Vector3::Zero();      ///< of the velocity error
    Vector3 acceleration_m_s2 = Vector3::Zero();  ///< measured, in W, low-passed: for the D gains
    bool filtering = false;                       ///< false: the next sample starts the filter
};

/// Takes the accelerometer (bias removed) as acceleration in W. PX4 differentiates its velocity
/// instead, which jumps with every correction of the estimate.
/// @param dt_s  since the last sample, > 0
void filter_acceleration(const AutopilotParameters& parameters, PositionControlState& state,
                         const Estimate& estimate, double dt_s);

/// Position error to velocity, within the speed limits; the way to the target goes before the
/// feed-forward.
[[nodiscard]] VelocitySetpoint position_control(const AutopilotParameters& parameters,
                                                const PositionSetpoint& target,
                                                const Vector3& p_WB_m);

/// Velocity error to attitude and collective thrust: PID, tilt limit, vertical before horizontal.
/// A setpoint beyond the speed limits is cut to them.
/// @param hold_integrators  the integral keeps its value
/// Source: PX4 PositionControl @02c4e036; facts.md section 6.
[[nodiscard]] AttitudeSetpoint velocity_control(const AutopilotParameters& parameters,
                                                PositionControlState& state,
                                                const VelocitySetpoint& target,
                                                const Vector3& v_WB_m_s, bool hold_integrators,
                                                double dt_s);

}  // namespace limpet::autopilot
