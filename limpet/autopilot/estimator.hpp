// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "limpet/autopilot/aiding.hpp"
#include "limpet/autopilot/kalman.hpp"
#include "limpet/autopilot/navigation.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet::autopilot {

/// Error-state Kalman filter over the IMU and what aids it: motion capture, or GPS, barometer and
/// magnetometer, or all. It lives in the present; late measurements are dealt with in aiding.hpp.
/// Source of the error model: Sola, "Quaternion kinematics for the error-state Kalman filter",
/// 2017.
struct EstimatorState {
    static constexpr double kNever = -std::numeric_limits<double>::infinity();

    double time_s = 0.0;  ///< of the last IMU sample
    Navigation navigation;
    ImuReading imu;  ///< the last sample, biases in it
    ImuHistory history;
    Covariance covariance = Covariance::Zero();
    double covariance_s = 0.0;   ///< when the covariance is of
    Navigation covariance_from;  ///< the state then

    double motion_capture_s = kNever;  ///< stamps of the last samples seen
    double gps_s = kNever;
    double barometer_s = kNever;
    double magnetometer_s = kNever;
    PoseReading motion_capture;  ///< the last one seen
    bool motion_capture_frozen = false;
    Vector3 turned_rad = Vector3::Zero();  ///< by the gyros, in the last half second or so
    Aiding motion_capture_position;
    Aiding motion_capture_attitude;
    Aiding gps_position;
    Aiding gps_velocity;
    Aiding barometer;
    Aiding magnetometer;
};

/// @param initial  time, pose, velocity and biases; a variance of 0 means: as uncertain as the
///                 parameters say, EKF2_*_INIT and the noise of the aiding chosen
[[nodiscard]] EstimatorState start_estimator(const AutopilotParameters& parameters,
                                             const Estimate& initial);

/// Takes every sample whose stamp is new; one that is not finite is as if it had not come. So is a
/// pose that repeats the last bit for bit while the gyros turn (a tracker that is frozen), and one
/// that is turned from what the gyros tell by more than half a radian (another body). Allocates
/// nothing.
void update_estimator(const AutopilotParameters& parameters, EstimatorState& state,
                      const Readings& readings);

/// Valid while position and attitude have been aided within EKF2_NOAID_TOUT.
[[nodiscard]] Estimate estimate_from(const AutopilotParameters& parameters,
                                     const EstimatorState& state);

}  // namespace limpet::autopilot
