// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "limpet/identification/flight_data.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::identification {

/// A stretch of a log, in samples of the IMU.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;  ///< one past
};

/// Samples of a sensor with white noise on something that wanders: each less what a Kalman filter
/// would have foreseen of it, over its deviation. What is linear stays so: whitened outputs fit on
/// whitened inputs by ordinary least squares. Each stretch begins anew and knows nothing.
struct Whitened {
    Eigen::VectorXd values;
    double logs = 0.0;  ///< sum of the logarithms of the variances, for the likelihood
};

/// @param ratio  variance by which it wanders from sample to sample, over that of the noise
[[nodiscard]] inline Whitened whiten(const Eigen::VectorXd& values,
                                     const std::vector<Stretch>& stretches, double ratio) {
    constexpr double kKnowsNothing = 1e8;
    Whitened all{.values = Eigen::VectorXd::Zero(values.size())};
    for (const Stretch& stretch : stretches) {
        double level = 0.0, unsure = kKnowsNothing;
        for (std::size_t k = stretch.first; k < stretch.last; ++k) {
            const auto i = static_cast<Eigen::Index>(k);
            const double variance = unsure + 1.0, left = values[i] - level;
            all.values[i] = left / std::sqrt(variance);
            all.logs += std::log(variance);
            level += left * unsure / variance;
            unsure = unsure / variance + ratio;
        }
    }
    return all;
}

[[nodiscard]] inline std::size_t samples_of(const std::vector<Stretch>& stretches) {
    std::size_t count = 0;
    for (const Stretch& stretch : stretches) {
        count += stretch.last - stretch.first;
    }
    return count;
}

/// Minus twice the logarithm of the likelihood of whitened leftovers, their deviation the best one.
[[nodiscard]] inline double unlikelihood(double squares, double logs, std::size_t count) {
    const auto n = static_cast<double>(count);
    return n * std::log(squares / n) + logs;
}

/// Ratios to choose the likeliest from.
[[nodiscard]] inline std::vector<double> ratios_to_try() {
    constexpr double kLeast = 1e-8;
    constexpr int kDoublings = 27;  // up to 0.7
    std::vector<double> all;
    for (int k = 0; k < kDoublings; ++k) {
        all.push_back(std::ldexp(kLeast, k));
    }
    return all;
}

/// How a vehicle turned in free flight under its commands.
struct TurningFit {
    Eigen::Vector3d per_inertia;  ///< 1 / I
    double lag_up_s = 0.0;
    double lag_down_s = 0.0;
    /// Of 1/I_x, 1/I_y, 1/I_z, and the logarithms of the lags.
    Eigen::Matrix<double, 5, 5> covariance;
    /// At each sample of the IMU, the sum of -w v over the hubs, across their axes: lambda_1 times
    /// it is their drag in B.
    std::vector<Vector3> hub_flow_m;
};

/// @param data      with IMU and commands
/// @param airframe  its lags and inertia are where the search begins, its lambda_1 is what it is
/// @param free      stretches without contact
/// @throws InputError when the search finds no minimum
[[nodiscard]] TurningFit fit_turning(const FlightData& data, const vehicle::Airframe& airframe,
                                     const std::vector<Stretch>& free);

}  // namespace limpet::identification
