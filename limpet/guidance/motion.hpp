// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/guidance/perching.hpp"

namespace limpet::guidance {

/// Speed and acceleration along a straight run.
struct RunReference {
    double speed_m_s = 0.0;
    double acceleration_m_s2 = 0.0;
};

/// From rest to a constant speed: the acceleration ramps up, holds and ramps down.
/// @param time_s          since the start of the run
/// @param ramp_s          of each ramp; shortened when the speed is reached within the ramps
[[nodiscard]] RunReference run_reference(double time_s, double speed_m_s, double acceleration_m_s2,
                                         double ramp_s);

/// Cubic from 0 to 1 with zero slope at both ends; clamped outside [0, 1].
[[nodiscard]] double smoothstep(double x);

/// Motor command whose thrust is `share` of the weight: thrust goes with the square of the rotor
/// speed, the speed goes linearly with the command.
[[nodiscard]] double thrust_command(const PerchingParameters& parameters, double share);

/// The acceleration by which an attitude leans, carrying the weight.
[[nodiscard]] Vector3 lean_W_m_s2(const Quaternion& q_WB);

/// Leaning for less counts as calm.
[[nodiscard]] double calm_m_s2(const PerchingParameters& parameters);

/// Whether wind was felt before the wall: then the vehicle leans on the cup as it leant there.
[[nodiscard]] bool windy(const PerchingParameters& parameters, const PerchingMemory& memory);

/// Attitude in which the vehicle hangs on the cup, level but for its lean against the wind.
[[nodiscard]] double level_pitch_rad(const PerchingParameters& parameters,
                                     const PerchingMemory& memory);
[[nodiscard]] double level_roll_rad(const PerchingParameters& parameters,
                                    const PerchingMemory& memory);

/// Whether the estimate has the cup's joint where the cup gripped. Guidance that stays on the cup
/// all the same believes the cup, and steers by no such estimate.
[[nodiscard]] bool sits_on_grip(const PerchingParameters& parameters, const PerchingMemory& memory,
                                const Estimate& estimate);

/// By which the lip is turned on the wall; in still air nothing, that is how the cup docks. [rad]
[[nodiscard]] double turn_on_cup_rad(const PerchingParameters& parameters,
                                     const PerchingMemory& memory);

/// Right of the place before the cup where the vehicle belongs, along the lip's right [m].
[[nodiscard]] double side_error_m(const PerchingParameters& parameters,
                                  const PerchingMemory& memory, const Estimate& estimate);

/// What the vehicle shall do in the memory's state at this time.
[[nodiscard]] Setpoint motion(const PerchingParameters& parameters, const PerchingMemory& memory,
                              const Estimate& estimate, double time_s);

/// The pre-position on the docking line.
[[nodiscard]] Vector3 pre_position_W(const PerchingParameters& parameters,
                                     const PerchingMemory& memory);

}  // namespace limpet::guidance
