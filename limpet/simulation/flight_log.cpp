// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight_log.hpp"

#include <fmt/core.h>

#include "limpet/core/version.hpp"

namespace limpet {
namespace {

RecordingInfo describe(const SimulationModel& model) {
    const Scenario& scenario = model.scenario;
    RecordingInfo info;
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
    info.attachments.push_back(
        {.name = "model.xml", .media_type = "application/xml", .text = model.mjcf});
    info.range_sensor.minimum_m = scenario.sensors.lidar_range_min_m;
    info.range_sensor.maximum_m = scenario.sensors.lidar_range_max_m;
    return info;
}

}  // namespace

FlightLog::FlightLog(const std::filesystem::path& path, const SimulationModel& model)
    : recorder_(path, describe(model)) {}

void FlightLog::sensors(const Readings& readings) {
    const auto when_new = [&](const auto& sample, auto& last, auto write) {
        if (sample.time_s > last.time_s) {
            (recorder_.*write)(sample);
            last.time_s = sample.time_s;
        }
    };
    when_new(readings.imu, last_.imu, &Recorder::imu);
    when_new(readings.lidar_left, last_.lidar_left, &Recorder::range_left);
    when_new(readings.lidar_right, last_.lidar_right, &Recorder::range_right);
    when_new(readings.force, last_.force, &Recorder::force);
    when_new(readings.cup_pressure, last_.cup_pressure, &Recorder::cup_pressure);
    when_new(readings.motion_capture, last_.motion_capture, &Recorder::motion_capture);
    when_new(readings.barometer, last_.barometer, &Recorder::barometer);
    when_new(readings.battery, last_.battery, &Recorder::battery);
}

void FlightLog::tick(const SimulationModel& model, const SimulationState& state,
                     const EventList& events) {
    for (std::size_t k = 0; k < events.count; ++k) {
        recorder_.event(events.events[k]);
    }
    sensors(state.sensors.readings);
    if (due(state.tick, model.record_rate_Hz)) {
        const double time_s = seconds(state.tick);
        recorder_.truth(state.truth);
        recorder_.estimate(state.autopilot.estimate);
        recorder_.setpoint(time_s, state.guidance.setpoint);
        recorder_.guidance(time_s, to_string(state.guidance.state), state.guidance.attempt);
        recorder_.rotor_command(time_s, state.command);
    }
}

}  // namespace limpet
