// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/identification/flight_data.hpp"
#include "limpet/identification/whitening.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::identification {

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
