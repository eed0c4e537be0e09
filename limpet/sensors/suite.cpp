// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/suite.hpp"

#include "limpet/sensors/noise.hpp"

namespace limpet {
namespace {

/// The power module's own error is far below what anybody decides on: none is added.
void sense_battery(const SensorParameters& parameters, const Truth& truth, Tick tick,
                   Sample<BatteryReading>& reading) {
    if (sampled(tick, parameters.battery_rate_Hz)) {
        reading.time_s = truth.time_s;
        reading.value = {.voltage_V = truth.battery.voltage_V,
                         .current_A = truth.battery.current_A,
                         .remaining = truth.battery.remaining};
    }
}

}  // namespace

SensorsState start(const SensorsModel& model, const Truth& truth, std::uint64_t seed,
                   std::uint32_t run) {
    const SensorParameters& parameters = model.parameters;
    const auto stream = [&](Stream name) { return RandomStream(seed, run, name); };
    return {.imu = start_imu(parameters, truth, stream(Stream::imu)),
            .barometer = start_barometer(parameters, stream(Stream::barometer)),
            .magnetometer = start_magnetometer(parameters, stream(Stream::magnetometer)),
            .gps = start_gps(parameters, stream(Stream::gps)),
            .motion_capture = start_motion_capture(stream(Stream::motion_capture)),
            .lidar_left = start_lidar(parameters, stream(Stream::lidar_left)),
            .lidar_right = start_lidar(parameters, stream(Stream::lidar_right)),
            .force = start_force(parameters, stream(Stream::force)),
            .pressure = start_pressure(parameters, stream(Stream::pressure)),
            .readings = {}};
}

void sense(const SensorsModel& model, SensorsState& state, const Truth& truth, const Plant& plant,
           Tick tick) {
    const SensorParameters& parameters = model.parameters;
    Readings& readings = state.readings;
    sense_imu(parameters, state.imu, truth, tick, readings.imu);
    sense_barometer(parameters, state.barometer, truth, tick, readings.barometer);
    sense_magnetometer(parameters, state.magnetometer, truth, tick, readings.magnetometer);
    sense_gps(parameters, state.gps, truth, tick, readings.gps);
    sense_motion_capture(parameters, state.motion_capture, truth, tick, readings.motion_capture);
    sense_battery(parameters, truth, tick, readings.battery);
    if (model.has_cup) {
        const LidarMount left = {model.lidar_left_p_B_m, parameters.lidar_left_fails_at_s};
        const LidarMount right = {model.lidar_right_p_B_m, parameters.lidar_right_fails_at_s};
        sense_lidar(parameters, left, state.lidar_left, truth, plant, tick, readings.lidar_left);
        sense_lidar(parameters, right, state.lidar_right, truth, plant, tick, readings.lidar_right);
        sense_force(parameters, state.force, truth, tick, readings.force);
        sense_pressure(parameters, state.pressure, truth, tick, readings.cup_pressure);
    }
}

}  // namespace limpet
