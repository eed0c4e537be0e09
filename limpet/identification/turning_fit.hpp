// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/identification/flight_data.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::identification {

/// A stretch of a log, in samples of the IMU.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;  ///< one past
};

/// How a vehicle turned in free flight under its commands.
struct TurningFit {
    Eigen::Vector3d per_inertia;  ///< 1 / I
    double lag_up_s = 0.0;
    double lag_down_s = 0.0;
    /// Of 1/I_x, 1/I_y, 1/I_z, and the logarithms of the lags.
    Eigen::Matrix<double, 5, 5> covariance;
    std::vector<double> speed_sum_rad_s;  ///< of the rotors, at each sample of the IMU
};

/// @param data      with IMU and commands
/// @param airframe  its lags and inertia are where the search begins
/// @param free      stretches without contact
/// @throws InputError when the search finds no minimum
[[nodiscard]] TurningFit fit_turning(const FlightData& data,
                                     const vehicle::AirframeNumbers& airframe,
                                     const std::vector<Stretch>& free);

}  // namespace limpet::identification
