// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "limpet/identification/flight_data.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::identification {

/// What a log's commands do to a vehicle, at the IMU's samples.
struct Driven {
    /// Moment of the rotors and of the air on them, integrated over time: over the inertia, what
    /// the gyro measures, the mean since the sample before.
    std::array<Eigen::VectorXd, 3> spin_N_m_s;
    /// Sum of -w v over the hubs, across their axes: lambda_1 times it is their drag in B.
    std::vector<Vector3> hub_flow_m;
};

/// The velocity in the middle of each of the IMU's intervals, between the log's own; without any 0:
/// then the hubs' turning alone drags.
[[nodiscard]] std::vector<Vector3> velocities_of(const FlightData& data);

/// The motors' model (vehicle/rotor.hpp) under the log's commands.
/// @param data            with IMU and commands
/// @param airframe        all but its lags
/// @param velocity_B_m_s  at the IMU's samples
[[nodiscard]] Driven drive(const FlightData& data, const vehicle::Airframe& airframe,
                           const std::vector<Vector3>& velocity_B_m_s, double lag_up_s,
                           double lag_down_s);

}  // namespace limpet::identification
