// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>

#include "limpet/autopilot/estimator.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet::autopilot {

using Motion = std::function<Kinematics(double time_s)>;

/// Figure of eight with heave, turning heading and tilt that does not fit the acceleration: excites
/// every error.
[[nodiscard]] Kinematics figure_of_eight(double time_s);
/// At rest with this pitch, as perched.
[[nodiscard]] Motion hanging(double pitch_rad);

/// Standard deviations and densities of simulated sensors, exactly as the filter assumes them.
struct SensorNoise {
    double gyro_rad_s_rtHz = 3.39e-4;
    double accelerometer_m_s2_rtHz = 4e-3;
    double gyro_bias_rad_s2_rtHz = 3.88e-5;
    double accelerometer_bias_m_s3_rtHz = 6e-3;
    double motion_capture_m = 5e-4;
    double motion_capture_rad = 1.745e-3;
    double motion_capture_latency_s = 0.02;
    double gps_m = 0.5;
    double gps_m_s = 0.3;
    double gps_latency_s = 0.11;
    double barometer_m = 0.5;
    double magnetometer_gauss = 0.005;
};

/// The filter's parameters for that noise, with motion capture or with GPS, barometer and
/// magnetometer.
[[nodiscard]] AutopilotParameters matched_to(const SensorNoise& noise);
[[nodiscard]] AutopilotParameters matched_to_without_motion_capture(const SensorNoise& noise);

/// Sensors carried along a motion: IMU 250 Hz, motion capture 120 Hz, GPS 5 Hz, barometer 50 Hz,
/// magnetometer 100 Hz; stamps off the IMU's grid, arrival late.
class SensedFlight {
public:
    SensedFlight(Motion motion, const SensorNoise& noise, RandomStream random);

    /// Goes on by one IMU sample.
    void step();
    /// Truth less `state`'s belief.
    [[nodiscard]] ErrorVector error(const EstimatorState& state) const;

    SensorNoise noise;
    double time_s = 0.0;
    Kinematics truth;
    Vector3 gyro_bias_rad_s = Vector3::Zero();
    Vector3 accelerometer_bias_m_s2 = Vector3::Zero();
    Readings readings;

private:
    void sense_imu(const Kinematics& from);
    void send();

    Motion motion_;
    RandomStream random_;
    int motion_captures_ = 0;
    int gps_fixes_ = 0;
    int barometer_samples_ = 0;
    int magnetometer_samples_ = 0;
    std::deque<Sample<PoseReading>> poses_;
    std::deque<Sample<GpsReading>> fixes_;
};

/// An initial belief whose errors are drawn from the variances that it states.
[[nodiscard]] Estimate draw_initial(const AutopilotParameters& parameters, SensedFlight& flight,
                                    RandomStream& random);

}  // namespace limpet::autopilot
