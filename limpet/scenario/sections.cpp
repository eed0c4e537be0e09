// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/sections.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/suggestion.hpp"

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

std::vector<BoundParameter> joined(std::vector<BoundParameter> first,
                                   const std::vector<BoundParameter>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
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
            {"battery", bind(vehicle::battery_table(), airframe.battery)}};
}

std::vector<BoundParameter> rotor_rows(Vector3& p_B_m) {
    return {{"x_m", "m", -5.0, 5.0, &p_B_m.x(), "hub ahead of the centre of mass", "vehicle file"},
            {"y_m", "m", -5.0, 5.0, &p_B_m.y(), "hub right of it", "vehicle file"}};
}

std::vector<BoundParameter> suction_rows(suction::CupParameters& cup) {
    std::vector<BoundParameter> rows = bind(suction::cup_table(), cup);
    for_each_table(suction::PressureModels{}, cup.pressure, [&](const auto& table, auto& numbers) {
        rows = joined(std::move(rows), bind(table, numbers));
    });
    return joined(std::move(rows), bind(suction::lip_table(), cup.lip));
}

void read_suction(const YamlNode* section, suction::CupParameters& cup) {
    const YamlNode* old = section == nullptr ? nullptr : section->find("pneumatic");
    if (old != nullptr) {
        fail(*old, "is no key any more, say pressure_model: pneumatic");
    }
    read_rows(section, suction_rows(cup), {"pressure_model"});
    const YamlNode* named = section == nullptr ? nullptr : section->find("pressure_model");
    if (named == nullptr) {
        return;
    }
    const std::string word = read_text(*named);
    std::vector<std::string_view> names;
    for (const suction::PressureModel& model : suction::pressure_models()) {
        if (model.name == word) {
            cup.pressure_model = static_cast<int>(names.size());
            return;
        }
        names.push_back(model.name);
    }
    fail(*named, fmt::format("\"{}\" is none of {}", shown(word), fmt::join(names, ", ")));
}

std::vector<Section> scenario_sections(Scenario& scenario) {
    std::vector<Section> sections;
    for (Section& section : vehicle_sections(scenario.airframe)) {
        section.name = section.name.empty() ? "vehicle" : "vehicle." + section.name;
        sections.push_back(std::move(section));
    }
    sections.push_back({"wall", bind(wall_table(), scenario.wall)});
    sections.push_back({"wall.surface", bind(suction::surface_table(), scenario.wall.surface)});
    sections.push_back({"pendulum", bind(vehicle::pendulum_table(), scenario.pendulum)});
    sections.push_back({"press_rig", bind(vehicle::press_rig_table(), scenario.press_rig)});
    sections.push_back(
        {"environment", joined(bind(vehicle::wind_table(), scenario.environment.wind),
                               bind(vehicle::wall_air_table(), scenario.environment.wall_air))});
    sections.push_back({"suction", suction_rows(scenario.cup)});
    sections.push_back({"guidance", bind(guidance::perching_table(), scenario.guidance)});
    sections.push_back({"autopilot", bind(autopilot::autopilot_table(), scenario.autopilot)});
    sections.push_back({"sensors", sensor_rows(scenario.sensors)});
    sections.push_back({"simulation", bind(simulation_table(), scenario.simulation)});
    return sections;
}

const Section& find_section(const std::vector<Section>& sections, std::string_view name) {
    const auto found = std::find_if(sections.begin(), sections.end(),
                                    [&](const Section& section) { return section.name == name; });
    require(found != sections.end(), "the section is one of ours");
    return *found;
}

}  // namespace limpet::scenario
