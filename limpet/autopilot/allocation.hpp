// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/frames.hpp"
#include "limpet/core/signals/rotor_command.hpp"

namespace limpet::autopilot {

/// What the mixer must know of a rotor.
struct RotorGeometry {
    Vector3 p_B_m = Vector3::Zero();  ///< hub
    double direction = 1.0;  ///< +1: turns counter-clockwise seen from above; -1: clockwise
    double moment_constant_m = 0.019;  ///< torque over thrust
};

using RotorVector = Eigen::Vector4d;

/// The geometry turned into numbers: commands = roll * torque.x + pitch * torque.y + yaw * torque.z
/// + thrust * collective. Normalised as PX4 does: a quad-x has +-0.7071 in roll and pitch, +-1 in
/// yaw, +1 in thrust.
struct Mixer {
    RotorVector roll = RotorVector::Zero();
    RotorVector pitch = RotorVector::Zero();
    RotorVector yaw = RotorVector::Zero();
    RotorVector thrust = RotorVector::Zero();
    /// Rows: roll, pitch, yaw, thrust that a set of commands makes.
    Eigen::Matrix4d inverse = Eigen::Matrix4d::Zero();
};

/// @throws InputError when the rotors cannot make roll, pitch, yaw and thrust independently
[[nodiscard]] Mixer make_mixer(const std::array<RotorGeometry, kRotors>& rotors);

/// Axes about which more torque was asked than was given, per sign.
struct Saturation {
    std::array<bool, 3> positive{};
    std::array<bool, 3> negative{};
};

struct Allocation {
    std::array<double, kRotors> command{};  ///< 0..1
    Saturation saturation;
};

/// Sequential desaturation with airmode off: thrust may be given up for torque but never added,
/// then roll and pitch yield, then yaw.
/// @param torque  about x, y, z of B, normalised, -1..1
/// @param thrust  collective, 0..1
/// Source: PX4 ControlAllocationSequentialDesaturation::mixAirmodeDisabled.
[[nodiscard]] Allocation allocate(const Mixer& mixer, const Vector3& torque, double thrust);

}  // namespace limpet::autopilot
