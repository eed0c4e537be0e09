// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "limpet/core/parameters.hpp"
#include "limpet/suction/surface.hpp"

namespace limpet::suction {

// The air of one or more cups on one pump, the alternative to the exponential of pressure.hpp
// (docs/decisions/0008). Isothermal, so that mass is counted as throughput Q = p dV/dt [Pa m^3/s]:
//
//   atmosphere --leak(clamping)--+
//   atmosphere --hole, valve-----+--> cup (P, V) --hose--> manifold (P_m) --> pump --> atmosphere
//                                                             |  no volume
//                                            further cups ----+
//
//   V dP/dt = C(N) (P_atm - P) + Q_hole(P) - Q_hose(P, P_m),   sum of Q_hose = Q_pump(P_m)
//
//   pump   S (P_m - P_ult) while it runs, a check valve else: a diaphragm pump whose dead volume
//          expands again has this straight line
//   leak   C(N) = C_100 ((100 N + N_0) / (N + N_0))^m: a gap under a rough lip closes as the lip is
//          pressed; N = (P_atm - P) A + press. Graded over the lip: a moment M about it presses one
//          side more and the other less, per length as 1 + e cos(theta), e = 2 M / (R (N + N_0))
//   hole   orifice, choked below 0.53 P_atm
//   hose   isothermal: P^2 - P_m^2 = Q ((l)^4 + (t Q)^4)^(1/4) + e Q^2, Poiseuille's l below a
//          Reynolds number of some 2000 and a turbulent t above it, e lost at the ends
//   soft   a cup that gives way, V(P) = V_0 - c (P_atm - P), has d(P V)/dP = V_0 + c (2 P - P_atm)
//          in the place of V: with c = V_0 / (P_atm - 2 P_ult) a pump alone draws a line;
//          pulled it grows by s x pull, P V kept: it holds without a pump until its leak fills it

struct PneumaticParameters {
    double pump_speed_L_min = 14.0;     ///< S
    double pump_ultimate_Pa = 24000.0;  ///< P_ult
    double pump_stop_Pa = 26300.0;      ///< vacuum switch: an attached cup's pump stops below it
    double pump_restart_Pa = 29400.0;   ///< and starts again above it
    double cup_volume_cm3 = 60.0;       ///< with hose; the surface's pores come on top
    double cup_gives_way = 0.0;         ///< share of it that a full vacuum squeezes out
    double cup_stretch_cm3_N = 0.0;     ///< that a pull on a soft cup adds to it
    double valve_bore_mm = 2.0;
    double hose_bore_mm = 4.0;
    double hose_length_m = 0.5;
    double partial_seal_area_mm2 = 0.0;  ///< hole where the lip does not meet the wall
    bool graded_seal = false;            ///< a moment on the lip makes its leak uneven
};

/// @param clamping_N  force between lip and wall, >= 0 [N]
/// @return C(N) [m^3/s]
[[nodiscard]] double leak_conductance_m3_s(const Surface& surface, double clamping_N);

/// What a lip that is clamped unevenly leaks, over what it would leak evenly.
struct GradedLeak {
    double ratio = 1.0;     ///< mean of (1 + e cos(theta))^-m over the circumference
    double by_grade = 0.0;  ///< its slope by e
};
/// @param exponent  m
/// @param grade     e, 0 even, 1 where one side begins to lift; taken as 0.98 at most
/// By 64 points, to 1e-6 up to e = 0.9. Closed forms: m = 1 (1 - e^2)^-1/2, m = 2 (1 - e^2)^-3/2.
[[nodiscard]] GradedLeak graded_leak(double exponent, double grade);

/// Flow of air through a hole, isentropic up to the throat.
/// @param area_m2        of the hole
/// @param upstream_Pa    > 0
/// @param downstream_Pa  >= 0; above upstream the flow turns round
/// @return throughput at 293 K [Pa m^3/s]
/// Source: compressible orifice, discharge coefficient 0.6; linear within 0.1 % of equal pressures.
[[nodiscard]] double orifice_flow_Pa_m3_s(double area_m2, double upstream_Pa, double downstream_Pa);

/// What a hose takes of P^2 - P_m^2 for a throughput Q: see the top of this file.
struct Hose {
    double laminar_Pa_s_m3 = 0.0;  ///< l; 0: blocked
    double turbulent_s2_m6 = 0.0;  ///< t
    double ends_s2_m6 = 0.0;       ///< e
    [[nodiscard]] bool blocked() const { return laminar_Pa_s_m3 <= 0.0; }
};

/// l is Poiseuille's, the hose longer by 3 pi / 16 of its bore, so that without a length it is
/// Sampson's orifice; t has a Darcy factor of 0.03, where the two meet at Re 2133; e is 1.5 dynamic
/// pressures.
/// @param bore_mm   0: blocked
/// @param length_m  0: an orifice
/// Source: isothermal pipe flow (Hagen-Poiseuille; Weymouth); Sampson 1891 with Dagan, Weinbaum,
/// Pfeffer 1982 for the length; air at 20 deg C; 0.03 and 1.5 are assumed: smooth hose, sharp ends.
[[nodiscard]] Hose hose_of(double bore_mm, double length_m);

/// @return throughput from cup to manifold, < 0 the other way [Pa m^3/s]
[[nodiscard]] double hose_flow_Pa_m3_s(const Hose& hose, double cup_Pa, double manifold_Pa);

/// The pump, as strong as it is now.
struct Pump {
    double speed_m3_s = 0.0;
    double ultimate_Pa = 0.0;
    bool running = false;
};
[[nodiscard]] Pump pump_of(const PneumaticParameters& parameters, bool running);

/// What lets air into one cup and out of it, over one step.
struct CupAir {
    double volume_m3 = 0.0;      ///< without a vacuum
    double gives_way_m3 = 0.0;   ///< c P_atm, of a soft cup
    Hose hose;                   ///< blocked by default
    double leak_100_m3_s = 0.0;  ///< C_100
    double leak_exponent = 0.0;  ///< m
    double area_m2 = 0.0;        ///< on which the vacuum clamps
    double press_N = 0.0;        ///< presses the lip beyond the vacuum, < 0: the vehicle pulls
    double uneven_N = 0.0;       ///< 2 M / R, of a graded seal: e times what clamps
    double hole_m2 = 0.0;        ///< to the atmosphere: unsealed part of the lip, open valve
    double off_wall_m3_s = 0.0;  ///< conductance of the open mouth of a cup off the wall
    double ambient_Pa = kAtmosphere_Pa;  ///< of the air around, of all cups on a pump the same
};

/// A cup that seals on a surface.
/// @param press_N  as CupAir::press_N; a pull stretches a soft cup
[[nodiscard]] CupAir sealed_cup(const PneumaticParameters& parameters, const Surface& surface,
                                double radius_m, double press_N, bool valve_open);

/// A cup whose mouth is open: it fills with this time constant, whatever the pump does.
[[nodiscard]] CupAir cup_off_the_wall(const PneumaticParameters& parameters,
                                      double time_constant_s);

/// Pressure where the hoses meet the pump.
/// @param cups, pressures_Pa  as many of one as of the other, at least one
[[nodiscard]] double manifold_pressure_Pa(const Pump& pump, std::span<const CupAir> cups,
                                          std::span<const double> pressures_Pa);

/// All cups over one step, by a Rosenbrock method of second order that damps what is too fast for
/// the step; long steps are cut into pieces of 1 ms.
/// @param cups  1..16
/// @param pressures_Pa  absolute, now and then after dt_s [Pa]
void advance_network(const Pump& pump, std::span<const CupAir> cups, std::span<double> pressures_Pa,
                     double dt_s);

/// One cup, alone on the pump.
[[nodiscard]] double pressure_after(const Pump& pump, const CupAir& cup, double pressure_Pa,
                                    double dt_s);

/// The pressure model of one cup (pressure_model.hpp).
struct Pneumatic {
    using Parameters = PneumaticParameters;
    static constexpr std::string_view kName = "pneumatic";
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    /// The pump's vacuum switch.
    [[nodiscard]] static bool pump_rests(const Parameters& parameters, const SealedAir& air);
    [[nodiscard]] static double next_Pa(const Parameters& parameters, const SealedAir& air,
                                        double dt_s);
};

}  // namespace limpet::suction
