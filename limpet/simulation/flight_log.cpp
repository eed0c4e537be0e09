// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight_log.hpp"

#include <fmt/core.h>

#include "limpet/core/version.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::simulation {
namespace {

record::RecordingInfo describe(const FlightModel& model) {
    const scenario::Scenario& scenario = *model.scenario;
    record::RecordingInfo info;
    info.scenario = scenario.name;
    info.seed = scenario.seed;
    info.version = kVersion;
    if (scenario.airframe.has_cup) {
        info.numbers["land_pressure_Pa"] = fmt::format("{}", scenario.guidance.land_pressure_Pa);
        info.numbers["detach_pressure_Pa"] =
            fmt::format("{}", scenario.guidance.detach_pressure_Pa);
    }
    info.attachments.push_back(
        {.name = "scenario.yaml", .media_type = "application/yaml", .text = scenario.yaml});
    for_each_type(sensors::Sensors{}, [&](auto type) {
        using Sensor = typename decltype(type)::type;
        if constexpr (!sensors::kIsRead<Sensor>) {
            info.columns.push_back(
                {.topic = Sensor::kTopic, .type = Sensor::kMessage, .columns = Sensor::kColumns});
        }
    });
    info.attachments.push_back({.name = "model.xml",
                                .media_type = "application/xml",
                                .text = write_mjcf(scenario.airframe, scene_of(scenario))});
    info.range_sensor.minimum_m = scenario.sensors.lidar_range_min_m;
    info.range_sensor.maximum_m = scenario.sensors.lidar_range_max_m;
    return info;
}

}  // namespace

FlightLog::FlightLog(const std::filesystem::path& path, const FlightModel& model)
    : recorder_(path, describe(model)) {}

void FlightLog::tick(const FlightModel& model, const FlightState& state,
                     const guidance::EventList& events) {
    for (std::size_t k = 0; k < events.count; ++k) {
        recorder_.event(events.events[k]);
    }
    recorder_.new_readings(state.sensors.readings, last_);
    std::size_t channel = 0;
    for_each_type(sensors::Sensors{}, [&](auto type) {
        using Sensor = typename decltype(type)::type;
        if constexpr (!sensors::kIsRead<Sensor>) {
            const auto& heard = state.sensors.template units<Sensor>()[0].heard;
            recorder_.columns(channel++, heard, Sensor::numbers(heard.value));
        }
    });
    if (due(state.tick, model.record_rate_Hz)) {
        const double time_s = seconds(state.tick);
        recorder_.truth(state.truth);
        recorder_.estimate(state.autopilot.estimate);
        recorder_.setpoint(time_s, state.guidance.setpoint);
        recorder_.guidance(time_s, to_string(state.guidance.state), state.guidance.attempt);
        recorder_.rotor_command(time_s, state.command);
    }
}

}  // namespace limpet::simulation
