// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/companion/parameters.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::ros {

/// A node's private parameters. Empty: not given.
struct SetupArguments {
    std::string scenario = {};  ///< a name or a path; the others change it
    std::string vehicle = {};   ///< perching_uav without a scenario
    std::string surface = {};   ///< porous_concrete without a scenario
    std::string mission = {};   ///< perch without a scenario
    std::vector<std::string> set = {};
    std::optional<std::uint64_t> seed = {};

    friend bool operator==(const SetupArguments&, const SetupArguments&) = default;
};

/// @return nullptr for what is not given: not there, or an empty text
[[nodiscard]] const scenario::YamlNode* given(const scenario::YamlNode& section,
                                              std::string_view key);
/// @param section  with such keys among others; `set` is a list of texts, or one text "KEY=VALUE;
///                 KEY=VALUE"
/// @throws InputError one line that names the key, its value and what is allowed
[[nodiscard]] SetupArguments read_arguments(const scenario::YamlNode& section);

struct NodeSetup {
    scenario::Scenario scenario;
    companion::CompanionLimits limits;  ///< set by "limits.KEY=VALUE"
};

/// What the nodes know of vehicle, guidance, cup and surface: derived and checked as for a flight.
/// @throws InputError one line: place, key, value, what is allowed
[[nodiscard]] NodeSetup load_setup(const SetupArguments& arguments);

/// Where a simulated vehicle publishes what it flies, so that nodes fly nothing else.
inline constexpr const char* kFlightParameter = "/limpet/flight";
/// As a parameter: all of it in one, so that nobody reads a half.
[[nodiscard]] XmlRpc::XmlRpcValue flight_value(const SetupArguments& flight);
/// @return nullopt if it is none
[[nodiscard]] std::optional<SetupArguments> flight_from(XmlRpc::XmlRpcValue value);
/// @param flight  a path in it is of this program's folder
void publish_flight(SetupArguments flight);

/// A node's private parameters, read once when it starts, as a section of YAML: the same checks,
/// the same messages (limpet/scenario/yaml_reader.hpp), where each parameter is called by its name.
/// @param more  parameters of this node other than those of its setup: ~scenario, ~vehicle,
/// ~surface,
///              ~mission, ~set, ~seed and ~as_vehicle
/// @throws InputError for one that is none of these: it would mean nothing
[[nodiscard]] scenario::YamlNode node_parameters(std::vector<std::string_view> more);
/// The same with rows, which take what is given.
[[nodiscard]] scenario::YamlNode node_parameters(const std::vector<BoundParameter>& rows,
                                                 std::vector<std::string_view> more);
/// Its setup; with ~as_vehicle the simulated vehicle's own, for which it waits; then only ~mission
/// and ~set may change them.
/// @throws InputError
[[nodiscard]] SetupArguments setup_of(const scenario::YamlNode& parameters);

/// Runs a node: an InputError becomes one line on stderr and exit code 2.
[[nodiscard]] int run_node(int argc, char** argv, const char* name, void (*node)());

}  // namespace limpet::ros
