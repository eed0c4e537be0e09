// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "limpet/autopilot.hpp"
#include "limpet/autopilot/allocation.hpp"
#include "limpet/autopilot/estimator.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/autopilot/position_control.hpp"
#include "limpet/autopilot/rate_control.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"

/// The built-in autopilot: PX4's cascade on an error-state Kalman filter.
///
///   readings -> estimator -> estimate
///                               |
///   position -> velocity -> attitude + thrust -> rates -> torque -> allocation -> commands
///        setpoints enter wherever their kind says          ^-- saturation --'
namespace limpet::autopilot {

struct AutopilotModel {
    AutopilotParameters parameters;
    Mixer mixer;
    AutopilotVehicle vehicle;
    /// In place of the cascade, behind the same estimator and before the same mixer; null: the
    /// cascade.
    std::shared_ptr<const Autopilot> own;
};

struct AutopilotState {
    Estimate estimate;
    EstimatorState estimator;
    PositionControlState position;
    RateControlState rate;
    Saturation saturation;             ///< of the last allocation
    double control_s = 0.0;            ///< when control last ran
    AttitudeSetpoint attitude_target;  ///< the inner setpoints, for telemetry
    Vector3 rate_target_rad_s = Vector3::Zero();
    Vector3 torque = Vector3::Zero();  ///< requested from the allocation
    std::vector<double> memory;        ///< of model.own; else rate set-points on their way
};

/// @throws InputError when the rotors cannot make roll, pitch, yaw and thrust independently
[[nodiscard]] AutopilotModel make_autopilot(const AutopilotParameters& parameters,
                                            const RotorList<RotorGeometry>& rotors);

/// What model.own remembers, from its beginning.
void start_memory(const AutopilotModel& model, AutopilotState& state);

/// @param initial  see start_estimator
[[nodiscard]] AutopilotState start(const AutopilotModel& model, const Estimate& initial);

/// On each new IMU sample; the result is in state.estimate.
void estimate(const AutopilotModel& model, AutopilotState& state, const Readings& readings);

/// Right after `estimate`, at the same rate. A change of the setpoint's kind makes no jump: every
/// integrator keeps its value until disarmed. Flies on when the estimate is not valid; who gives
/// setpoints decides what to do then.
[[nodiscard]] RotorCommand control(const AutopilotModel& model, AutopilotState& state,
                                   const Setpoint& setpoint, double time_s);

}  // namespace limpet::autopilot
