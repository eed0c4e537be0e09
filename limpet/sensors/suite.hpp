// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/sensors/barometer.hpp"
#include "limpet/sensors/force.hpp"
#include "limpet/sensors/gps.hpp"
#include "limpet/sensors/imu.hpp"
#include "limpet/sensors/lidar.hpp"
#include "limpet/sensors/magnetometer.hpp"
#include "limpet/sensors/motion_capture.hpp"
#include "limpet/sensors/parameters.hpp"
#include "limpet/sensors/pressure.hpp"

namespace limpet {

/// The vehicle's sensors: what they are and where they sit.
struct SensorsModel {
    SensorParameters parameters;
    bool has_cup = true;  ///< LiDARs, force and pressure belong to the perching mechanism
    Vector3 lidar_left_p_B_m = {0.205, -0.205, 0.0};
    Vector3 lidar_right_p_B_m = {0.205, 0.205, 0.0};
};

/// Everything that changes while they measure. Each sensor draws from a stream of its own, and as
/// many numbers a sample whatever its parameters: changing one leaves the others' readings as they
/// were.
struct SensorsState {
    ImuState imu;
    BarometerState barometer;
    MagnetometerState magnetometer;
    GpsState gps;
    MotionCaptureState motion_capture;
    LidarState lidar_left;
    LidarState lidar_right;
    ForceState force;
    PressureState pressure;
    Readings readings;  ///< what has arrived so far
};

/// Switches the sensors on: draws the biases of this flight. No reading yet.
/// @param truth  at the start, the first end of the IMU's first interval
[[nodiscard]] SensorsState start(const SensorsModel& model, const Truth& truth, std::uint64_t seed,
                                 std::uint32_t run);

/// Takes the samples that are due and hands out those that arrive. Once every base tick, in order.
/// @param truth  of this tick
/// @param plant  for the LiDARs' rays, at the same instant as `truth`
void sense(const SensorsModel& model, SensorsState& state, const Truth& truth, const Plant& plant,
           Tick tick);

}  // namespace limpet
