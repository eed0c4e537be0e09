// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/frames.hpp"
#include "limpet/core/rotor_list.hpp"

namespace limpet::autopilot {

/// What the mixer must know of a rotor.
struct RotorGeometry {
    Vector3 p_B_m = Vector3::Zero();  ///< hub
    double direction = 1.0;  ///< +1: turns counter-clockwise seen from above; -1: clockwise
    double moment_constant_m = 0.019;  ///< torque over thrust
};

/// A number a rotor, on the stack.
using RotorVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, static_cast<int>(kMaxRotors), 1>;
/// Rows roll, pitch, yaw, thrust; a column a rotor.
using EffectMatrix = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, static_cast<int>(kMaxRotors)>;

/// The geometry turned into numbers: commands = roll * torque.x + pitch * torque.y + yaw * torque.z
/// + thrust * collective: the pseudo-inverse of what the rotors do, normalised as PX4 does. A
/// quad-x has +-0.7071 in roll and pitch, +-1 in yaw, +1 in thrust.
/// Source: PX4 ControlAllocationPseudoInverse.
struct Mixer {
    RotorVector roll;
    RotorVector pitch;
    RotorVector yaw;
    RotorVector thrust;
    EffectMatrix effect;  ///< times commands: the torque and thrust that they make, normalised

    [[nodiscard]] std::size_t rotors() const { return static_cast<std::size_t>(roll.size()); }
};

/// @throws InputError when the rotors cannot make roll, pitch, yaw and thrust independently, or to
///         hover one of them had to push down
[[nodiscard]] Mixer make_mixer(const RotorList<RotorGeometry>& rotors);

/// Axes about which more torque was requested than was given, per sign.
struct Saturation {
    std::array<bool, 3> positive{};
    std::array<bool, 3> negative{};
};

struct Allocation {
    RotorList<double> command;  ///< 0..1
    Saturation saturation;
};

/// Sequential desaturation with airmode off: thrust may be given up for torque but never added,
/// then roll and pitch yield, then yaw.
/// @param torque  about x, y, z of B, normalised, -1..1
/// @param thrust  collective, 0..1
/// Source: PX4 ControlAllocationSequentialDesaturation::mixAirmodeDisabled.
[[nodiscard]] Allocation allocate(const Mixer& mixer, const Vector3& torque, double thrust);

}  // namespace limpet::autopilot
