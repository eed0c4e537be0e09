// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/frames.hpp"

namespace limpet {

/// How honest a filter is at an instant: squared errors over the covariance that it states, each
/// over its number of errors, so that an honest one has mean 1 (overconfident above, humble below).
/// NaN: not known.
struct Consistency {
    double time_s = 0.0;
    /// Of all 15 errors, which the truth tells (NEES).
    double nees = kNaN;
    /// Of three errors each: position, velocity, attitude, gyro bias, accelerometer bias.
    std::array<double, 5> nees_of{kNaN, kNaN, kNaN, kNaN, kNaN};
    /// Of the last innovation of each source (NIS), which the filter knows itself: motion capture's
    /// position and attitude, GPS's position and velocity, barometer, magnetometer.
    std::array<double, 6> nis_of{kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
};

}  // namespace limpet
