// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "limpet/core/enum_names.hpp"

namespace limpet::simulation {

/// Parts of the manoeuvre in which the cup bears load.
enum class LoadPhase {
    hold,      ///< from the touch to the decision
    land,      ///< pitching up and unloading
    rest,      ///< motors off
    take_off,  ///< pitching down
    level,     ///< waiting for the release
};
inline constexpr std::array kLoadPhases = {LoadPhase::hold, LoadPhase::land, LoadPhase::rest,
                                           LoadPhase::take_off, LoadPhase::level};
[[nodiscard]] inline std::string_view to_string(LoadPhase phase) {
    return name_of(phase);
}

/// Largest loads on the cup in one phase while it was sealed, and what it had to spare from the
/// attachment on.
struct CupLoads {
    double pull_N = 0.0;
    double shear_N = 0.0;
    double peel_N_m = 0.0;
    double margin_N =
        std::numeric_limits<double>::infinity();  ///< of pull, shear and peel the least
};

/// Figures of one flight, from the truth; NaN: did not come to pass. Those of a touch are of the
/// last docking run.
struct Metrics {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    int attempts = 0;                          ///< docking runs
    double impact_speed_m_s = kNone;           ///< of the lip along the wall's normal
    double impact_force_N = kNone;             ///< largest press through the slider, > 0
    double cup_press_max_N = kNone;            ///< largest press at the lip, > 0
    double alignment_at_approach_deg = kNone;  ///< heading off the wall's normal
    double time_to_land_pressure_s = kNone;    ///< from the touch to P_land
    double pressure_at_hold_end_Pa = kNone;
    double pressure_min_Pa = kNone;
    double perched_pitch_deg = kNone;         ///< at the end of the rest
    double perched_pitch_spread_deg = kNone;  ///< over the last 5 s of it
    double cup_pull_max_N = kNone;
    double release_s = kNone;                   ///< from pump_off to detached
    double pressure_at_release_end_Pa = kNone;  ///< when the release was done or given up
    double pitch_oscillation_max_deg = kNone;   ///< while waiting for the release
    double pitch_swing_deg = kNone;             ///< half of its span, lowest to highest, meanwhile
    double cup_margin_min_N = kNone;
    double energy_flying_Wh = 0.0;
    double energy_perched_Wh = 0.0;
    std::array<CupLoads, kLoadPhases.size()> loads{};

    /// Bookkeeping.
    struct Memory {
        double touch_s = kNone;
        double pump_off_s = kNone;
        bool awaits_touch = false;
        double waiting_pitch_min_deg = kNone;
        double waiting_pitch_max_deg = kNone;
        double rest_pitch_min_deg = kNone;
        double rest_pitch_max_deg = kNone;
    };
    Memory memory;
};

/// A figure under the name by which results and columns call it; the unit is in the name.
struct MetricInfo {
    std::string_view name;
    double Metrics::*field;
};
[[nodiscard]] std::span<const MetricInfo> metric_table();

}  // namespace limpet::simulation
