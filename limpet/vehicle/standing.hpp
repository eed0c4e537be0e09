// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/vehicle/airframe.hpp"

namespace limpet::vehicle {

/// How far the vehicle on its legs may be turned about the normal of a vertical wall until its
/// weight tips it over the line from the cup's joint, which bends there, to a leg's contact.
/// @return [rad], 0 to pi/2
[[nodiscard]] double tipping_turn_rad(const Airframe& airframe);

}  // namespace limpet::vehicle
