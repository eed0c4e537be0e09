// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/companion/parameters.hpp"
#include "limpet/guidance/perching.hpp"
#include "limpet/mavlink/offboard.hpp"

namespace limpet::companion {

// When and how control is handed back: the table of watchdog.cpp. Guidance's own rows handle what
// it can (LiDAR, force or pressure lost, battery low, position lost on the wall); here stands what
// it cannot. Why each cell is so: docs/decisions/0013-handing-back.md
//
//   guidance ──► in_air ──► pressed ──► on_cup ◄──► at_rest
//                  ▲           ▼          │
//                  └─────── leaving ◄─────┘
//
// hold is never requested while the cup holds: a position hold pries at it. Nor do the set-points
// just stop there: after a second PX4 would hold by itself. So guidance goes on, without taking
// off, until the vehicle rests with its motors off or is away from the wall.

/// Where the vehicle is, as guidance knows it.
enum class Place {
    in_air,   ///< free, or flying up to the wall
    pressed,  ///< on the wall by thrust, for hold_s
    leaving,  ///< away from the wall, at its beginning still close to it
    on_cup,   ///< the cup holds, motors on
    at_rest,  ///< the cup holds, motors off
};
[[nodiscard]] std::string_view to_string(Place place);
[[nodiscard]] Place place_of(const guidance::PerchingMemory& memory);

/// What has gone wrong, the gravest first.
enum class Cause {
    mode_taken,
    disarmed,
    interrupted,
    autopilot_silent,
    loop_late,
    pose_stale,
    estimate_stale,
};
/// For people and recordings: "motion-capture pose stale".
[[nodiscard]] std::string_view to_string(Cause cause);

enum class Action {
    carry_on,  ///< all is well
    finish,    ///< guidance goes on, without taking off, until the place is another
    hold,      ///< set-points stop, hold is requested, the pump goes off
    let_go,    ///< set-points stop, nothing is requested, the pump stays as it is on the wall
};
[[nodiscard]] std::string_view to_string(Action action);

/// What the watchdog looks at, at one instant.
struct Signs {
    mavlink::OffboardState autopilot = mavlink::OffboardState::engaged;
    bool disarmed = false;     ///< though it was armed and should be
    bool interrupted = false;  ///< stays so
    bool late = false;         ///< a tick came after late_limit_s; stays so
    bool pose_fresh = true;    ///< of motion capture
    bool estimate_fresh = true;
};

struct Judgement {
    Action action = Action::carry_on;
    Cause cause = Cause::mode_taken;  ///< means something unless action is carry_on
};

/// @return the first row that applies and does not carry on
[[nodiscard]] Judgement judge(const Signs& signs, Place place);

/// A cell of the table.
[[nodiscard]] Action action_for(Cause cause, Place place);

/// Watches that nobody disarms the vehicle behind our back. Heartbeats come once a second: what
/// they show counts arming_s after arming was requested.
struct ArmingWatch {
    double asked_s = -1.0;  ///< since when armed is requested without a break; < 0: it is not
    bool seen = false;      ///< armed since then
};
/// @return whether it was armed as requested and is no longer
[[nodiscard]] bool watch_arming(ArmingWatch& watch, bool requested, bool armed, double arming_s,
                                double time_s);

}  // namespace limpet::companion
