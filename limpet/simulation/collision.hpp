// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/simulation/model.hpp"

namespace limpet::simulation {

/// Whether a leg is so near the wall or the ground that the engine must look for contacts.
[[nodiscard]] bool legs_can_touch(const FlightModel& model, const Kinematics& base);

/// @return distance of the closest motor axis to the wall [m]; infinity beyond its edges
[[nodiscard]] double closest_hub_m(const FlightModel& model, const Kinematics& base);

/// What ends a flight: a propeller in the wall, its middle or a motor on the ground (it may
/// stand there on its legs).
[[nodiscard]] std::optional<guidance::Ending> collision(const FlightModel& model,
                                                        const Truth& truth);

/// The surface that the current or the next touch meets.
[[nodiscard]] const suction::Surface& surface_under_cup(const FlightModel& model,
                                                        const suction::CupState& cup);

}  // namespace limpet::simulation
