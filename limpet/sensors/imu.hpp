// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Gyroscope and accelerometer at B's origin, axes of B.
///
/// An integrating sampler: a sample is the mean over the interval since the last one, from the
/// vehicle's velocity and attitude at both ends. No plant has to offer accelerations, none is
/// missed between two samples, and a strapdown integration of the samples gives the motion back.
/// Turning and accelerating at once within an interval T leaves an error of second order in T.
/// A sample at the very start has no interval: it measures a vehicle that does not accelerate.
struct ImuSensor {
    using Reading = ImuReading;
    struct Parameters {
        int imu_rate_Hz = 250;
        double gyro_noise_density_rad_s_rtHz = 3.39e-4;
        double gyro_bias_walk_rad_s2_rtHz = 3.88e-5;
        double gyro_bias_tau_s = 1000.0;
        double gyro_turn_on_bias_rad_s = 8.7e-4;
        double gyro_range_rad_s = 17.45;
        double accel_noise_density_m_s2_rtHz = 4e-3;
        double accel_bias_walk_m_s3_rtHz = 6e-3;
        double accel_bias_tau_s = 300.0;
        double accel_turn_on_bias_m_s2 = 0.0196;
        double accel_range_m_s2 = 176.5;
    };
    struct State {
        RandomStream random;
        Vector3 gyro_turn_on_rad_s = Vector3::Zero();
        Vector3 accel_turn_on_m_s2 = Vector3::Zero();
        Vector3 gyro_bias_rad_s = Vector3::Zero();  ///< wandering part
        Vector3 accel_bias_m_s2 = Vector3::Zero();  ///< wandering part
        Vector3 v_EB_m_s = Vector3::Zero();         ///< against the earth, at the last sample
        Quaternion q_WB = Quaternion::Identity();   ///< at the last sample
        double time_s = 0.0;                        ///< of the last sample
        double interval_s = 0.0;                    ///< that the two below are for
        GaussMarkov gyro_wander = {};
        GaussMarkov accel_wander = {};
    };
    static constexpr std::array kStreams = {Stream::imu};
    static constexpr std::array kReadings = {&Readings::imu};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::imu_rate_Hz;
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    [[nodiscard]] static State start(const Parameters& p, const RandomStream& random,
                                     const Truth& truth);
    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view);
};

}  // namespace limpet::sensors
