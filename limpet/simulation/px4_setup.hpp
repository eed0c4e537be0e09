// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/px4/airframe.hpp"
#include "limpet/px4/wires.hpp"
#include "limpet/scenario/scenario.hpp"

// A scenario as the module px4 knows it.
namespace limpet::simulation {

/// What a PX4 must be set to for it to fly in simulation.
/// @param id  PX4's number of the airframe; none: the vehicle's own
[[nodiscard]] px4::Px4Airframe px4_airframe(const scenario::Scenario& scenario,
                                            std::optional<int> id = {});

/// Where an instance is met that flies it.
[[nodiscard]] px4::Px4Addresses px4_addresses(const scenario::Scenario& scenario,
                                              const px4::Px4Instance& instance);

}  // namespace limpet::simulation
