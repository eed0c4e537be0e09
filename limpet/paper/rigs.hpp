// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/paper/parts.hpp"

/// Small experiments on parts of the simulation, each on the code that flies.
namespace limpet::paper {

/// What the vehicle's file holds, and how bodies move without forces.
void measure_vehicle(Evidence& evidence);

/// Load at which a sealed cup lets go.
struct BreakOff {
    std::string surface;
    double pressure_Pa = 0.0;
    double pull_N = 0.0;
    double shear_N = 0.0;
    double peel_N_m = 0.0;
    double pull_in_weights = 0.0;  ///< over that of the vehicle
};
/// Moves a sealed cup slowly away from the wall, along it, and tilts it, until it lets go, at the
/// surface's best vacuum and at P_land.
[[nodiscard]] std::vector<BreakOff> break_off_loads();

/// Power from the battery, mean over a flight's part.
struct EnergyUse {
    std::string what = {};
    double power_W = 0.0;
    double endurance_h = 0.0;       ///< on a full battery
    double getting_there_Wh = 0.0;  ///< approach and landing
};
/// Hovering, and perched on each surface with the motors off; "energy.perched_share" is the power
/// perched on concrete over that of hovering.
[[nodiscard]] std::vector<EnergyUse> energy_use(Evidence& evidence);
/// That share with a value turned.
[[nodiscard]] double turned_perched_share(const Turn& turn);

/// How long the cup takes to let go once the pump is off.
struct ReleaseTime {
    std::string surface;
    double without_valve_s = 0.0;
    double with_valve_s = 0.0;
};
/// Whole flights with all the time in the world, on each surface.
[[nodiscard]] std::vector<ReleaseTime> release_times(int jobs);
/// On metal, with a value turned.
[[nodiscard]] ReleaseTime turned_release_time(const Turn& turn);

/// How far release times are spread, with the valve over without: from 5 to 95 % of flights on
/// every surface, each with another seed and another tau_2 within Table II's tolerance.
/// @param flights  on each surface, with and without
/// @param turn     of a value, or none
[[nodiscard]] double valve_spread_ratio(int flights, int jobs,
                                        const std::optional<Turn>& turn = {});
/// The scenario in which the energy, and in which the release on metal is flown.
[[nodiscard]] std::vector<scenario::Scenario> rig_scenarios();

}  // namespace limpet::paper
