// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/cup_status.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/rotor_command.hpp"

namespace limpet {

struct BatteryStatus {
    double voltage_V = 0.0;
    double current_A = 0.0;
    double energy_used_J = 0.0;
    double remaining = 1.0;  ///< 0..1
};

struct SliderStatus {
    double position_m = 0.0;    ///< 0 at the outer stop, < 0 compressed
    double velocity_m_s = 0.0;  ///< > 0 extends
    double force_N = 0.0;       ///< spring, damper and stops on the cup's side: < 0 when pressed
};

/// What hangs on the vehicle's cable, where there is such a thing. No plant moves it.
struct PayloadStatus {
    Vector3 p_W_m = Vector3::Zero();
    Vector3 v_W_m_s = Vector3::Zero();
    double tension_N = 0.0;  ///< of the cable, mean over the last step
    bool parted = false;     ///< the cable, for good
};

/// What is really so at a tick; sensors and recordings read it, guidance and autopilot never do.
struct Truth {
    double time_s = 0.0;
    Kinematics base;  ///< frame B
    Kinematics cup;   ///< frame C, origin at the centre of the lip
    SliderStatus slider;
    CupStatus cup_status;
    RotorList<double> rotor_speed_rad_s;
    double thrust_N = 0.0;  ///< sum of the rotors
    BatteryStatus battery;
    Vector3 legs_force_W_N = Vector3::Zero();  ///< by the wall on the legs
    PayloadStatus payload;
};

}  // namespace limpet
