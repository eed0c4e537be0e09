// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpet/companion/parameters.hpp"
#include "limpet/scenario/scenario.hpp"

namespace limpet::ros {

/// What a node is told by its private parameters. Empty: not said.
struct SetupArguments {
    std::string scenario;  ///< a name or a path; the others change it
    std::string vehicle;   ///< perching_uav without a scenario
    std::string surface;   ///< porous_concrete without a scenario
    std::string mission;   ///< perch without a scenario
    std::vector<std::string> set;
    std::optional<std::uint64_t> seed;
};

struct NodeSetup {
    scenario::Scenario scenario;
    companion::CompanionLimits limits;  ///< set by "limits.KEY=VALUE"
};

/// What the nodes know of vehicle, guidance, cup and surface: derived and checked as for a flight.
/// @throws InputError one line: place, key, value, what is allowed
[[nodiscard]] NodeSetup load_setup(const SetupArguments& arguments);

/// "a=1; b=2" into its pieces.
[[nodiscard]] std::vector<std::string> split_settings(const std::string& text);

}  // namespace limpet::ros
