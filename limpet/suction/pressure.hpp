// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/core/parameters.hpp"
#include "limpet/suction/surface.hpp"

namespace limpet::suction {

/// Where the air goes.
enum class Airflow {
    sealing,    ///< lip sealed, pump running: eq. (5)
    unsealing,  ///< lip sealed, pump off: eq. (6)
    venting,    ///< lip sealed, solenoid valve open
    open,       ///< lip off the wall
};

/// Of the cup itself; time constants of the seal are the surface's.
struct FirstOrderParameters {
    double valve_time_constant_s = 0.04;   ///< 2 mm orifice on 60 cm^3, facts.md item 20
    double open_time_constant_s = 0.01;    ///< a cup off the wall
    double pump_stop_band_Pa = 100.0;      ///< above P_vac: a cycling pump stops below it
    double pump_restart_band_Pa = 2000.0;  ///< above P_vac: and starts again above it
};

/// Pressure in the cup after `dt_s` of one airflow, from any starting pressure: the exact solution
/// of the first-order law whose step responses are eqs. (5) and (6), so that a flow interrupted
/// half-way goes on from the current pressure and the result does not depend on the step.
/// @param pressure_Pa  absolute, now [Pa]
/// @param dt_s         >= 0 [s]
/// @param hole_mm2     lets air in besides the flow, at the rate of the valve's 2 mm orifice by its
/// area
/// @param ambient_Pa  of the air around
/// @return absolute pressure after dt_s [Pa]
/// Source: paper eqs. (5), (6) and Table II; the valve adds its rate to that of the leak.
[[nodiscard]] double pressure_after(const Surface& surface, const FirstOrderParameters& cup,
                                    Airflow flow, double pressure_Pa, double dt_s,
                                    double hole_mm2 = 0.0, double ambient_Pa = kAtmosphere_Pa);

/// The paper's model: eqs. (5), (6).
struct FirstOrder {
    using Parameters = FirstOrderParameters;
    static constexpr std::string_view kName = "first_order";
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    /// On a tight surface, between a stop and a restart pressure; elsewhere the pump runs.
    [[nodiscard]] static bool pump_rests(const Parameters& parameters, const SealedAir& air);
    [[nodiscard]] static double next_Pa(const Parameters& parameters, const SealedAir& air,
                                        double dt_s);
};

}  // namespace limpet::suction
