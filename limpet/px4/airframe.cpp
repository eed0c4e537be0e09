// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/airframe.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/px4/data.hpp"

namespace limpet::px4 {
namespace {

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

void add_rotors(const Px4Airframe& airframe, Settings& settings) {
    constexpr std::array<std::string_view, kRotors> kPlace = {"front right", "rear left",
                                                              "front left", "rear right"};
    add(settings, "CA_AIRFRAME", 0, "a multirotor");
    add(settings, "CA_ROTOR_COUNT", kRotors, "a quadrotor");
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        const autopilot::RotorGeometry& rotor = airframe.rotors[i];
        const std::string prefix = fmt::format("CA_ROTOR{}_", i);
        add(settings, prefix + "PX", rotor.p_B_m.x(),
            fmt::format("{} hub, m forward of the centre of mass", kPlace[i]));
        add(settings, prefix + "PY", rotor.p_B_m.y(),
            fmt::format("{} hub, m right of the centre of mass", kPlace[i]));
        add(settings, prefix + "KM", rotor.direction * rotor.moment_constant_m,
            fmt::format("torque over thrust, m; turns {}", rotor.direction > 0
                                                               ? "counter-clockwise: positive"
                                                               : "clockwise: negative"));
    }
    if (airframe.target == Px4Target::flight) {
        return;  // which pin drives which motor is the builder's to say
    }
    const std::string output = airframe.target == Px4Target::sitl ? "PWM_MAIN" : "HIL_ACT";
    for (int i = 1; i <= kRotors; ++i) {
        add(settings, fmt::format("{}_FUNC{}", output, i), 100 + i,
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

std::vector<Px4Setting> px4_settings(const Px4Airframe& airframe) {
    if (airframe.id < kFirstOwnId || airframe.id > kLastOwnId) {
        throw InputError(fmt::format("airframe id {}: PX4 keeps {} .. {} for models of one's own",
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

}  // namespace limpet::px4
