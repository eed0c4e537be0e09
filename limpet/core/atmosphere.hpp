// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/parameters.hpp"

/// The standard atmosphere below 11 km, and air that is warmer or colder than it.
///
///   T = T_0 - L h + dT,   P = P_0 (1 - L h / T_0)^(g / R L),   rho = P / (R T)
///
/// A day that is off the standard by dT keeps the pressure of its altitude (h is a pressure
/// altitude, as in aircraft's performance tables) and has another density.
/// Source: ICAO Doc 7488 (ISO 2533), troposphere.
namespace limpet {

/// Rows of `environment:` about the air itself.
struct AirParameters {
    double altitude_m = 0.0;                ///< of W's origin above mean sea level
    double air_temperature_offset_K = 0.0;  ///< off the standard at that altitude
};
[[nodiscard]] const ParameterTable<AirParameters>& air_table();

/// The air around, at one altitude.
struct Air {
    double pressure_Pa = 101325.0;
    double temperature_K = 288.15;
    double pressure_ratio = 1.0;  ///< over that at sea level
    double density_ratio = 1.0;   ///< over kAirDensity_kg_m3
};
/// Of `altitude_m` 0 and no offset exactly the defaults.
[[nodiscard]] Air air_at(const AirParameters& parameters);

/// @param altitude_m  below 44 km, where the formula ends
[[nodiscard]] double standard_pressure_Pa(double altitude_m);
/// Inverse of standard_pressure_Pa. @param pressure_Pa  >= 0
[[nodiscard]] double standard_altitude_m(double pressure_Pa);

}  // namespace limpet
