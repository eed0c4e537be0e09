// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/vehicle/airframe.hpp"
#include "limpet/vehicle/rotor.hpp"

/// What a wall does to the air of a multirotor next to it.
///
///   steady     F = C_F rho n^2 D^4, M = C_M rho n^2 D^5, coefficients over d/R measured with a
///              12 in quadrotor, d from the closest motor axis to the wall
///   unsteady   the recirculating wake: a pitching moment that wanders as a first-order
///              Gauss-Markov process, in proportion to the thrust, full from d = 2 R on
///
/// Two facilities disagree on the steady part (C_M by a factor of three, the force's sign): their
/// mean is taken, towards the wall and with the wall's side down (assumed), and a scale turns it.
/// At this vehicle's d/R it is below 1 % of the thrust either way.
/// Source: "Ground, Ceiling and Wall Effect Evaluation of Small Quadcopters in Pressure-controlled
/// Environments" (JINT 110, 2024, doi 10.1007/s10846-024-02155-7); its numbers: facts.md section 5.
namespace limpet::vehicle {

/// Rows of `environment:` about the wall. All off by default.
struct WallAirParameters {
    bool wall_aerodynamics = false;             ///< the steady part
    double wall_force_scale = 1.0;              ///< of the published mean; > 0 towards the wall
    double wall_moment_scale = 1.0;             ///< > 0 the side at the wall goes down
    double recirculation_moment_rms_N_m = 0.0;  ///< when attached, at hover thrust
    double recirculation_correlation_s = 0.5;
    double recirculation_full_radii = 2.0;  ///< d/R at which it has come in
    double recirculation_none_radii = 4.0;  ///< d/R from which it is gone
};
[[nodiscard]] const ParameterTable<WallAirParameters>& wall_air_table();

struct WallCoefficients {
    double force = 0.0;   ///< C_F
    double moment = 0.0;  ///< C_M
};
/// Mean of the two facilities, linear between the published points, that of d/R = 1 below it, gone
/// at d/R = 4 (assumed).
/// @param radii  d/R, >= 0
[[nodiscard]] WallCoefficients wall_coefficients(double radii);

/// Immutable during a flight.
struct WallAirModel {
    WallAirParameters parameters;
    double keep = 1.0;  ///< of the Gauss-Markov process, a step
    double kick = 0.0;
    double reach_m = 0.0;        ///< from which distance on there is nothing
    double diameter_4_m4 = 0.0;  ///< a rotor's, to the fourth power
};
/// @param rotor_radius_m  > 0
/// @param dt_s            > 0, of every step
[[nodiscard]] WallAirModel make_wall_air(const WallAirParameters& parameters, double rotor_radius_m,
                                         double dt_s);

struct WallAirState {
    double swirl = 0.0;  ///< of unit variance
    RandomStream random;
};
/// The swirl as it is at any moment.
[[nodiscard]] WallAirState start(const WallAirModel& model, const RandomStream& random);
/// One step of the swirl. Draws nothing when there is no recirculation.
void step(const WallAirModel& model, WallAirState& state);

/// Whether any of it acts at all.
[[nodiscard]] bool acts(const WallAirModel& model);

/// @param distance_m  from the closest motor axis to the wall; infinite: not over the wall
/// @param x_T_W       unit normal, into the wall
/// @param q_WB        attitude: both parts fade with the cosine between rotor axes and wall
///                    (assumed: the data are of a level vehicle)
/// @param thrust_N    sum of the rotors
/// @return on the vehicle about its centre of mass, in W
[[nodiscard]] Wrench wall_air_wrench_W(const WallAirModel& model, const WallAirState& state,
                                       const AirframeNumbers& airframe, const RotorsState& rotors,
                                       double thrust_N, const Quaternion& q_WB, double distance_m,
                                       const Vector3& x_T_W);

}  // namespace limpet::vehicle
