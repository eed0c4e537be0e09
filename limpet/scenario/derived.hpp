// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/scenario/scenario.hpp"

namespace limpet::scenario {

/// Sets what other rooms have to know of the vehicle and of the earth's field, so that a scenario
/// that changes the mass need not work out the hover thrust. The scenario's own keys come later and
/// win. Keys: see is_derived().
///
///   guidance.lidar_separation_m, lidar_x_m    the vehicle's lidar
///   guidance.joint_x_m, joint_z_m             the vehicle's cup
///   guidance.hover_thrust, MPC_THR_HOVER      u = (sqrt(m g / 4 k_mot) - offset) / scale
///   guidance.zero_thrust                      u at which the rotors would stand: -offset / scale
///   guidance.drag_1_s                         4 lambda_1 w_hover / m
///   suction.radius_m                          the vehicle's cup
///   autopilot.mag_field_*_gauss               the magnetometer's strength, dip and declination
///   guidance.valve_fitted                     suction.valve_fitted
void derive(Scenario& scenario);

/// The part of derive() that must wait for the scenario's own `suction`.
void derive_from_suction(Scenario& scenario);

/// Whether derive() sets this key.
/// @param section  "guidance", ...
[[nodiscard]] bool is_derived(std::string_view section, std::string_view name);

}  // namespace limpet::scenario
