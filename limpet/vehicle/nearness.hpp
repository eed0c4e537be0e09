// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/vehicle/airframe.hpp"

/// What ground and ceiling do to a rotor's thrust:
///
///   ground   T / T_free = 1 / (1 - s), s = (R / 4z)^2, z from the ground to the propeller: the
///            image of its wake's source below the ground blows up at it; with its neighbours each
///            other rotor's image adds R^2/4 h / (d^2 + h^2)^(3/2) to s, d beside it and h below
///   ceiling  T / T_free over d/R, d from the propeller to the ceiling, as measured at the same
///            command: rotors turn up to 3 % faster there, which is in the gain and not in the
///            speed
///
/// Both fade with the cosine between the rotor's axis and the vertical (assumed: the data are of a
/// level vehicle).
/// Source: Cheeseman, Bennett, ARC R&M 3021 (1955); neighbours: Sanchez-Cuevas, Heredia, Ollero,
/// Int. J. Aerospace Eng. 2017, 1823056, without its term for the body; ceiling: "Ground, Ceiling
/// and Wall Effect Evaluation of Small Quadcopters in Pressure-controlled Environments" (JINT 110,
/// 2024, doi 10.1007/s10846-024-02155-7), 12 in quadrotor; its numbers: facts.md section 5.
namespace limpet::vehicle {

/// Rows of `environment:` about ground and ceiling. Off by default.
struct NearnessParameters {
    bool ground_effect = false;
    bool ground_neighbours = false;  ///< and of a rotor's neighbours, with ground_effect
    double ceiling_height_m = 0.0;   ///< above the ground; 0: there is no ceiling
};
[[nodiscard]] const ParameterTable<NearnessParameters>& nearness_table();

/// Gain of thrust above ground. Closer than 0.54 R it stays at 1.27: there the formula leaves what
/// was measured (1.24 to 1.31 at 0.33 R).
/// @param radii  z / R, > 0
[[nodiscard]] double ground_gain(double radii);
/// Gain of thrust below a ceiling: middle of four commands, linear between the published points,
/// that of 0.33 R below it, none from 2.3 R on.
/// @param radii  d / R, > 0
[[nodiscard]] double ceiling_gain(double radii);

/// Immutable during a flight.
struct NearnessModel {
    NearnessParameters parameters;
    double ground_z_W_m = 0.0;
    double ceiling_z_W_m = 0.0;  ///< of no meaning without one
    [[nodiscard]] bool has_ceiling() const { return parameters.ceiling_height_m > 0.0; }
    [[nodiscard]] bool acts() const { return parameters.ground_effect || has_ceiling(); }
};
[[nodiscard]] NearnessModel make_nearness(const NearnessParameters& parameters,
                                          double ground_z_W_m);

/// @return of each rotor, over its thrust in free air
[[nodiscard]] RotorList<double> thrust_gains(const NearnessModel& model,
                                             const AirframeNumbers& airframe,
                                             const Kinematics& base);
/// @return mean over the rotors, 1 in free air
[[nodiscard]] double mean_thrust_gain(const NearnessModel& model, const AirframeNumbers& airframe,
                                      const Kinematics& base);
/// The same vehicle, each rotor with so much of its thrust.
[[nodiscard]] AirframeNumbers lifting_by(AirframeNumbers airframe, const RotorList<double>& gains);

}  // namespace limpet::vehicle
