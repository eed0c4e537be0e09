// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/perching.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/guards.hpp"
#include "limpet/guidance/motion.hpp"

namespace limpet {
namespace {

// --- the table --------------------------------------------------------------------------------

struct Transition {
    PerchingState from;
    bool (*guard)(const guards::Scene&);
    PerchingState to;
    std::string_view reason;
    std::optional<EventName> event = std::nullopt;
    std::optional<EventName> second_event = std::nullopt;
    std::optional<Outcome> outcome = std::nullopt;
};

using enum PerchingState;
using enum EventName;
using namespace guards;

/// A row that ends the mission with a fault.
constexpr Transition ends(PerchingState from, bool (*guard)(const guards::Scene&),
                          std::string_view reason, Outcome outcome) {
    return {from, guard, finished, reason, aborted, std::nullopt, outcome};
}
/// A row that ends it as it should.
constexpr Transition done(PerchingState from, bool (*guard)(const guards::Scene&),
                          std::string_view reason, Outcome outcome,
                          std::optional<EventName> event = std::nullopt) {
    return {from, guard, finished, reason, event, std::nullopt, outcome};
}

/// The first row of the current state whose guard holds is taken; faults stand above success.
constexpr std::array kTable = {
    done(hovering, hover_over, "hovered as asked", Outcome::released),

    ends(pre_positioning, estimate_lost, "position estimate lost", Outcome::failed_to_seal),
    ends(pre_positioning, battery_low, "battery low", Outcome::failed_to_seal),
    ends(pre_positioning, waited_too_long, "no pre-position before the wall in time",
         Outcome::failed_to_seal),
    Transition{pre_positioning, settled, aligning, "stands at the pre-position", pre_positioned},

    ends(aligning, estimate_lost, "position estimate lost", Outcome::failed_to_seal),
    ends(aligning, pressure_implausible, "pressure sensor stuck or silent",
         Outcome::failed_to_seal),
    ends(aligning, waited_too_long, "not perpendicular to the wall in time",
         Outcome::failed_to_seal),
    Transition{aligning, wall_lost, pre_positioning, "LiDAR lost"},
    Transition{aligning, settled, approaching, "perpendicular to the wall", approach_started},

    ends(approaching, estimate_lost, "position estimate lost", Outcome::failed_to_seal),
    Transition{approaching, wall_hit, holding, "pressed on the wall", impact},
    Transition{approaching, wall_lost, retreating, "LiDAR lost", aborted},
    Transition{approaching, force_lost, retreating, "force sensor silent", aborted},
    Transition{approaching, approach_too_long, retreating, "no impact in time", aborted},

    Transition{holding, hold_is_over, deciding, "held", hold_over},
    Transition{deciding, sealed, pitching_up, "pressure below P_land", landing_started},
    Transition{deciding, always, retreating, "no seal", retreat_started},

    ends(retreating, estimate_lost, "position estimate lost", Outcome::failed_to_seal),
    done(retreating, attempts_used_up, "no landing in any attempt", Outcome::failed_to_seal),
    Transition{retreating, settled, pre_positioning, "tries again"},
    ends(retreating, held_back, "the cup does not come off", Outcome::failed_to_seal),
    ends(retreating, retreat_too_long, "does not get back to the pre-position",
         Outcome::failed_to_seal),

    Transition{pitching_up, came_off, retreating, "came off the wall", aborted},
    Transition{pitching_up, vacuum_lost, retreating, "vacuum lost", aborted},
    Transition{pitching_up, pitched_up, unloading, "pitched up"},
    Transition{unloading, came_off, retreating, "came off the wall", aborted},
    Transition{unloading, vacuum_lost, retreating, "vacuum lost", aborted},
    Transition{unloading, landing_too_long, pitching_down, "does not come to rest on its legs",
               aborted},
    Transition{unloading, settled, standing, "pitch steady on the legs", perched},
    Transition{standing, always, resting, "rests", motors_off},

    Transition{resting, vacuum_lost, spinning_up, "vacuum weak", motors_on},
    done(resting, rest_over_given_up, "rests after the release was given up",
         Outcome::release_aborted),
    done(resting, rest_over_stay, "rests on the wall", Outcome::perched),
    ends(resting, battery_low_stays, "battery low: rests on the wall", Outcome::perched),
    ends(resting, rest_over_blind, "no position estimate: rests on the wall",
         Outcome::release_aborted),
    Transition{resting, battery_low_flies, spinning_up, "battery low", motors_on},
    Transition{resting, rest_over, spinning_up, "rest over", motors_on},

    Transition{spinning_up, came_off, backing_off, "came off the wall", aborted},
    Transition{spinning_up, spun_up, pitching_down, "rotors carry their share"},
    Transition{pitching_down, came_off, backing_off, "came off the wall", aborted},
    Transition{pitching_down, settled, levelled, "level and stable", level},
    Transition{pitching_down, not_level_in_time, resealing, "not level in time", aborted},
    Transition{levelled, valve_fitted, releasing, "breaks the vacuum", pump_off, valve_open},
    Transition{levelled, always, releasing, "lets the air in", pump_off},

    Transition{releasing, came_off, backing_off, "came off the wall"},
    Transition{releasing, estimate_lost, resealing, "position estimate lost", aborted},
    Transition{releasing, stuck_behind_valve, backing_off, "pressure sensor stuck, valve open"},
    Transition{releasing, pressure_stuck, resealing, "pressure sensor stuck", aborted},
    Transition{releasing, pressure_safe, backing_off, "pressure above the safe threshold",
               pressure_released},
    Transition{releasing, swings, resealing, "oscillation past its limit", aborted},
    Transition{releasing, release_too_long, resealing, "pressure not released in time", aborted},

    Transition{resealing, came_off, backing_off, "came off the wall"},
    Transition{resealing, sealed, pitching_up, "vacuum is back", landing_started},
    Transition{resealing, no_vacuum, backing_off, "no vacuum to rest on"},
    Transition{resealing, reseals_blind, pitching_up, "pressure unknown: rests with the pump on",
               landing_started},

    ends(backing_off, estimate_lost, "off the wall, position estimate lost", Outcome::released),
    done(backing_off, back_unperched, "back without having perched", Outcome::failed_to_seal,
         backed_off),
    done(backing_off, settled, "back at the pre-position", Outcome::released, backed_off),
    Transition{backing_off, held_by_vacuum, resealing, "the cup does not come off", aborted},
    ends(backing_off, retreat_too_long, "off the wall, not back at the pre-position in time",
         Outcome::released),
};

const Transition* due_row(const Scene& scene) {
    for (const Transition& row : kTable) {
        if (row.from == scene.memory.state && row.guard(scene)) {
            return &row;
        }
    }
    return nullptr;
}

Event report(const Scene& s, const Transition& row, EventName name) {
    return make_event(
        s.time_s, "guidance", name, row.reason,
        {{"distance_m", s.memory.wall.ever ? s.distance_m() : 0.0},
         {"misalignment_deg", s.memory.wall.ever ? degrees(s.misalignment_rad()) : 0.0},
         {"pitch_deg", degrees(s.pitch_rad())},
         {"force_N", s.readings.force.value.axial_N},
         {"pressure_Pa", s.pressure_Pa()},
         {"attempt", static_cast<double>(s.memory.attempt)}});
}

void enter(PerchingMemory& memory, const Transition& row, const guards::Scene& s) {
    const Estimate& estimate = s.estimate;
    const Euler attitude = euler_from_quaternion(estimate.q_WB);
    if (row.from == retreating && row.to == pre_positioning) {
        ++memory.attempt;
    }
    memory.has_perched = memory.has_perched || row.to == standing;
    memory.release_given_up = memory.release_given_up || row.to == resealing;
    if (row.outcome) {
        memory.ending = Ending{.outcome = *row.outcome, .reason = row.reason};
    }
    memory.state = row.to;
    if (row.from == deciding && row.to == pitching_up) {
        memory.grip_W_m = joint_W(s.parameters, estimate);
    }
    memory.since_s = s.time_s;
    memory.settled_since_s = -1.0;
    memory.entry_pressure_Pa = s.pressure_Pa();
    memory.entry_p_W_m = estimate.p_WB_m;
    memory.entry_pitch_rad = attitude.pitch_rad;
    memory.entry_yaw_rad = attitude.yaw_rad;
}

/// The wall is looked at until the docking run, then kept: a beam that pitches away lies.
bool looks_at_wall(PerchingState state) {
    return state == pre_positioning || state == aligning || state == approaching;
}

}  // namespace

std::string_view to_string(PerchingState state) {
    switch (state) {
        case hovering: return "hovering";
        case pre_positioning: return "pre_positioning";
        case aligning: return "aligning";
        case approaching: return "approaching";
        case holding: return "holding";
        case deciding: return "deciding";
        case retreating: return "retreating";
        case pitching_up: return "pitching_up";
        case unloading: return "unloading";
        case standing: return "standing";
        case resting: return "resting";
        case spinning_up: return "spinning_up";
        case pitching_down: return "pitching_down";
        case levelled: return "levelled";
        case releasing: return "releasing";
        case resealing: return "resealing";
        case backing_off: return "backing_off";
        case finished: return "finished";
    }
    throw InternalError("perching state out of range");
}

void EventList::add(const Event& event) {
    require(count < events.size(), "an update reports at most eight events");
    events[count++] = event;
}

PerchingMemory start_perching(const PerchingTask& task, const Estimate& estimate, double time_s) {
    PerchingMemory memory;
    memory.state = task.perch ? pre_positioning : hovering;
    memory.since_s = time_s;
    memory.line_W_m = estimate.p_WB_m;
    memory.entry_p_W_m = estimate.p_WB_m;
    memory.entry_yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad;
    memory.setpoint.armed = true;
    return memory;
}

bool rest_on(PerchingMemory& memory, double time_s) {
    if (memory.state != finished || memory.setpoint.armed || !memory.has_perched) {
        return false;
    }
    memory.state = resting;
    memory.since_s = time_s;
    memory.settled_since_s = -1.0;
    memory.ending.reset();
    return true;
}

bool end_rest(const PerchingParameters& parameters, PerchingMemory& memory, double time_s) {
    if (!rest_on(memory, time_s) && memory.state != resting) {
        return false;
    }
    memory.since_s = time_s - parameters.rest_s;
    memory.release_given_up = false;
    return true;
}

void update(const PerchingParameters& parameters, const PerchingTask& task, PerchingMemory& memory,
            const Readings& readings, const Estimate& estimate, double time_s, EventList& events) {
    if (looks_at_wall(memory.state)) {
        see_wall(parameters, memory.wall, readings, estimate);
    }
    const Scene scene{parameters, task, memory, readings, estimate, time_s};
    if (!guards::settling(scene)) {
        memory.settled_since_s = -1.0;
    } else if (memory.settled_since_s < 0.0) {
        memory.settled_since_s = time_s;
    }
    if (!scene.pressure_known() || !guards::weak(scene)) {
        memory.weak_since_s = -1.0;
    } else if (memory.weak_since_s < 0.0) {
        memory.weak_since_s = time_s;
    }
    while (const Transition* row = due_row(scene)) {
        if (row->event) {
            events.add(report(scene, *row, *row->event));
        }
        if (row->second_event) {
            events.add(report(scene, *row, *row->second_event));
        }
        enter(memory, *row, scene);
    }
    memory.setpoint = motion(parameters, memory, estimate, time_s);
}

}  // namespace limpet
