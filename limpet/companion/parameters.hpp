// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/pose_watch.hpp"

namespace limpet::companion {

/// Rates and patience of the companion: section `limits` of its file.
struct CompanionLimits {
    double guidance_rate_Hz = 50.0;   ///< guidance and set-points
    double poll_rate_Hz = 500.0;      ///< how often the wires are looked at
    double pose_rate_Hz = 50.0;       ///< at most so often a pose goes on to the autopilot
    double pose_limit_s = 0.25;       ///< a motion-capture pose older than this is stale
    double estimate_limit_s = 0.25;   ///< the autopilot's pose likewise
    double silence_limit_s = 3.0;     ///< without a heartbeat of the autopilot
    double late_limit_s = 0.3;        ///< a tick of ours later than this: set-points had stopped
    double arming_s = 2.0;            ///< from the request to a heartbeat that must show it
    double agreement_m = 0.3;         ///< motion capture and estimate, before it begins
    double agreement_deg = 15.0;      ///< the same of the attitude
    double stand_speed_m_s = 0.3;     ///< of the autopilot's estimate while motors are off
    PoseWatchLimits pose_watch;       ///< which poses are not passed on
    double wait_limit_s = 60.0;       ///< for the inputs
    double operator_limit_s = 600.0;  ///< for OFFBOARD, armed, in the air
    double rise_m = 0.3;              ///< with asks_for_mode: so high off its stand it begins
    double begin_tolerance_m = 0.15;  ///< ... standing as near to that
    double begin_speed_m_s = 0.1;     ///< ... slower than this
    double begin_steady_s = 2.0;      ///< ... for so long
    double hand_back_s = 2.0;         ///< how long hold is requested and the end reported
    double mechanism_rate_Hz = 10.0;  ///< rate of commands to pump and valve
    double hover_s = 20.0;            ///< of mission hover
};
[[nodiscard]] const ParameterTable<CompanionLimits>& companion_limits_table();

}  // namespace limpet::companion
