// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "limpet/autopilot/builtin.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/time.hpp"

namespace limpet::autopilot {

/// The paper's quad-x with its rotors at +-0.205 m.
[[nodiscard]] RotorList<RotorGeometry> quad_x();

/// A free rigid body with the Gazebo motor model of facts.md section 1, its sensors and the
/// autopilot in the loop: 1 ms physics, 250 Hz IMU and control, 120 Hz motion capture 20 ms late.
struct FlightRig {
    static constexpr double kMass_kg = 3.2;

    explicit FlightRig(const AutopilotParameters& parameters = {}, double noise_scale = 0.0,
                       const Kinematics& initial = {});

    /// Flies for `duration_s` with this setpoint.
    void fly(const Setpoint& setpoint, double duration_s);

    AutopilotModel model;
    AutopilotState autopilot;
    Kinematics truth;
    RotorList<double> speed_rad_s;
    RotorCommand command;
    Vector3 push_W_N = Vector3::Zero();  ///< disturbance at the centre of mass
    Tick tick = 0;
    double noise = 0.0;  ///< 0: perfect sensors, 1: those of facts.md section 2

private:
    void sense();
    void move();

    Readings readings_;
    RandomStream random_;
    Kinematics imu_from_;
    std::deque<Sample<PoseReading>> on_the_way_;
};

}  // namespace limpet::autopilot
