// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/short_text.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/guidance/parameters.hpp"
#include "limpet/guidance/wall_angle.hpp"

namespace limpet::guidance {

// Fig. 7 of the paper as one table (perching.cpp): from, guard, to, reason, event, outcome. Faults
// have rows as success has; those that end a mission at once are left out of the drawing.
//
//   pre_positioning ◄─────────────────────────────────┐
//        │ pre_positioned                             │ next attempt
//   aligning                                          │
//        │ approach_started        aborted            │
//   approaching ──────────────────────────────► retreating ── attempts used up ──► finished
//        │ impact                                  ▲  ▲
//   holding                                        │  │
//        │ hold_over             retreat_started   │  │ aborted (vacuum lost, came off)
//   deciding ──────────────────────────────────────┘  │
//        │ landing_started                            │
//   pitching_up ──────────────────────────────────────┤
//        │                                            │
//   unloading ────────────────────────────────────────┘
//        │ perched
//   standing
//        │ motors_off
//   resting ── mission over ──► finished
//        │ motors_on (rest over, vacuum weak, battery low)
//   spinning_up ─────────────────── came off ──────────────┐
//        │                                                 │
//   pitching_down ── aborted (not level) ──┐               │
//        │ level                           ▼               │
//   levelled                           resealing ──────────┤ no vacuum
//        │ pump_off, valve_open            ▲ │ landing_started ──► pitching_up
//   releasing ── aborted (time, swing, ────┤               │
//    ▲   │                sensor stuck)    │               │
//    │   │ pressure_released               │               │
//    │  backing_off ◄──────────────────────┼───────────────┘
//    └───┤ aborted (seals again)           │
//        │      ── aborted (held) ─────────┘
//        │ backed_off
//   finished

enum class PerchingState {
    hovering,
    pre_positioning,
    aligning,
    approaching,
    holding,
    deciding,
    retreating,
    pitching_up,
    unloading,
    standing,
    resting,
    spinning_up,
    pitching_down,
    levelled,
    releasing,
    resealing,
    backing_off,
    braking,
    finished,
};
[[nodiscard]] inline std::string_view to_string(PerchingState state) {
    return name_of(state);
}

/// What the flight is for.
struct PerchingTask {
    bool perch = true;      ///< false: hover where it is
    bool take_off = true;   ///< after the rest on the wall
    double hover_s = 20.0;  ///< without a perch
};

struct Ending {
    Outcome outcome = Outcome::timed_out;
    ShortText reason;
};

/// What it takes to stand in the wind.
struct WindFelt {
    Vector3 trim_W_m_s2 = Vector3::Zero();  ///< level; leant so before the wall, low-passed
    double most_m_s2 = 0.0;                 ///< the most that was needed there
    double side_m_s2 = 0.0;                 ///< what more it takes to keep its side on the cup
    double turn_rad = 0.0;                  ///< by which the lip is turned on the wall, low-passed
    double updated_s = 0.0;                 ///< when this was last looked at
};

struct CupBelief {
    bool sealed = false;            ///< in this attempt the pressure has been below P_land
    int seals_lost = 0;             ///< attempts that sealed and went back all the same
    bool lets_go = false;           ///< the pump went off so that the cup comes off, and stayed off
    bool pump_stays = false;        ///< leaves, though the pressure says that the cup holds
    bool pressure_doubted = false;  ///< the cup held when the sensor reported that it could not
    double moved_Pa = 0.0;          ///< the pressure when it last was another
    double moved_s = -1e9;          ///< and when that was
    int sealed_again = 0;           ///< how often the cup did while it was left
};

/// Of the estimate while it rests.
struct RestSeen {
    Quaternion q_WB = Quaternion::Identity();  ///< the attitude that it has kept to, some tenths
    double moved_s = -1e9;                     ///< when it last was another
};

/// Everything that guidance remembers; copyable.
struct PerchingMemory {
    PerchingState state = PerchingState::pre_positioning;
    double since_s = 0.0;  ///< when the state began
    double settled_since_s =
        -1.0;  ///< since when its condition holds without a break; < 0: it does not
    int attempt = 1;
    bool release_given_up = false;
    bool has_perched = false;
    CupBelief cup;
    double weak_since_s = -1.0;  ///< since when the vacuum is too weak to land; < 0: it is not
    double off_since_s = -1.0;   ///< since when the cup looks off the wall; < 0: it does not
    WallSeen wall;
    Vector3 line_W_m = Vector3::Zero();     ///< a point of the docking line
    Vector3 entry_p_W_m = Vector3::Zero();  ///< where the state began
    Vector3 grip_W_m = Vector3::Zero();     ///< the cup's joint when the cup had gripped
    WindFelt wind;
    double entry_pitch_rad = 0.0;
    double entry_yaw_rad = 0.0;
    RestSeen rest;
    Setpoint setpoint;
    std::optional<Ending> ending;
};

/// Events of one update; several rows may fire in the same instant.
struct EventList {
    static constexpr std::size_t kMost = 24;  ///< an update has at most eight, faults two each
    std::array<Event, kMost> events{};
    std::size_t count = 0;
    void add(const Event& event);
};

/// @param estimate  where the vehicle is; its position becomes the docking line
[[nodiscard]] PerchingMemory start_perching(const PerchingTask& task, const Estimate& estimate,
                                            double time_s);

/// A mission that has come to its end at rest on the wall goes on resting, and watching the vacuum.
/// @return false when it did not end so: nothing has changed
[[nodiscard]] bool rest_on(PerchingMemory& memory, double time_s);
/// An operator's word to a vehicle that rests: the next update of a task that takes off begins to,
/// also after a release that was given up.
/// @return false when it does not rest: nothing has changed
[[nodiscard]] bool end_rest(const PerchingParameters& parameters, PerchingMemory& memory,
                            double time_s);

/// One update: what the sensors say goes in, what the vehicle shall do comes out in
/// memory.setpoint, what happened in the list. Reads no clock: `time_s` must not run back. A
/// vehicle at rest does not leave the wall by an estimate older than sensor_limit_s.
void update(const PerchingParameters& parameters, const PerchingTask& task, PerchingMemory& memory,
            const Readings& readings, const Estimate& estimate, double time_s, EventList& events);

}  // namespace limpet::guidance
