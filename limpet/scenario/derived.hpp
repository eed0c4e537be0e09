// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "limpet/autopilot/allocation.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::scenario {

/// What a mixer must know of the rotors. What the wake of an upper one takes is left out: PX4's own
/// airframes of coaxial pairs state no other thrust of the lower ones.
[[nodiscard]] RotorList<autopilot::RotorGeometry> rotor_geometry(
    const vehicle::AirframeNumbers& airframe);

/// What other modules have to know of the vehicle and of the earth's field, so that a scenario that
/// changes the mass need not work out the hover thrust. The scenario's own keys come later and win.
///
///   guidance.lidar_separation_m, lidar_x_m    the vehicle's lidar
///   guidance.joint_x_m, joint_z_m             the vehicle's cup
///   guidance.perched_pitch_deg                where the vehicle's legs and cup meet a vertical
///                                             wall
///   guidance.hover_thrust, MPC_THR_HOVER      u = (sqrt(m g / 4 k_mot) - offset) / scale,
///                                             m with the payload's, as in all below
///   guidance.zero_thrust                      u at which the rotors would stand: -offset / scale
///   guidance.drag_1_s                         4 lambda_1 w_hover / m
///   guidance.valve_fitted                     suction.valve_fitted
///   guidance.lean_across_share                the lean with which the legs do not tip, of
///                                             guidance.lean_limit_deg
///   suction.radius_m                          the vehicle's cup
///   suction.attachment_pressure_Pa,           the vacuum of the defaults at sea level, below the
///   guidance.land_pressure_Pa,                ambient pressure
///   detach_pressure_Pa
///   suction.pump_ultimate_Pa, pump_stop_Pa,   the defaults in proportion to the ambient pressure
///   pump_restart_Pa
///   autopilot.mag_field_*_gauss               the magnetometer's strength, dip and declination
///
/// @return nullopt for any other key
[[nodiscard]] std::optional<double> derived(std::string_view section, std::string_view name,
                                            const Scenario& scenario);

/// Of the first, second, ... touch and all after the last, in the wall's condition and the air
/// around: `wall.surface` gives its vacuum at sea level, and what a pump keeps is its
/// ratio of pressures.
[[nodiscard]] std::vector<suction::Surface> surfaces_met(const Scenario& scenario);

/// What rotors and cup know of the air around, by `environment:`. Before derive().
void take_air(Scenario& scenario);

/// Sets those of one section.
/// @param section  bound to `scenario`
void derive(const Section& section, const Scenario& scenario);
/// Sets all of them.
void derive(Scenario& scenario);

}  // namespace limpet::scenario
