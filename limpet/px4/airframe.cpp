// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/airframe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/px4/data.hpp"

namespace limpet::px4 {
namespace {

using Facts = std::map<std::string, Px4Fact, std::less<>>;

Facts read_facts() {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Facts facts;
    const auto file = nlohmann::json::parse(kParametersJson);
    for (const auto& row : file.at("parameters")) {
        const std::string type = row.at("type");
        require(type == "Int32" || type == "Float", "a parameter of PX4 is Int32 or Float");
        const Px4Fact fact{.type = type == "Int32" ? Px4Type::int32 : Px4Type::real32,
                           .default_value = row.at("default"),
                           .minimum = row.value("min", -kNone),
                           .maximum = row.value("max", kNone)};
        require(facts.emplace(row.at("name").get<std::string>(), fact).second,
                "a parameter of PX4 stands once");
    }
    return facts;
}

using Settings = std::vector<Px4Setting>;

constexpr int kFirstOwnId = 22000;  // init.d-posix/airframes/CMakeLists.txt
constexpr int kLastOwnId = 22999;

/// @throws InputError when PX4 would call the value out of range
void add(Settings& settings, const std::string& name, double value, std::string reason,
         bool fixed = false) {
    const Px4Fact* fact = find_px4_fact(name);
    require(fact != nullptr, "every parameter that is set is in parameters.json");
    if (!(value >= fact->minimum && value <= fact->maximum)) {
        throw InputError(fmt::format("{} = {:g}: PX4 allows {:g} .. {:g}", name, value,
                                     fact->minimum, fact->maximum));
    }
    settings.push_back({.name = name,
                        .type = fact->type,
                        .value = value,
                        .reason = std::move(reason),
                        .fixed = fixed});
}

/// "front right"; "lower front right" of a coaxial pair.
std::string place_of(const Px4Airframe& airframe, std::size_t i) {
    constexpr double kMiddle_m = 0.01;
    const Vector3& p_B_m = airframe.rotors[i].p_B_m;
    std::string place;
    for (const autopilot::RotorGeometry& other : airframe.rotors) {
        const Vector3 apart_m = p_B_m - other.p_B_m;
        if (apart_m.head<2>().norm() < kMiddle_m && std::abs(apart_m.z()) > kMiddle_m) {
            place += apart_m.z() > 0.0 ? "lower" : "upper";
        }
    }
    const auto say = [&place](double m, const char* positive, const char* negative) {
        if (std::abs(m) > kMiddle_m) {
            place += (place.empty() ? "" : " ") + std::string(m > 0.0 ? positive : negative);
        }
    };
    say(p_B_m.x(), "front", "rear");
    say(p_B_m.y(), "right", "left");
    return place;
}

void add_rotors(const Px4Airframe& airframe, Settings& settings) {
    const std::size_t count = airframe.rotors.size();
    add(settings, "CA_AIRFRAME", 0, "a multirotor");
    add(settings, "CA_ROTOR_COUNT", static_cast<double>(count), px4_frame(airframe).says);
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        const autopilot::RotorGeometry& rotor = airframe.rotors[i];
        const std::string prefix = fmt::format("CA_ROTOR{}_", i);
        const std::string place = place_of(airframe, i);
        add(settings, prefix + "PX", rotor.p_B_m.x(),
            fmt::format("{} hub, m forward of the centre of mass", place));
        add(settings, prefix + "PY", rotor.p_B_m.y(),
            fmt::format("{} hub, m right of the centre of mass", place));
        add(settings, prefix + "KM", rotor.direction * rotor.moment_constant_m,
            fmt::format("torque over thrust, m; turns {}", rotor.direction > 0
                                                               ? "counter-clockwise: positive"
                                                               : "clockwise: negative"));
    }
    if (airframe.target == Px4Target::flight) {
        return;  // which pin drives which motor is the builder's to say
    }
    const std::string output = airframe.target == Px4Target::sitl ? "PWM_MAIN" : "HIL_ACT";
    for (std::size_t i = 1; i <= count; ++i) {
        add(settings, fmt::format("{}_FUNC{}", output, i), 100.0 + static_cast<double>(i),
            fmt::format("channel {} of HIL_ACTUATOR_CONTROLS is motor {}", i - 1, i));
    }
}

void add_control(const Px4Airframe& airframe, Settings& settings) {
    for (const auto& row : autopilot::autopilot_table()) {
        const bool control = row.name.starts_with("MPC_") || row.name.starts_with("MC_") ||
                             row.name.starts_with("IMU_");
        if (!control) {
            continue;
        }
        const Px4Fact* fact = find_px4_fact(row.name);
        require(fact != nullptr, "control's parameters are PX4's");
        const double value = row.get(airframe.autopilot);
        if (static_cast<float>(value) != static_cast<float>(fact->default_value)) {
            add(settings, std::string(row.name), value,
                fmt::format("{}; PX4's default is {:g}", row.description, fact->default_value));
        }
    }
}

/// A part of settings.json.
void add_part(const char* part, const Px4Airframe& airframe, Settings& settings) {
    static const auto parts = nlohmann::json::parse(kSettingsJson);
    for (const auto& row : parts.at(part)) {
        const std::string name = row.at("name");
        const auto* ours = find_named(autopilot::autopilot_table(), name);
        require(row.contains("value") || ours != nullptr, "a setting has a value");
        add(settings, name,
            row.contains("value") ? row.at("value").get<double>() : ours->get(airframe.autopilot),
            row.at("reason"), row.value("fixed", false));
    }
}

}  // namespace

Px4Frame px4_frame(const Px4Airframe& airframe) {
    const RotorList<autopilot::RotorGeometry>& rotors = airframe.rotors;
    const double plane_m = rotors.empty() ? 0.0 : rotors[0].p_B_m.z();
    const bool coaxial = std::any_of(rotors.begin(), rotors.end(),
                                     [&](const auto& rotor) { return rotor.p_B_m.z() != plane_m; });
    switch (rotors.size()) {
        case 4: return {"a quadrotor", "Quadrotor x"};
        case 6: return {"a hexarotor", coaxial ? "Hexarotor Coaxial" : "Hexarotor x"};
        case 8: return {"an octorotor", coaxial ? "Octorotor Coaxial" : "Octorotor x"};
        case 12: return {"a dodecarotor", "Dodecarotor cox"};
        default: return {"so many rotors", "Copter"};
    }
}

std::vector<Px4Setting> px4_settings(const Px4Airframe& airframe) {
    if (airframe.id < kFirstOwnId || airframe.id > kLastOwnId) {
        throw InputError(fmt::format("airframe id {}: PX4 keeps {} .. {} for a user's own models",
                                     airframe.id, kFirstOwnId, kLastOwnId));
    }
    Settings settings;
    add_rotors(airframe, settings);
    add_part("thrust", airframe, settings);
    add_control(airframe, settings);
    add(settings, "BAT1_N_CELLS", airframe.battery_cells, "cells in series");
    add(settings, "BAT1_CAPACITY", airframe.battery_capacity_Ah * 1000.0, "mAh");
    add_part(airframe.pose == Px4Pose::gps ? "gps" : "motion_capture", airframe, settings);
    if (airframe.perches) {
        add_part("perching", airframe, settings);
    }
    add_part("offboard", airframe, settings);
    if (airframe.target != Px4Target::flight) {
        add_part("simulation", airframe, settings);
    }
    if (airframe.target == Px4Target::hitl) {
        add_part("simulation_on_a_board", airframe, settings);
    }
    if (airframe.target != Px4Target::sitl) {
        add_part("companion", airframe, settings);
    }
    return settings;
}

const Px4Fact* find_px4_fact(std::string_view name) {
    static const Facts facts = read_facts();
    const auto found = facts.find(name);
    return found == facts.end() ? nullptr : &found->second;
}

}  // namespace limpet::px4
