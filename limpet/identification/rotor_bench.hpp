// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/identification/propeller_file.hpp"
#include "limpet/vehicle/airframe.hpp"

/// Measurements on the simulation's own rotor model: it is commanded, spins up and is weighed, so
/// that Table I can be recovered as it was made and not copied.
namespace limpet::identification {

/// One rotor on a static thrust stand, in still air.
struct ThrustStandRow {
    double speed_rad_s = 0.0;  ///< reached, not requested
    double thrust_N = 0.0;
    double torque_N_m = 0.0;
    PropellerRow coefficients;  ///< as a UIUC file has them
};
/// @param speeds_rpm  requested; beyond the rotor's highest speed it stays below
/// @return one row a speed
[[nodiscard]] std::vector<ThrustStandRow> static_thrust_stand(
    const vehicle::RotorParameters& rotor, const std::vector<double>& speeds_rpm);

/// One rotor in a wind tunnel, its axis across the wind.
struct CrossWindRow {
    double wind_m_s = 0.0;
    double drag_N = 0.0;  ///< along the wind
};
struct CrossWindResult {
    std::vector<CrossWindRow> rows;
    double speed_rad_s = 0.0;
    double drag_constant_kg = 0.0;  ///< lambda_1 of drag = lambda_1 w v, by least squares
};
/// @param speed_rpm   of the rotor
/// @param winds_m_s   at least one that is not 0
[[nodiscard]] CrossWindResult cross_wind_tunnel(const vehicle::RotorParameters& rotor,
                                                double speed_rpm,
                                                const std::vector<double>& winds_m_s);

}  // namespace limpet::identification
