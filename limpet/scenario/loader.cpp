// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/fault_table.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kMostWeight = 1e6;  ///< of a noise
constexpr double kLeastWeight = 1e-6;

bool says_none(const YamlNode* node) {
    return node == nullptr || node->kind == YamlNode::Kind::null ||
           (node->kind == YamlNode::Kind::scalar && node->text == "none");
}

/// @param section  bound to `wall`
void read_wall(const YamlNode* node, const fs::path& root, const Section& section,
               WallSetup& wall) {
    wall.present = !says_none(node);
    if (!wall.present) {
        return;
    }
    read_section(node, section, {"surface", "first_touches"});
    const YamlNode* surface = node->find("surface");
    if (surface == nullptr) {
        fail(*node, "has no surface, as in `surface: porous_concrete`");
    }
    wall.surface = surface_from(*surface, root);
    const YamlNode* touches = node->find("first_touches");
    if (touches != nullptr && touches->kind != YamlNode::Kind::null) {
        for (const YamlNode& touch :
             read_list(*touches, "a list of surfaces, as in [spalled_concrete]")) {
            wall.first_touches.push_back(surface_from(touch, root));
        }
    }
}

/// [[seed, weight], ...]; weights add up by their squares, so that one of them must not be 0.
NoiseBlend read_noise(const YamlNode& node) {
    NoiseBlend noise;
    bool noticeable = false;
    for (const YamlNode& item :
         read_list(node, "a list of seeds and weights, as in [[1, 0.6], [2, 0.8]]")) {
        const auto& pair = read_list(item, "a seed and its weight, as in [1, 0.6]", 2, 2);
        double weight = 0.0;
        noise.push_back(
            {read_count(pair[0]),
             read_number(pair[1], {{}, "-", -kMostWeight, kMostWeight, &weight, {}, {}})});
        noticeable = noticeable || std::abs(noise.back().weight) > kLeastWeight;
    }
    if (!noise.empty() && !noticeable) {
        fail(node, fmt::format("needs a weight beyond {} or -{}", kLeastWeight, kLeastWeight));
    }
    return noise;
}

/// Sections are read in the order in which they build on each other: what is derived from the
/// vehicle and the sensors first, then the keys that may say otherwise.
void read_scenario(const YamlNode& root, const fs::path& data, Scenario& scenario) {
    if (!is_section(&root)) {
        fail(root, "is empty");
    }
    check_keys(root, {"description", "mission", "mount", "vehicle", "seed", "noise", "wall",
                      "pendulum", "press_rig", "environment", "faults", "suction", "guidance",
                      "autopilot", "sensors", "simulation"});
    read_given(root, "description", scenario.description);
    read_given(root, "mission", scenario.mission);
    read_given(root, "mount", scenario.mount);
    read_given(root, "seed", scenario.seed);
    read_given(root, "noise", scenario.noise, read_noise);
    const YamlNode* vehicle = root.find("vehicle");
    if (vehicle == nullptr) {
        fail(root, "vehicle: is missing, as in `vehicle: perching_uav`");
    }
    scenario.airframe =
        vehicle_from(*vehicle, data, scenario.path.parent_path(), &scenario.inherited);
    const std::vector<Section> sections = scenario_sections(scenario);
    const auto section = [&](std::string_view name) -> const Section& {
        return find_section(sections, name);
    };
    read_wall(root.find("wall"), data, section("wall"), scenario.wall);
    for (const char* name : {"pendulum", "press_rig", "environment", "simulation"}) {
        read_section(root.find(name), section(name));
    }
    take_air(scenario);
    refuse_fault_keys(root.find("sensors"));
    read_section(root.find("sensors"), section("sensors"),
                 {kFormerFaultKeys.begin(), kFormerFaultKeys.end()});
    read_given(root, "faults", scenario.faults, [&](const YamlNode& node) {
        return read_faults(node, scenario.airframe.rotors.size());
    });
    const YamlNode* simulation = root.find("simulation");
    if (simulation == nullptr || simulation->find("touch_step_s") == nullptr) {
        scenario.simulation.touch_step_s =
            std::min(scenario.simulation.touch_step_s, scenario.simulation.step_s);
    }
    derive(section("suction"), scenario);
    read_suction(root.find("suction"), scenario.cup);
    for (const char* name : {"guidance", "autopilot"}) {
        if (is_section(root.find(name))) {
            read_choices(root.find(name), section(name));
        }
        // What is derived may depend on the section's own keys, which win.
        read_section(root.find(name), section(name));
        derive(section(name), scenario);
        read_section(root.find(name), section(name));
    }
    lay_out(scenario);
}

fs::path data_of(const LoadOptions& options) {
    return options.data_root.empty() ? data_root() : options.data_root;
}

Scenario load(YamlNode root, Scenario scenario, const LoadOptions& options) {
    for (const std::string& override_text : options.overrides) {
        set_override(root, with_files_of(override_text, options.folder));
    }
    read_scenario(root, data_of(options), scenario);
    scenario.seed = options.seed.value_or(scenario.seed);
    check(scenario, root);
    return scenario;
}

}  // namespace

NoiseBlend noise_from(const std::string& text, const std::string& place) {
    return read_noise(parse_yaml(text, place));
}

Scenario load_scenario(const std::string& wanted, const LoadOptions& options) {
    Scenario scenario;
    scenario.path = is_path(wanted) ? fs::path(wanted)
                                    : find_file(wanted, "scenario", data_of(options) / "scenarios");
    scenario.name = scenario.path.stem().string();
    YamlNode root = parse_yaml_file(scenario.path);
    return load(std::move(root), std::move(scenario), options);
}

Scenario load_scenario_text(const std::string& text, const std::string& name,
                            const LoadOptions& options) {
    return ScenarioText(text, name).load(options);
}

ScenarioText::ScenarioText(std::string yaml, std::string name)
    : yaml_(std::move(yaml)),
      name_(std::move(name)),
      tree_(std::make_shared<const YamlNode>(parse_yaml(yaml_, name_))) {}

Scenario ScenarioText::load(const LoadOptions& options) const {
    Scenario scenario;
    scenario.name = name_;
    return scenario::load(*tree_, std::move(scenario), options);
}

}  // namespace limpet::scenario
