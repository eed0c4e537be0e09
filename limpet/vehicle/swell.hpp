// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/vehicle/airframe.hpp"

/// A wall that moves with the sea: a ship's hull, a floating platform, a pontoon.
///
/// W goes along with the wall, and with it the ground and the cameras of motion capture. What the
/// hull's sway does is described in W as it is by any body that accelerates: every part of the
/// vehicle is pulled by -m a, the air streams past with -v, the IMU feels it, GPS and barometer
/// measure on top of it. Contacts, cup and LiDARs see a wall at rest. Exact, for a hull that does
/// not turn.
///
///   p(t) = A (1 - cos(2 pi t / T)),  at rest at t = 0
///
/// Source: Goldstein, "Classical mechanics", 4.9 (a moving frame without turning); a regular wave.
namespace limpet::vehicle {

/// Rows of `environment:` about the sea. Off by default.
struct SwellParameters {
    double swell_into_wall_m = 0.0;   ///< amplitude, along the heading into the wall
    double swell_along_wall_m = 0.0;  ///< to the right, seen along that
    double swell_up_m = 0.0;
    double swell_period_s = 8.0;
};
[[nodiscard]] const ParameterTable<SwellParameters>& swell_table();

/// Where W is against the earth.
struct SwellMotion {
    Vector3 p_EW_W_m = Vector3::Zero();  ///< since the beginning
    Vector3 v_EW_W_m_s = Vector3::Zero();
    Vector3 a_EW_W_m_s2 = Vector3::Zero();
};

/// Immutable during a flight.
struct SwellModel {
    bool moves = false;
    Vector3 amplitude_W_m = Vector3::Zero();
    double turn_rad_s = 0.0;

    /// A body of the vehicle, as -m a pulls on it.
    struct Part {
        double mass_kg = 0.0;
        Vector3 centre_m = Vector3::Zero();  ///< in B, and of the cup in C
    };
    Part base = {}, carriage = {}, cup = {};
};
/// @param ahead_W  level, into the wall
[[nodiscard]] SwellModel make_swell(const SwellParameters& parameters, const Vector3& ahead_W,
                                    const Airframe& airframe);
[[nodiscard]] SwellMotion swell_motion(const SwellModel& model, double time_s);

}  // namespace limpet::vehicle
