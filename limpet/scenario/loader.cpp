// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "limpet/scenario/checks.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/writer.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

Mission read_mission(const YamlNode& node) {
    const std::string word = read_text(node);
    const auto mission = mission_from(word);
    if (!mission) {
        fail(node, fmt::format("\"{}\" is none of hover, perch, perch_and_take_off", shown(word)));
    }
    return *mission;
}

vehicle::Mount read_mount(const YamlNode& node) {
    const std::string word = read_text(node);
    const auto mount = vehicle::mount_from(word);
    if (!mount) {
        fail(node, fmt::format("\"{}\" is none of free, pendulum, press_rig", shown(word)));
    }
    return *mount;
}

/// One of a registry by its name.
/// @param kind     "engine", for the message
/// @param entries  pointers to what has a name
template <class Entries>
auto read_choice(const YamlNode& node, std::string_view kind, const Entries& entries) {
    const std::string word = read_text(node);
    std::vector<std::string> names;
    for (const auto* entry : entries) {
        if (entry->name == word) {
            return entry;
        }
        names.emplace_back(entry->name);
    }
    fail(node, unknown_name(word, kind, names));
}

bool says_none(const YamlNode* node) {
    return node == nullptr || node->kind == YamlNode::Kind::null ||
           (node->kind == YamlNode::Kind::scalar && node->text == "none");
}

void read_wall(const YamlNode* node, const fs::path& root, WallSetup& wall) {
    wall.present = !says_none(node);
    if (!wall.present) {
        return;
    }
    read_rows(node, bind(wall_table(), wall), {"shape", "surface", "first_touches"});
    if (const YamlNode* shape = node->find("shape")) {
        wall.geometry.shape = read_choice(*shape, "shape of a wall", wall_shapes());
    }
    const YamlNode* surface = node->find("surface");
    if (surface == nullptr) {
        fail(*node, "has no surface, as in `surface: porous_concrete`");
    }
    wall.surface = surface_from(*surface, root);
    const YamlNode* touches = node->find("first_touches");
    if (touches == nullptr || touches->kind == YamlNode::Kind::null) {
        return;
    }
    if (touches->kind != YamlNode::Kind::list) {
        fail(*touches, "must be a list of surfaces, as in [spalled_concrete]");
    }
    for (const YamlNode& touch : touches->children) {
        wall.first_touches.push_back(surface_from(touch, root));
    }
}

/// Sections are read in the order in which they build on each other: what is derived from the
/// vehicle and the sensors first, then the keys that may say otherwise.
void read_scenario(const YamlNode& root, const fs::path& data, Scenario& scenario) {
    if (!is_section(&root)) {
        fail(root, "is empty");
    }
    check_keys(root, {"description", "mission", "mount", "vehicle", "seed", "wall", "pendulum",
                      "press_rig", "environment", "suction", "guidance", "autopilot", "sensors",
                      "simulation"});
    if (const YamlNode* node = root.find("description")) {
        scenario.description = read_text(*node);
    }
    if (const YamlNode* node = root.find("mission")) {
        scenario.mission = read_mission(*node);
    }
    if (const YamlNode* node = root.find("mount")) {
        scenario.mount = read_mount(*node);
    }
    if (const YamlNode* node = root.find("seed")) {
        scenario.seed = read_count(*node);
    }
    const YamlNode* vehicle = root.find("vehicle");
    if (vehicle == nullptr) {
        fail(root, "vehicle: is missing, as in `vehicle: perching_uav`");
    }
    scenario.airframe = vehicle_from(*vehicle, data, scenario.path.parent_path());
    read_wall(root.find("wall"), data, scenario.wall);
    const std::vector<Section> sections = scenario_sections(scenario);
    for (const char* name : {"pendulum", "press_rig", "environment", "sensors"}) {
        read_rows(root.find(name), find_section(sections, name).rows);
    }
    const YamlNode* simulation = root.find("simulation");
    read_rows(simulation, find_section(sections, "simulation").rows, {"engine"});
    if (const YamlNode* engine = simulation ? simulation->find("engine") : nullptr) {
        scenario.engine = read_choice(*engine, "engine", plant::engines());
    }
    if (simulation == nullptr || simulation->find("touch_step_s") == nullptr) {
        scenario.simulation.touch_step_s =
            std::min(scenario.simulation.touch_step_s, scenario.simulation.step_s);
    }
    derive(scenario);
    read_suction(root.find("suction"), scenario.cup);
    derive_from_suction(scenario);
    read_rows(root.find("guidance"), find_section(sections, "guidance").rows);
    const YamlNode* autopilot = root.find("autopilot");
    read_rows(autopilot, find_section(sections, "autopilot").rows, {"kind"});
    if (const YamlNode* kind = autopilot ? autopilot->find("kind") : nullptr) {
        scenario.autopilot_kind = read_choice(*kind, "autopilot", autopilot::autopilots());
    }
    lay_out(scenario);
}

fs::path data_of(const LoadOptions& options) {
    return options.data_root.empty() ? data_root() : options.data_root;
}

Scenario load(YamlNode root, Scenario scenario, const LoadOptions& options) {
    for (const std::string& override_text : options.overrides) {
        set_override(root, override_text);
    }
    read_scenario(root, data_of(options), scenario);
    scenario.seed = options.seed.value_or(scenario.seed);
    check(scenario, root);
    scenario.yaml = to_yaml(scenario);
    return scenario;
}

}  // namespace

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
    Scenario scenario;
    scenario.name = name;
    return load(parse_yaml(text, name), std::move(scenario), options);
}

}  // namespace limpet::scenario
