// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

constexpr double kSettingFactor = 3.0;
constexpr double kPartFactor = 1.5;

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_setting(std::string_view section, std::string_view name) {
    if (section == "vehicle.slider") {
        return is_one_of(name, {"stiffness_N_m", "damping_N_s_m", "preload_N"});
    }
    if (section == "vehicle.cup") {
        return name.starts_with("centring_");
    }
    if (section == "suction") {
        return name == "valve_fitted";
    }
    if (section == "guidance") {
        return !name.ends_with("_limit_s") &&
               !is_one_of(name, {"attempts", "battery_reserve", "rest_s", "zero_thrust"});
    }
    return section == "autopilot" && (name.starts_with("MC_") || name.starts_with("MPC_"));
}

bool is_part(std::string_view section, std::string_view name) {
    return section.starts_with("vehicle") && section != "vehicle.battery" &&
           section != "vehicle.payload" && !is_setting(section, name);
}

void add_neighbours(const scenario::Section& section, const BoundParameter& row, double factor,
                    std::vector<Change>& all) {
    const double value = row.value.get();
    Change change{.key = section.name + "." + std::string(row.name),
                  .unit = std::string(row.unit),
                  .from = value,
                  .to = 1.0 - value,
                  .is_switch = row.value.is_switch()};
    if (change.is_switch) {
        all.push_back(change);
        return;
    }
    for (const double share : {1.0 / factor, factor}) {
        const double to = std::clamp(value * share, row.minimum, row.maximum);
        change.to = row.value.is_whole() ? std::round(to) : to;
        if (change.to != value) {
            all.push_back(change);
        }
    }
}

template <class Wanted>
std::vector<Change> turned(scenario::Scenario& scenario, double factor, const Wanted& wanted) {
    std::vector<Change> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            if (wanted(section.name, row.name) &&
                !scenario::derived(section.name, row.name, scenario)) {
                add_neighbours(section, row, factor, all);
            }
        }
    }
    return all;
}

}  // namespace

std::vector<Change> settings_turned(scenario::Scenario scenario) {
    return turned(scenario, kSettingFactor, is_setting);
}

std::vector<Change> parts_turned(scenario::Scenario scenario) {
    return turned(scenario, kPartFactor, is_part);
}

}  // namespace limpet::why
