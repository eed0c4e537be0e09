// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"

/// Wind: a constant one and Dryden gusts of MIL-F-8785C, seen by a vehicle that stays in one place
/// while frozen gusts drift past it with the mean wind (Taylor).
///
///   along u   S(f) first order:   R(t) = sigma^2 exp(-t/T)
///   across v, down w   second:    R(t) = sigma^2 (1 - t/2T) exp(-t/T)          T = L / V
///
/// Each is a linear filter of white noise, stepped by its exact solution and begun in its
/// stationary distribution: variance and spectrum do not depend on the step.
/// Source: MIL-F-8785C, 3.7.2 (spectra) and 3.7.3 (low altitude).
namespace limpet::vehicle {

/// Rows of `environment:` about the wind. All off by default: still air.
struct WindParameters {
    double wind_speed_m_s = 0.0;  ///< mean, at the vehicle, level
    double wind_from_deg = 0.0;   ///< where it comes from, from north, clockwise
    double gust_wind_m_s = 0.0;   ///< > 0: gusts as MIL-F-8785C has them under this wind at 6.1 m
    double gust_height_m = 6.1;   ///< above the ground, for gust_wind_m_s
    double gust_sigma_m_s = 0.0;  ///< > 0: gusts of this deviation on each axis instead
    double gust_length_m = 5.0;   ///< and of this length
    double gust_drift_m_s = 2.0;  ///< at least so fast the gusts pass
};
[[nodiscard]] const ParameterTable<WindParameters>& wind_table();

/// One axis of the gusts.
struct GustScale {
    double sigma_m_s = 0.0;
    double length_m = 1.0;
};
struct GustScales {
    GustScale along;
    GustScale across;
    GustScale down;
};
/// @return what the parameters say; sigmas of 0 without gusts
[[nodiscard]] GustScales gust_scales(const WindParameters& wind);

/// One step of one axis: x <- keep x + carry x_before + noise; see wind.cpp.
struct GustFilter {
    double sigma_m_s = 0.0;
    double keep = 1.0;
    double carry = 0.0;
    double kick_1 = 0.0;  ///< Cholesky factor of the step's noise
    double kick_21 = 0.0;
    double kick_2 = 0.0;
};

/// Immutable during a flight.
struct WindModel {
    bool gusts = false;
    Vector3 mean_W_m_s = Vector3::Zero();
    Matrix3 R_WG = Matrix3::Identity();  ///< G: x downwind, z down
    GustFilter along;
    GustFilter across;
    GustFilter down;
};
/// @param dt_s  > 0, of every step
[[nodiscard]] WindModel make_wind(const WindParameters& parameters, double dt_s);

/// States of unit variance (the second of a pair: 1/2).
struct GustAxis {
    double first = 0.0;
    double second = 0.0;
};
struct WindState {
    GustAxis along;
    GustAxis across;
    GustAxis down;
    RandomStream random;
};
/// Gusts as they are at any moment: drawn from their stationary distribution.
[[nodiscard]] WindState start(const WindModel& model, const RandomStream& random);

/// One step of the gusts. Draws nothing when there are none.
void step(const WindModel& model, WindState& state);

/// @return velocity of the air, in W; zero in still air
[[nodiscard]] Vector3 wind_W_m_s(const WindModel& model, const WindState& state);

}  // namespace limpet::vehicle
