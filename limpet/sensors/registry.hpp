// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/core/type_list.hpp"
#include "limpet/sensors/barometer.hpp"
#include "limpet/sensors/battery.hpp"
#include "limpet/sensors/force.hpp"
#include "limpet/sensors/gps.hpp"
#include "limpet/sensors/imu.hpp"
#include "limpet/sensors/lidar.hpp"
#include "limpet/sensors/magnetometer.hpp"
#include "limpet/sensors/motion_capture.hpp"
#include "limpet/sensors/pressure.hpp"

namespace limpet::sensors {

/// Every sensor; what one has to say stands in sensor.hpp.
using Sensors = TypeList<ImuSensor,            //
                         BarometerSensor,      //
                         MagnetometerSensor,   //
                         GpsSensor,            //
                         MotionCaptureSensor,  //
                         LidarSensor,          //
                         ForceSensor,          //
                         PressureSensor,       //
                         BatterySensor>;

/// Every sensor's rate, noise, bias and latency. Sources: their tables, from facts.md section 2.
struct SensorParameters : ParametersOf<Sensors> {};

/// Rows of the YAML section `sensors`. Their upper limits of rate and latency keep the samples
/// under way below kDelayLineCapacity (sensor.hpp).
/// @param sensors  must outlive what is returned
[[nodiscard]] std::vector<BoundParameter> sensor_rows(SensorParameters& sensors);

/// How often each sensor samples [Hz]; 0: not fitted.
[[nodiscard]] std::vector<int> rates_Hz(const SensorParameters& sensors);

}  // namespace limpet::sensors
