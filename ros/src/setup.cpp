// SPDX-License-Identifier: Apache-2.0
#include "ros/src/setup.hpp"

#include <string_view>

#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros {
namespace {

constexpr std::string_view kLimits = "limits.";
/// Where no scenario is named: a real vehicle's nodes need no wall to start before.
constexpr const char* kBare =
    "mission: perch\nvehicle: perching_uav\nwall: {surface: porous_concrete}\n";

companion::CompanionLimits limits_of(const std::vector<std::string>& settings) {
    companion::CompanionLimits limits;
    scenario::YamlNode root = scenario::parse_yaml("limits: {}\n", "limits");
    for (const std::string& setting : settings) {
        set_override(root, setting);
    }
    read_rows(root.find("limits"), bind(companion::companion_limits_table(), limits));
    return limits;
}

}  // namespace

std::vector<std::string> split_settings(const std::string& text) {
    std::vector<std::string> pieces;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::size_t first = text.find_first_not_of(" \t\n", begin);
        if (first < end) {
            const std::size_t last = text.find_last_not_of(" \t\n", end - 1);
            pieces.push_back(text.substr(first, last + 1 - first));
        }
        begin = end + 1;
    }
    return pieces;
}

NodeSetup load_setup(const SetupArguments& arguments) {
    scenario::LoadOptions options;
    options.seed = arguments.seed;
    const auto say = [&options](const char* key, const std::string& value) {
        if (!value.empty()) {
            options.overrides.push_back(std::string(key) + "=" + value);
        }
    };
    say("vehicle", arguments.vehicle);
    say("wall.surface", arguments.surface);
    say("mission", arguments.mission);
    std::vector<std::string> limits;
    for (const std::string& setting : arguments.set) {
        const bool is_limit = setting.compare(0, kLimits.size(), kLimits) == 0;
        (is_limit ? limits : options.overrides).push_back(setting);
    }
    return {.scenario = arguments.scenario.empty()
                            ? load_scenario_text(kBare, "parameters", options)
                            : load_scenario(arguments.scenario, options),
            .limits = limits_of(limits)};
}

}  // namespace limpet::ros
