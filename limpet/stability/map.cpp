// SPDX-License-Identifier: Apache-2.0
#include "limpet/stability/map.hpp"

#include <fmt/format.h>

#include "limpet/core/errors.hpp"
#include "limpet/plant/reduced_plant.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::stability {

std::optional<Mode> linear_swing(const std::string& scenario, const Overrides& overrides) {
    scenario::Scenario waits = scenario::load_scenario(scenario, {.overrides = overrides});
    const char* const lacks = !waits.airframe.has_cup                ? "a vehicle with a cup"
                              : !waits.wall.present                  ? "a wall"
                              : waits.mount != vehicle::Mount::free  ? "a free vehicle"
                              : waits.airframe.payload.mass_kg > 0.0 ? "a vehicle without a payload"
                              : waits.autopilot_kind != &autopilot::kCascade
                                  ? "the autopilot 'cascade'"
                                  : nullptr;
    if (lacks != nullptr) {
        throw InputError(fmt::format("{}: the swing on the cup needs {}", waits.name, lacks));
    }
    for (const std::string& change : overrides) {
        if (waits.airframe.rotor.motor_kv_rpm_V > 0.0 &&
            change.starts_with("vehicle.rotor.time_constant_")) {
            throw InputError(fmt::format(
                "{}: the vehicle's motors go by motor_kv_rpm_V, which leaves no time constants",
                change));
        }
    }
    waits.engine = &plant::kReducedEngine;  // whose bodies can be displaced
    // What pushes by chance, or to and fro, leaves no rest, and no slope: motors faster up than
    // down stand on a corner.
    waits.environment.wind.gust_wind_m_s = 0.0;
    waits.environment.wind.gust_sigma_m_s = 0.0;
    waits.environment.wall_air.recirculation_moment_rms_N_m = 0.0;
    waits.environment.swell = {};
    const auto model = simulation::build_model(waits);
    if (kTicksPerSecond % model->control_rate_Hz != 0) {
        throw InputError(fmt::format(
            "{}: the swing on the cup needs sensors.imu_rate_Hz that divides {}, not {}",
            waits.name, kTicksPerSecond, model->control_rate_Hz));
    }
    const auto modes = LevelOnCup(model).modes();
    return modes ? pitch_mode(*modes) : std::nullopt;
}

Overrides StabilityMap::point(std::size_t i) const {
    Overrides all = changes;
    const auto set = [&all](const Axis& axis, std::size_t place) {
        for (const std::string& key : axis.keys) {
            all.push_back(fmt::format("{}={}", key, axis.values[place]));
        }
    };
    set(across, i % across.values.size());
    set(up, i / across.values.size());
    return all;
}

std::optional<Mode> swing_at(const StabilityMap& map, std::size_t i) {
    return linear_swing(map.scenario, map.point(i));
}

}  // namespace limpet::stability
