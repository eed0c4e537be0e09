// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "limpet/identification/flight_data.hpp"
#include "limpet/identification/identification.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::identification {

/// What a flight's log says of its vehicle. What it does not say has no value, and a note says
/// why; intervals are of kConfidence.
struct VehicleFit {
    std::array<std::optional<Fitted>, 3> inertia_kg_m2 = {};  ///< of the whole vehicle, x, y, z
    std::optional<Fitted> lag_up_s = {};                      ///< of the motors, speeding up
    std::optional<Fitted> lag_down_s = {};
    std::optional<Fitted> drag_constant_kg = {};  ///< lambda_1
    std::optional<Fitted> slider_stiffness_N_m = {};
    std::optional<Fitted> slider_damping_N_s_m = {};
    std::optional<Fitted> slider_preload_N = {};
    std::optional<PressureFit> pressure = {};
    double free_s = 0.0;                  ///< of flight without contact, that was used
    std::vector<std::string> notes = {};  ///< what is missing or assumed: a sentence each
};

/// Inertia and lag: commands through the motor model (vehicle/rotor.hpp), with air and hanging cup,
/// turn into a moment, whose integral over I the gyro follows but for its noise and for a wandering
/// moment: one-step-ahead prediction errors of that model are white, and are made small in squares.
/// So a loop that flies on the gyro's noise biases nothing (Ljung, "System identification", 1999,
/// 13.4). Drag: specific force across the rotors' axes over the hubs' velocity in still air, on a
/// bias that wanders. Slider: the force in it over how far and how fast the body goes on after the
/// touch, its acceleration integrated twice.
/// Of a vehicle without a cup neither slider nor pressure are expected.
/// @param airframe  what is taken as known: rotors' places and thrust, the cup's hinges, mass; its
///                  inertia, lags and lambda_1 are where the search begins
[[nodiscard]] VehicleFit identify_vehicle(const FlightData& data,
                                          const vehicle::Airframe& airframe);

}  // namespace limpet::identification
