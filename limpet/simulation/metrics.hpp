// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/frames.hpp"

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
    int attempts = 0;                         ///< docking runs
    double impact_speed_m_s = kNaN;           ///< of the lip along the wall's normal
    double impact_force_N = kNaN;             ///< largest press through the slider, > 0
    double cup_press_max_N = kNaN;            ///< largest press at the lip, > 0
    double alignment_at_approach_deg = kNaN;  ///< heading off the wall's normal
    double time_to_land_pressure_s = kNaN;    ///< from the touch to P_land
    double pressure_at_hold_end_Pa = kNaN;
    double pressure_min_Pa = kNaN;
    double perched_pitch_deg = kNaN;         ///< at the end of the rest
    double perched_pitch_spread_deg = kNaN;  ///< over the last 5 s of it
    double cup_pull_max_N = kNaN;
    double release_s = kNaN;                   ///< from pump_off to detached
    double pressure_at_release_end_Pa = kNaN;  ///< when the release was done or given up
    double pitch_oscillation_max_deg = kNaN;   ///< while waiting for the release
    double pitch_swing_deg = kNaN;             ///< half of its span, lowest to highest, meanwhile
    double cup_margin_min_N = kNaN;
    double off_place_m = kNaN;  ///< at the end in the air, from where it belongs
    double energy_flying_Wh = 0.0;
    double energy_perched_Wh = 0.0;
    std::array<CupLoads, kLoadPhases.size()> loads{};
};

/// Bookkeeping next to them.
struct MetricsMemory {
    double touch_s = kNaN;
    double pump_off_s = kNaN;
    bool awaits_touch = false;
    double waiting_pitch_min_deg = kNaN;
    double waiting_pitch_max_deg = kNaN;
    double rest_pitch_min_deg = kNaN;
    double rest_pitch_max_deg = kNaN;
};

/// A figure under the name by which results and columns call it; the unit is in the name.
struct MetricInfo {
    std::string_view name;
    double Metrics::*field;
};
[[nodiscard]] std::span<const MetricInfo> metric_table();

}  // namespace limpet::simulation
