// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/airframe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/px4/data.hpp"

namespace limpet::px4 {
namespace {

using Settings = std::vector<Px4Setting>;

/// In the order of their numbers, which stay: new ones at the end.
constexpr std::array<std::string_view, 5> kShipped = {"perching_uav", "perching_hexa",
                                                      "perching_x8", "iris", "cad_uav"};
constexpr int kShippedFrom = kFirstOwnAirframe + 1;

/// @throws InputError when PX4 would call the value out of range
void require_in_range(const std::string& name, double value, const Px4Fact& fact) {
    if (!(value >= fact.minimum && value <= fact.maximum)) {
        throw InputError(fmt::format("{} = {:g}: PX4 allows {:g} .. {:g}", name, value,
                                     fact.minimum, fact.maximum));
    }
}

void add(Settings& settings, const std::string& name, double value, std::string reason,
         bool fixed = false) {
    const Px4Fact* fact = find_px4_fact(name);
    require(fact != nullptr, "every parameter that is set is in parameters.json");
    require_in_range(name, value, *fact);
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

/// In lockstep each HIL_SENSOR is answered, or PX4 stops: its logger, a lockstep component, waits
/// for an attitude a sample, and so for as many integrals (IMU_INTEG_RATE: 250 in simulation), and
/// its motors for as many rates (IMU_GYRO_RATEMAX: 400). Its start script sets the first one after
/// the airframe. Source: PX4 v1.15, px4-rc.simulator, logger.cpp, VehicleAngularVelocity.cpp
void add_imu_rate(const Px4Airframe& airframe, Settings& settings) {
    constexpr double kIntegralsInSimulation_Hz = 250.0;
    const double rate_Hz = airframe.imu_rate_Hz;
    if (rate_Hz > kIntegralsInSimulation_Hz) {
        add(settings, "IMU_INTEG_RATE", find_px4_fact("IMU_INTEG_RATE")->maximum,
            fmt::format("an integral for each of {:g} samples a second, in lockstep", rate_Hz),
            true);
    }
    if (const Px4Fact* most = find_px4_fact("IMU_GYRO_RATEMAX"); rate_Hz > most->default_value) {
        add(settings, "IMU_GYRO_RATEMAX", most->maximum,
            fmt::format("motors for each of {:g} samples a second, in lockstep", rate_Hz));
    }
}

}  // namespace

int px4_airframe_id(std::string_view vehicle) {
    constexpr int kOthersFrom = kFirstOwnAirframe + 100;
    const auto* const found = std::find(kShipped.begin(), kShipped.end(), vehicle);
    if (found != kShipped.end()) {
        return kShippedFrom + static_cast<int>(found - kShipped.begin());
    }
    constexpr auto kOthers = static_cast<std::uint32_t>(kLastOwnAirframe - kOthersFrom + 1);
    std::uint32_t hash = 2166136261U;  // FNV-1a
    for (const char letter : vehicle) {
        hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
    }
    return kOthersFrom + static_cast<int>(hash % kOthers);
}

std::string_view px4_airframe_vehicle(int id) {
    const int place = id - kShippedFrom;
    return place >= 0 && place < static_cast<int>(kShipped.size())
               ? kShipped[static_cast<std::size_t>(place)]
               : std::string_view();
}

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
    if (airframe.id < kFirstOwnAirframe || airframe.id > kLastOwnAirframe) {
        throw InputError(fmt::format("airframe id {}: PX4 keeps {} .. {} for a user's own models",
                                     airframe.id, kFirstOwnAirframe, kLastOwnAirframe));
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
        if (airframe.pose == Px4Pose::motion_capture) {  // by GPS its bias would wander with it
            add_part("perching_estimator", airframe, settings);
        }
    }
    add_part("offboard", airframe, settings);
    if (airframe.target != Px4Target::flight) {
        add_part("simulation", airframe, settings);
    }
    if (airframe.target == Px4Target::sitl) {
        add_imu_rate(airframe, settings);
    }
    if (airframe.target == Px4Target::hitl) {
        add_part("simulation_on_a_board", airframe, settings);
    }
    if (airframe.target != Px4Target::sitl) {
        add_part("companion", airframe, settings);
    }
    if (airframe.version == Px4Version::main) {
        std::erase_if(settings,
                      [](const Px4Setting& setting) { return find_px4_fact(setting.name)->gone; });
    }
    return settings;
}

std::vector<Px4Setting> px4_needs() {
    Settings settings;
    add_part("perching", {}, settings);
    add_part("offboard", {}, settings);
    return settings;
}

std::vector<mavlink::ExpectedParameter> expected_parameters(
    const std::vector<Px4Setting>& settings) {
    std::vector<mavlink::ExpectedParameter> expected;
    expected.reserve(settings.size());
    for (const Px4Setting& setting : settings) {
        expected.push_back(
            {.name = setting.name, .value = setting.value, .reason = setting.reason});
    }
    return expected;
}

std::vector<mavlink::ExpectedParameter> expected_parameters(
    const Px4Airframe& airframe, const std::vector<std::string>& left_out) {
    try {
        Settings settings = px4_settings(airframe);
        std::erase_if(settings, [&](const Px4Setting& each) {
            return std::find(left_out.begin(), left_out.end(), each.name) != left_out.end();
        });
        return expected_parameters(settings);
    } catch (const InputError&) {
        return {};
    }
}

Px4Fitted fitted(const std::vector<Px4Setting>& settings, const Px4Facts& known) {
    Px4Fitted result;
    for (const Px4Setting& setting : settings) {
        const auto found = known.find(setting.name);
        if (found == known.end()) {
            result.left_out.push_back(setting.name);
            continue;
        }
        require_in_range(setting.name, setting.value, found->second);
        result.settings.push_back(setting);
        result.settings.back().type = found->second.type;
    }
    return result;
}

}  // namespace limpet::px4
