// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/parameters.hpp"

namespace limpet {
namespace {

using P = SensorParameters;

}  // namespace

// clang-format off
const ParameterTable<SensorParameters>& sensor_table() {
    static const ParameterTable<P> table = {
        {"imu_rate_Hz", "Hz", 50.0, 1000.0, &P::imu_rate_Hz, "samples a second; estimator and control run with it", "PX4 HIL worlds/hitl_iris.world: 4 ms"},
        {"gyro_noise_density_rad_s_rtHz", "rad/s/rtHz", 0.0, 0.1, &P::gyro_noise_density_rad_s_rtHz, "white noise of the rates", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_bias_walk_rad_s2_rtHz", "rad/s^2/rtHz", 0.0, 0.1, &P::gyro_bias_walk_rad_s2_rtHz, "random walk that drives the rates' bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_bias_tau_s", "s", 1.0, 1e9, &P::gyro_bias_tau_s, "correlation time of that bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_turn_on_bias_rad_s", "rad/s", 0.0, 1.0, &P::gyro_turn_on_bias_rad_s, "constant bias of a flight, each axis", "assumed: a tenth of the raw 8.7e-3 is left after the autopilot's calibration"},
        {"gyro_range_rad_s", "rad/s", 0.1, 1e3, &P::gyro_range_rad_s, "saturates at, each axis", "ADIS16448: 1000 deg/s, recalled"},
        {"accel_noise_density_m_s2_rtHz", "m/s^2/rtHz", 0.0, 1.0, &P::accel_noise_density_m_s2_rtHz, "white noise of the specific force", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_bias_walk_m_s3_rtHz", "m/s^3/rtHz", 0.0, 1.0, &P::accel_bias_walk_m_s3_rtHz, "random walk that drives the specific force's bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_bias_tau_s", "s", 1.0, 1e9, &P::accel_bias_tau_s, "correlation time of that bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_turn_on_bias_m_s2", "m/s^2", 0.0, 5.0, &P::accel_turn_on_bias_m_s2, "constant bias of a flight, each axis", "assumed: a tenth of the raw 0.196 is left after the autopilot's calibration"},
        {"accel_range_m_s2", "m/s^2", 10.0, 1e4, &P::accel_range_m_s2, "saturates at, each axis", "ADIS16448: 18 g, recalled"},

        {"baro_rate_Hz", "Hz", 0.0, 1000.0, &P::baro_rate_Hz, "samples a second; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"baro_noise_Pa", "Pa", 0.0, 1000.0, &P::baro_noise_Pa, "white noise", "PX4 Gazebo Classic barometer plugin, recalled"},
        {"baro_bias_Pa", "Pa", 0.0, 10000.0, &P::baro_bias_Pa, "constant bias of a flight", "assumed: 0.1 m is left after zeroing on the ground"},

        {"mag_rate_Hz", "Hz", 0.0, 1000.0, &P::mag_rate_Hz, "samples a second; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"mag_noise_gauss", "gauss", 0.0, 1.0, &P::mag_noise_gauss, "white noise, each axis", "PX4 Gazebo Classic: 4e-4 gauss/rtHz at 100 Hz"},
        {"mag_bias_gauss", "gauss", 0.0, 1.0, &P::mag_bias_gauss, "constant bias of a flight, each axis", "assumed: left after calibration"},
        {"mag_field_gauss", "gauss", 0.01, 1.0, &P::mag_field_gauss, "strength of the field", "Zurich, World Magnetic Model, recalled"},
        {"mag_inclination_deg", "deg", -90.0, 90.0, &P::mag_inclination_deg, "how far the field dips below the horizon", "Zurich, World Magnetic Model, recalled"},
        {"mag_declination_deg", "deg", -180.0, 180.0, &P::mag_declination_deg, "how far east of x_W the field points", "assumed: x_W is magnetic north"},

        {"gps_rate_Hz", "Hz", 0.0, 20.0, &P::gps_rate_Hz, "samples a second; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"gps_latency_s", "s", 0.0, 0.5, &P::gps_latency_s, "from measurement to arrival", "EKF2_GPS_DELAY 110 ms"},
        {"gps_noise_horizontal_m", "m", 0.0, 100.0, &P::gps_noise_horizontal_m, "white noise of north and east", "assumed: small beside the drift"},
        {"gps_noise_vertical_m", "m", 0.0, 100.0, &P::gps_noise_vertical_m, "white noise of height", "assumed: twice the horizontal one"},
        {"gps_drift_horizontal_m", "m", 0.0, 100.0, &P::gps_drift_horizontal_m, "slow wander of north and east", "assumed: EKF2_GPS_P_NOISE 0.5 m"},
        {"gps_drift_vertical_m", "m", 0.0, 100.0, &P::gps_drift_vertical_m, "slow wander of height", "assumed: 1.5 times the horizontal one"},
        {"gps_drift_tau_s", "s", 1.0, 1e9, &P::gps_drift_tau_s, "correlation time of the wander", "PX4 Gazebo Classic GPS plugin: 60 s"},
        {"gps_noise_horizontal_m_s", "m/s", 0.0, 10.0, &P::gps_noise_horizontal_m_s, "white noise of the horizontal velocity", "PX4 Gazebo Classic GPS plugin: 0.2 at 5 Hz"},
        {"gps_noise_vertical_m_s", "m/s", 0.0, 10.0, &P::gps_noise_vertical_m_s, "white noise of the vertical velocity", "PX4 Gazebo Classic GPS plugin: 0.4 at 5 Hz"},

        {"mocap_rate_Hz", "Hz", 0.0, 240.0, &P::mocap_rate_Hz, "samples a second; 0: not fitted", "OptiTrack 120-240 Hz, facts.md section 2"},
        {"mocap_latency_s", "s", 0.0, 0.25, &P::mocap_latency_s, "from exposure to arrival", "assumed: 4 ms camera, 10-40 ms WiFi and ROS"},
        {"mocap_position_noise_m", "m", 0.0, 1.0, &P::mocap_position_noise_m, "white noise, each axis", "OptiTrack 0.12-0.74 mm, arXiv 2502.21189"},
        {"mocap_attitude_noise_deg", "deg", 0.0, 45.0, &P::mocap_attitude_noise_deg, "white noise, each axis of B", "assumed: 0.5 mm over 0.3 m of markers"},
        {"mocap_dropout_probability", "-", 0.0, 1.0, &P::mocap_dropout_probability, "share of samples that never arrive", "assumed: none in a clear volume"},
        {"mocap_fails_at_s", "s", 0.0, kNever_s, &P::mocap_fails_at_s, "fault: no sample from then on", "fault injection; the default is never"},

        {"lidar_rate_Hz", "Hz", 0.0, 1000.0, &P::lidar_rate_Hz, "samples a second; 0: not fitted", "TFmini Plus, default rate"},
        {"lidar_latency_s", "s", 0.0, 0.05, &P::lidar_latency_s, "from measurement to arrival", "assumed: one frame"},
        {"lidar_range_min_m", "m", 0.0, 10.0, &P::lidar_range_min_m, "no echo below", "TFmini Plus data sheet"},
        {"lidar_range_max_m", "m", 0.1, 1000.0, &P::lidar_range_max_m, "no echo above", "TFmini Plus data sheet, 90 % reflectivity, indoors"},
        {"lidar_resolution_m", "m", 0.0, 1.0, &P::lidar_resolution_m, "step of the reading; 0: none", "TFmini Plus data sheet"},
        {"lidar_noise_m", "m", 0.0, 1.0, &P::lidar_noise_m, "white noise", "assumed, facts.md section 2: one step"},
        {"lidar_bias_m", "m", 0.0, 1.0, &P::lidar_bias_m, "constant bias of a flight, each unit", "assumed: left of the data sheet's 5 cm after calibrating one against the other"},
        {"lidar_dropout_probability", "-", 0.0, 1.0, &P::lidar_dropout_probability, "share of samples without an echo", "assumed: one in a thousand"},
        {"lidar_left_fails_at_s", "s", 0.0, kNever_s, &P::lidar_left_fails_at_s, "fault: no sample from then on", "fault injection; the default is never"},
        {"lidar_right_fails_at_s", "s", 0.0, kNever_s, &P::lidar_right_fails_at_s, "fault: no sample from then on", "fault injection; the default is never"},

        {"force_rate_Hz", "Hz", 0.0, 1000.0, &P::force_rate_Hz, "samples a second; 0: not fitted", "assumed: load cell 80-500 Hz"},
        {"force_noise_N", "N", 0.0, 100.0, &P::force_noise_N, "white noise", "assumed: load cell, facts.md section 2"},
        {"force_bias_N", "N", 0.0, 100.0, &P::force_bias_N, "constant bias of a flight", "assumed: left after taring"},
        {"force_range_N", "N", 1.0, 1e5, &P::force_range_N, "saturates at, either way", "assumed: load cell, facts.md section 2"},
        {"force_fails_at_s", "s", 0.0, kNever_s, &P::force_fails_at_s, "fault: no sample from then on", "fault injection; the default is never"},

        {"pressure_rate_Hz", "Hz", 0.0, 1000.0, &P::pressure_rate_Hz, "samples a second; 0: not fitted", "assumed: 50-100 Hz, facts.md section 2"},
        {"pressure_noise_Pa", "Pa", 0.0, 10000.0, &P::pressure_noise_Pa, "white noise", "assumed: 1 hPa, facts.md section 2"},
        {"pressure_bias_Pa", "Pa", 0.0, 10000.0, &P::pressure_bias_Pa, "constant bias of a flight", "assumed: half the noise"},
        {"pressure_range_min_Pa", "Pa", 0.0, 1e5, &P::pressure_range_min_Pa, "reads no less", "MS5803-01 class: 10 hPa"},
        {"pressure_range_max_Pa", "Pa", 1e5, 1e6, &P::pressure_range_max_Pa, "reads no more", "assumed: MS5803-01 class"},
        {"pressure_resolution_Pa", "Pa", 0.0, 10000.0, &P::pressure_resolution_Pa, "step of the reading; 0: none", "assumed: MS5803-01 class"},
        {"pressure_stuck_at_s", "s", 0.0, kNever_s, &P::pressure_stuck_at_s, "fault: from then on the last value, ever anew", "fault injection; the default is never"},

        {"battery_rate_Hz", "Hz", 0.0, 1000.0, &P::battery_rate_Hz, "samples a second; 0: not fitted", "assumed: a power module"},
    };
    return table;
}
// clang-format on

}  // namespace limpet
