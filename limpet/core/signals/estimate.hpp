// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/frames.hpp"

namespace limpet {

/// The autopilot's belief about the vehicle.
struct Estimate {
    double time_s = 0.0;
    double age_s = 0.0;  ///< pose and velocity are of time_s - age_s; known of a PX4 in lockstep
    Vector3 p_WB_m = Vector3::Zero();
    Vector3 v_WB_m_s = Vector3::Zero();
    Quaternion q_WB = Quaternion::Identity();
    Vector3 w_WB_B_rad_s = Vector3::Zero();           ///< gyro less its estimated bias
    Vector3 specific_force_B_m_s2 = Vector3::Zero();  ///< accelerometer less its estimated bias
    Vector3 gyro_bias_rad_s = Vector3::Zero();
    Vector3 accelerometer_bias_m_s2 = Vector3::Zero();
    /// Diagonal of the error covariance: position, velocity, attitude (rotation vector in B), gyro
    /// bias, accelerometer bias; squares of the units above.
    std::array<double, 15> variance{};
    bool valid = false;  ///< attitude, velocity and position are all being corrected
};

}  // namespace limpet
