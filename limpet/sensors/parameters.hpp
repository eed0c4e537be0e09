// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/parameters.hpp"

namespace limpet {

/// For a fault that does not happen [s].
inline constexpr double kNever_s = 1e9;

/// Every sensor's rate, noise, bias, latency and faults. Noise and bias are standard deviations; a
/// rate of 0 means that the sensor is not fitted. Sources: sensor_table(), from facts.md section 2.
struct SensorParameters {
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

    int baro_rate_Hz = 50;
    double baro_noise_Pa = 1.0;
    double baro_bias_Pa = 1.2;

    int mag_rate_Hz = 100;
    double mag_noise_gauss = 0.004;
    double mag_bias_gauss = 0.002;
    double mag_field_gauss = 0.479;
    double mag_inclination_deg = 63.2;
    double mag_declination_deg = 0.0;

    int gps_rate_Hz = 5;
    double gps_latency_s = 0.11;
    double gps_noise_horizontal_m = 0.05;
    double gps_noise_vertical_m = 0.10;
    double gps_drift_horizontal_m = 0.5;
    double gps_drift_vertical_m = 0.75;
    double gps_drift_tau_s = 60.0;
    double gps_noise_horizontal_m_s = 0.09;
    double gps_noise_vertical_m_s = 0.18;

    int mocap_rate_Hz = 120;
    double mocap_latency_s = 0.02;
    double mocap_position_noise_m = 0.0005;
    double mocap_attitude_noise_deg = 0.1;
    double mocap_dropout_probability = 0.0;
    double mocap_fails_at_s = kNever_s;

    int lidar_rate_Hz = 100;
    double lidar_latency_s = 0.01;
    double lidar_range_min_m = 0.1;
    double lidar_range_max_m = 12.0;
    double lidar_resolution_m = 0.005;
    double lidar_noise_m = 0.005;
    double lidar_bias_m = 0.002;
    double lidar_dropout_probability = 0.001;
    double lidar_left_fails_at_s = kNever_s;
    double lidar_right_fails_at_s = kNever_s;

    int force_rate_Hz = 250;
    double force_noise_N = 0.2;
    double force_bias_N = 0.1;
    double force_range_N = 200.0;
    double force_fails_at_s = kNever_s;

    int pressure_rate_Hz = 100;
    double pressure_noise_Pa = 100.0;
    double pressure_bias_Pa = 50.0;
    double pressure_range_min_Pa = 1000.0;
    double pressure_range_max_Pa = 120000.0;
    double pressure_resolution_Pa = 2.0;
    double pressure_stuck_at_s = kNever_s;

    int battery_rate_Hz = 10;
};

/// Table behind the YAML section `sensors`. Its upper limits of rate and latency keep the samples
/// under way below kDelayLineCapacity (delay_line.hpp).
[[nodiscard]] const ParameterTable<SensorParameters>& sensor_table();

}  // namespace limpet
