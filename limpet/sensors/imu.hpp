// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Gyroscope and accelerometer at B's origin, axes of B.
///
/// An integrating sampler: a sample is the mean over the interval since the last one, from the
/// vehicle's velocity and attitude at both ends. No plant has to offer accelerations, none is
/// missed between two samples, and a strapdown integration of the samples gives the motion back.
/// Turning and accelerating at once within an interval T leaves an error of second order in T.
struct ImuState {
    RandomStream random;
    Vector3 gyro_turn_on_rad_s = Vector3::Zero();
    Vector3 accel_turn_on_m_s2 = Vector3::Zero();
    Vector3 gyro_bias_rad_s = Vector3::Zero();  ///< wandering part
    Vector3 accel_bias_m_s2 = Vector3::Zero();  ///< wandering part
    Vector3 v_WB_m_s = Vector3::Zero();         ///< at the last sample
    Quaternion q_WB = Quaternion::Identity();   ///< at the last sample
    double time_s = 0.0;                        ///< of the last sample
};

[[nodiscard]] ImuState start_imu(const SensorParameters& parameters, const Truth& truth,
                                 const RandomStream& random);

/// A sample at the very start has no interval: it measures a vehicle that does not accelerate.
void sense_imu(const SensorParameters& parameters, ImuState& state, const Truth& truth, Tick tick,
               Sample<ImuReading>& reading);

}  // namespace limpet
