// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/px4/airframe.hpp"
#include "limpet/px4/wires.hpp"
#include "limpet/scenario/scenario.hpp"

// A scenario as the module px4 knows it.
namespace limpet::simulation {

/// What a PX4 must be set to for it to fly in simulation.
/// @param id  PX4's number of the airframe; none: the vehicle's own
[[nodiscard]] px4::Px4Airframe px4_airframe(const scenario::Scenario& scenario,
                                            std::optional<int> id = {});

/// What a PX4 is compared with before it is armed: as `px4-params` would set it.
/// @param board     it runs on one, not in simulation
/// @param left_out  that it has no more
/// @return nothing where PX4 does not take a value of the scenario's: the stand-in may fly it
[[nodiscard]] std::vector<mavlink::ExpectedParameter> px4_expected(
    const scenario::Scenario& scenario, bool board, const std::vector<std::string>& left_out = {});

/// Where an instance is met that flies it.
[[nodiscard]] px4::Px4Addresses px4_addresses(const scenario::Scenario& scenario,
                                              const px4::Px4Instance& instance);

}  // namespace limpet::simulation
