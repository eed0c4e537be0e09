// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/sections.hpp"

#include <algorithm>
#include <iterator>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::scenario {
namespace {

/// Takes the rows whose names begin with `prefix` out of `rows` and drops it from their names:
/// `lidar_x_m` of the table is `lidar: {x_m: ...}` in the file.
std::vector<BoundParameter> take_group(std::vector<BoundParameter>& rows, std::string_view prefix,
                                       std::string_view suffix = {}) {
    std::vector<BoundParameter> group;
    std::vector<BoundParameter> rest;
    for (BoundParameter& row : rows) {
        if (row.name.substr(0, prefix.size()) == prefix) {
            row.name.remove_prefix(prefix.size());
            row.name.remove_suffix(suffix.size());
            group.push_back(row);
        } else {
            rest.push_back(row);
        }
    }
    rows = std::move(rest);
    return group;
}

/// A choice of one of a registry of `const Entry*`, each with a name and a description.
template <class Registry, class Entry>
Choice choice(std::string_view key, std::string_view kind, const Registry& registry,
              const Entry*& value) {
    Choice made{.key = key, .kind = kind, .names = {}, .choose = [registry, &value](std::size_t i) {
                    value = registry[i];
                }};
    for (std::size_t i = 0; i < registry.size(); ++i) {
        made.names.push_back(
            {std::string(registry[i]->name), std::string(registry[i]->description)});
        made.chosen = registry[i] == value ? i : made.chosen;
    }
    return made;
}

}  // namespace

std::vector<Section> vehicle_sections(vehicle::Airframe& airframe) {
    std::vector<BoundParameter> top = bind(vehicle::airframe_table(), airframe);
    std::vector<BoundParameter> inertia = take_group(top, "inertia_", "_kg_m2");
    std::vector<BoundParameter> lidar = take_group(top, "lidar_");
    std::vector<BoundParameter> pump = take_group(top, "pump_");
    return {{"", std::move(top)},
            {"inertia_kg_m2", std::move(inertia)},
            {"lidar", std::move(lidar)},
            {"pump", std::move(pump)},
            {"rotor", bind(vehicle::rotor_table(), airframe.rotor)},
            {"slider", bind(vehicle::slider_table(), airframe.slider)},
            {"cup", bind(vehicle::cup_mount_table(), airframe.cup)},
            {"legs", bind(vehicle::leg_table(), airframe.legs)},
            {"battery", bind(vehicle::battery_table(), airframe.battery)},
            {"payload", bind(vehicle::payload_table(), airframe.payload)}};
}

std::vector<BoundParameter> rotor_rows(vehicle::Rotor& rotor) {
    return bind(vehicle::rotor_place_table(), rotor);
}

std::vector<BoundParameter> suction_rows(suction::CupParameters& cup) {
    return joined(
        joined(bind(suction::cup_table(), cup), bind_all(suction::PressureModels{}, cup.pressure)),
        bind(suction::lip_table(), cup.lip));
}

void read_suction(const YamlNode* section, suction::CupParameters& cup) {
    const YamlNode* old = section == nullptr ? nullptr : section->find("pneumatic");
    if (old != nullptr) {
        fail(*old,
             "is no key any more: for 0 say pressure_model: first_order, for 1 pressure_model: "
             "pneumatic");
    }
    read_rows(section, suction_rows(cup), {"pressure_model"});
    if (const YamlNode* named = section == nullptr ? nullptr : section->find("pressure_model")) {
        const std::vector<std::string> names = names_of(suction::pressure_models());
        cup.pressure_model = static_cast<int>(read_one_of(*named, {names.begin(), names.end()}));
    }
}

std::vector<Section> scenario_sections(Scenario& scenario) {
    Environment& environment = scenario.environment;
    std::vector<Section> sections = {
        {"wall",
         bind(wall_table(), scenario.wall),
         {choice("shape", "shape of a wall", wall_shapes(), scenario.wall.geometry.shape),
          choice("condition", "condition of a wall", suction::surface_conditions(),
                 scenario.wall.condition)}},
        {"wall.surface", bind(suction::surface_table(), scenario.wall.surface)},
        {"pendulum", bind(vehicle::pendulum_table(), scenario.pendulum)},
        {"press_rig", bind(vehicle::press_rig_table(), scenario.press_rig)},
        {"environment", joined(joined(bind(air_table(), environment.air),
                                      bind(vehicle::wind_table(), environment.wind)),
                               joined(bind(vehicle::wall_air_table(), environment.wall_air),
                                      joined(bind(vehicle::nearness_table(), environment.nearness),
                                             bind(vehicle::swell_table(), environment.swell))))},
        {"suction", suction_rows(scenario.cup)},
        {"guidance", bind(guidance::perching_table(), scenario.guidance)},
        {"autopilot",
         bind(autopilot::autopilot_table(), scenario.autopilot),
         {choice("kind", "autopilot", autopilot::autopilots(), scenario.autopilot_kind),
          choice("aiding", "source of position", autopilot::position_sources(), scenario.aiding)}},
        {"sensors", sensor_rows(scenario.sensors)},
        {"simulation",
         bind(simulation_table(), scenario.simulation),
         {choice("engine", "engine", plant::engines(), scenario.engine)}}};
    std::vector<Section> vehicle = vehicle_sections(scenario.airframe);
    for (Section& section : vehicle) {
        section.name = section.name.empty() ? "vehicle" : "vehicle." + section.name;
    }
    sections.insert(sections.begin(), std::move_iterator(vehicle.begin()),
                    std::move_iterator(vehicle.end()));
    return sections;
}

void read_section(const YamlNode* node, const Section& section,
                  std::vector<std::string_view> others) {
    for (const Choice& choice : section.choices) {
        others.push_back(choice.key);
    }
    read_rows(node, section.rows, others);
    read_choices(node, section);
}

void read_choices(const YamlNode* node, const Section& section) {
    for (const Choice& choice : section.choices) {
        if (const YamlNode* named = node == nullptr ? nullptr : node->find(choice.key)) {
            const std::string word = read_text(*named);
            const std::vector<std::string> names = names_of(choice.names);
            const auto found = std::find(names.begin(), names.end(), word);
            if (found == names.end()) {
                fail(*named, unknown_name(word, choice.kind, names));
            }
            choice.choose(static_cast<std::size_t>(found - names.begin()));
        }
    }
}

const Section& find_section(const std::vector<Section>& sections, std::string_view name) {
    const Section* found = find_named(sections, name);
    require(found != nullptr, "the section is one of ours");
    return *found;
}

std::vector<Section> sections_of(std::string_view part, std::vector<Section> all) {
    const std::vector<std::string> names = names_of(all);
    const std::string within = std::string(part) + ".";
    std::erase_if(all, [&](const Section& section) {
        return !part.empty() && section.name != part && section.name.rfind(within, 0) != 0;
    });
    if (all.empty()) {
        throw InputError(unknown_name(std::string(part), "section", names));
    }
    return all;
}

}  // namespace limpet::scenario
