// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "limpet/core/frames.hpp"

namespace limpet {

struct PositionSetpoint {
    Vector3 p_W_m = Vector3::Zero();
    double yaw_rad = 0.0;
    Vector3 feedforward_v_W_m_s = Vector3::Zero();
};

/// No position loop behind it: guidance that commands a velocity along a line closes that loop.
struct VelocitySetpoint {
    Vector3 v_W_m_s = Vector3::Zero();
    double yaw_rad = 0.0;
    Vector3 feedforward_a_W_m_s2 = Vector3::Zero();
};

struct AttitudeSetpoint {
    Quaternion q_WB = Quaternion::Identity();
    double thrust = 0.0;  ///< collective, 0..1 of the motor command
};

/// Motors armed and at their idle command, no control.
struct IdleSetpoint {};

/// What guidance commands the autopilot and the perching mechanism.
struct Setpoint {
    std::variant<IdleSetpoint, PositionSetpoint, VelocitySetpoint, AttitudeSetpoint> motion =
        IdleSetpoint{};
    bool armed = false;
    bool pump_on = false;
    bool valve_open = false;
    /// The vehicle leans on something: integrators must not wind up against it. An autopilot behind
    /// a wire finds out by itself or not at all; the built-in one obeys.
    bool hold_integrators = false;
};

}  // namespace limpet
