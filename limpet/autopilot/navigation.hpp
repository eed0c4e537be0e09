// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

/// Where the vehicle believes to be: what the error-state filter's errors are errors of.
struct Navigation {
    Vector3 p_WB_m = Vector3::Zero();
    Vector3 v_WB_m_s = Vector3::Zero();
    Quaternion q_WB = Quaternion::Identity();
    Vector3 gyro_bias_rad_s = Vector3::Zero();
    Vector3 accelerometer_bias_m_s2 = Vector3::Zero();
};

/// An IMU sample as the means over the interval that it ends; biases still in it.
struct ImuStep {
    double dt_s = 0.0;
    Vector3 rate_B_rad_s = Vector3::Zero();
    Vector3 specific_force_B_m_s2 = Vector3::Zero();
};

/// The last IMU samples, a ring. At 250 Hz one second, at 1 kHz a quarter.
struct ImuHistory {
    static constexpr int kCapacity = 256;
    std::array<ImuStep, kCapacity> steps{};
    int newest = 0;
    int count = 0;
};

void remember(ImuHistory& history, const ImuStep& step);

/// Strapdown integration over one sample; the sample's force acts in the attitude half-way.
[[nodiscard]] Navigation advance(const Navigation& now, const ImuStep& step);
/// Exactly undoes `advance`.
[[nodiscard]] Navigation retreat(const Navigation& now, const ImuStep& step);

/// Runs the present state back through the samples, with the biases as they are believed now. So a
/// late measurement meets the past as the present knows it, corrections in between included.
/// @param age_s  how far back; the part of a sample is taken in proportion
/// @return nullopt when that is further than the history reaches
[[nodiscard]] std::optional<Navigation> past(const Navigation& now, const ImuHistory& history,
                                             double age_s);

}  // namespace limpet::autopilot
