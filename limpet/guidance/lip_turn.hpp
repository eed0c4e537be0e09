// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

namespace limpet::guidance {

// The lip keeps the roll with which the cup docked: the joint behind it bends up, down and aside,
// it does not turn about the wall's normal, and the sealed lip resists being turned there. A
// vehicle that leant against the wind when it docked therefore pitches up about an axis that is
// turned with the lip, and ends aside of the spot below the cup, with both legs on the wall.
// Brought below the cup it would lean over one leg instead.

/// By which the lip is turned about the normal, from an attitude on the wall.
/// @param into_wall_W  level unit vector
/// @return [rad], > 0: clockwise, seen from behind the vehicle, as a roll is
[[nodiscard]] double lip_turn_rad(const Vector3& into_wall_W, const Quaternion& q_WB);

/// The pitch about the turned axis: of an attitude without a turn and a roll its pitch. [rad]
[[nodiscard]] double pitch_on_lip_rad(const Vector3& into_wall_W, const Quaternion& q_WB);

/// The lip's right in W.
[[nodiscard]] Vector3 right_of_lip_W(const Vector3& into_wall_W, double turn_rad);

/// Heading for the wall, turned with the lip, pitched about its axis, rolled about the vehicle's.
[[nodiscard]] Quaternion attitude_on_lip(double heading_rad, double turn_rad, double pitch_rad,
                                         double roll_rad);

}  // namespace limpet::guidance
