// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/perching.hpp"

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/guards.hpp"
#include "limpet/guidance/lip_turn.hpp"
#include "limpet/guidance/motion.hpp"

namespace limpet::guidance {
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

// GCC 10 has no `using enum`.
using S = PerchingState;
using E = EventName;
using namespace guards;

/// A row that ends the mission with a fault.
constexpr Transition ends(PerchingState from, bool (*guard)(const guards::Scene&),
                          std::string_view reason, Outcome outcome) {
    return {from, guard, S::finished, reason, E::aborted, std::nullopt, outcome};
}
/// A row that ends it as it should.
constexpr Transition done(PerchingState from, bool (*guard)(const guards::Scene&),
                          std::string_view reason, Outcome outcome,
                          std::optional<EventName> event = std::nullopt) {
    return {from, guard, S::finished, reason, event, std::nullopt, outcome};
}

/// The first row of the current state whose guard holds is taken; faults stand above success.
constexpr std::array kTable = {
    done(S::hovering, hover_over, "hovered as asked", Outcome::released),

    ends(S::pre_positioning, estimate_lost, "position estimate lost", Outcome::aborted),
    ends(S::pre_positioning, battery_low, "battery low", Outcome::aborted),
    ends(S::pre_positioning, waited_for_wall,
         "no pre-position in time: the LiDARs never saw a wall within "
         "guidance.wall_near_limit_m",
         Outcome::aborted),
    ends(S::pre_positioning, waited_too_long, "no pre-position before the wall in time",
         Outcome::aborted),
    Transition{S::pre_positioning, settled, S::aligning, "stands at the pre-position",
               E::pre_positioned},

    ends(S::aligning, estimate_lost, "position estimate lost", Outcome::aborted),
    ends(S::aligning, pressure_implausible, "pressure sensor stuck or silent", Outcome::aborted),
    ends(S::aligning, waited_too_long, "not perpendicular to the wall in time", Outcome::aborted),
    ends(S::aligning, too_windy, "too much wind: leans too far", Outcome::aborted),
    ends(S::aligning, too_windy_across,
         "too much wind along the wall: at rest it would tip over a leg", Outcome::aborted),
    Transition{S::aligning, wall_lost, S::pre_positioning, "LiDAR lost"},
    Transition{S::aligning, settled, S::approaching, "perpendicular to the wall",
               E::approach_started},

    Transition{S::approaching, estimate_lost, S::braking, "position estimate lost", E::aborted},
    Transition{S::approaching, wall_hit, S::holding, "pressed on the wall", E::impact},
    Transition{S::approaching, caught, S::holding, "the wall stops it, and the cup holds",
               E::impact},
    Transition{S::approaching, wall_lost, S::retreating, "LiDAR lost", E::aborted},
    Transition{S::approaching, force_lost, S::retreating, "force sensor silent", E::aborted},
    Transition{S::approaching, approach_too_long, S::retreating, "no impact in time", E::aborted},

    Transition{S::holding, hold_is_over, S::deciding, "held", E::hold_over},
    Transition{S::deciding, sealed, S::pitching_up, "pressure below P_land", E::landing_started},
    Transition{S::deciding, seal_lost, S::retreating, "sealed, but does not hold",
               E::retreat_started},
    Transition{S::deciding, always, S::retreating, "no seal", E::retreat_started},

    Transition{S::retreating, estimate_lost, S::braking, "position estimate lost", E::aborted},
    done(S::retreating, all_seals_lost, "sealed and came off in every attempt",
         Outcome::failed_to_seal),
    done(S::retreating, attempts_used_up, "no landing in any attempt", Outcome::failed_to_seal),
    Transition{S::retreating, settled, S::pre_positioning, "tries again"},
    Transition{S::retreating, held_back, S::resealing, "the cup does not come off", E::aborted},
    ends(S::retreating, retreat_too_long, "does not get back to the pre-position",
         Outcome::aborted),

    Transition{S::braking, estimate_back_perched, S::backing_off, "position estimate is back"},
    Transition{S::braking, estimate_back, S::retreating, "position estimate is back"},
    done(S::braking, settled_released, "off the wall, position estimate lost", Outcome::released),
    done(S::braking, settled, "stands before the wall, position estimate lost", Outcome::aborted),
    Transition{S::braking, brakes_held, S::resealing, "the cup does not come off", E::aborted},
    ends(S::braking, retreat_too_long, "position estimate lost, does not come to a stand",
         Outcome::aborted),

    Transition{S::pitching_up, came_off, S::retreating, "came off the wall", E::aborted},
    Transition{S::pitching_up, vacuum_lost, S::retreating, "vacuum lost", E::aborted},
    Transition{S::pitching_up, pitched_up, S::unloading, "pitched up"},
    Transition{S::unloading, came_off, S::retreating, "came off the wall", E::aborted},
    Transition{S::unloading, vacuum_lost, S::retreating, "vacuum lost", E::aborted},
    Transition{S::unloading, landing_too_long, S::pitching_down,
               "does not come to rest on its legs", E::aborted},
    Transition{S::unloading, settled, S::standing, "pitch steady on the legs", E::perched},
    Transition{S::standing, always, S::resting, "rests", E::motors_off},

    Transition{S::resting, vacuum_lost, S::spinning_up, "vacuum weak", E::motors_on},
    done(S::resting, rest_over_given_up, "rests after the release was given up",
         Outcome::release_aborted),
    done(S::resting, rest_over_stay, "rests on the wall", Outcome::perched),
    ends(S::resting, battery_low_stays, "battery low: rests on the wall", Outcome::perched),
    ends(S::resting, rest_over_blind, "no position estimate: rests on the wall",
         Outcome::release_aborted),
    ends(S::resting, rest_over_turned, "heading is not the wall's: rests on the wall",
         Outcome::release_aborted),
    Transition{S::resting, battery_low_flies, S::spinning_up, "battery low", E::motors_on},
    Transition{S::resting, rest_over_still, S::spinning_up, "rest over", E::motors_on},

    Transition{S::spinning_up, came_off, S::backing_off, "came off the wall", E::aborted},
    Transition{S::spinning_up, spun_up, S::pitching_down, "rotors carry their share"},
    Transition{S::pitching_down, came_off, S::backing_off, "came off the wall", E::aborted},
    Transition{S::pitching_down, settled, S::levelled, "level and stable", E::level},
    Transition{S::pitching_down, not_level_in_time, S::resealing, "not level in time", E::aborted},
    Transition{S::levelled, valve_fitted, S::releasing, "breaks the vacuum", E::pump_off,
               E::valve_open},
    Transition{S::levelled, always, S::releasing, "lets the air in", E::pump_off},

    Transition{S::releasing, came_off, S::backing_off, "came off the wall"},
    Transition{S::releasing, estimate_lost, S::resealing, "position estimate lost", E::aborted},
    Transition{S::releasing, stuck_behind_valve, S::backing_off,
               "pressure sensor stuck, valve open"},
    Transition{S::releasing, pressure_stuck, S::resealing, "pressure sensor stuck", E::aborted},
    Transition{S::releasing, pressure_safe, S::backing_off, "pressure above the safe threshold",
               E::pressure_released},
    Transition{S::releasing, swings, S::resealing, "oscillation past its limit", E::aborted},
    Transition{S::releasing, release_too_long, S::resealing, "pressure not released in time",
               E::aborted},

    Transition{S::resealing, came_off, S::backing_off, "came off the wall"},
    Transition{S::resealing, sealed, S::pitching_up, "vacuum is back", E::landing_started},
    Transition{S::resealing, no_vacuum, S::backing_off, "no vacuum to rest on"},
    Transition{S::resealing, reseals_blind, S::pitching_up,
               "pressure unknown: rests with the pump on", E::landing_started},

    Transition{S::backing_off, estimate_lost, S::braking, "position estimate lost", E::aborted},
    done(S::backing_off, back_unperched, "back without having perched", Outcome::failed_to_seal,
         E::backed_off),
    done(S::backing_off, settled_released, "back at the pre-position", Outcome::released,
         E::backed_off),
    done(S::backing_off, settled, "came off the wall, back at the pre-position", Outcome::aborted,
         E::backed_off),
    Transition{S::backing_off, seals_again, S::releasing, "the cup seals again while it leaves",
               E::aborted},
    Transition{S::backing_off, held_back, S::resealing, "the cup does not come off", E::aborted},
    ends(S::backing_off, too_long_released, "off the wall, not back at the pre-position in time",
         Outcome::released),
    ends(S::backing_off, retreat_too_long,
         "came off the wall, not back at the pre-position in time", Outcome::aborted),
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
    if (row.from == S::retreating && row.to == S::pre_positioning) {
        ++memory.attempt;
    }
    const bool leaves = row.to == S::retreating || row.to == S::backing_off;
    memory.has_perched = memory.has_perched || row.to == S::standing;
    memory.cup.sealed_again += row.guard == seals_again ? 1 : 0;
    memory.release_given_up = memory.release_given_up || row.to == S::resealing;
    memory.cup.lets_go = row.to == S::releasing || (memory.cup.lets_go && row.to != S::resealing);
    memory.cup.pump_stays = row.to == S::braking
                                ? memory.cup.pump_stays
                                : leaves && row.guard == came_off && seems_sealed(s);
    // What pulls at a wall for so long is held, whatever the sensor says.
    memory.cup.pressure_doubted =
        memory.cup.pressure_doubted ||
        (row.to == S::resealing && (row.guard == held_back || row.guard == brakes_held) &&
         s.pressure_known() && (!seems_sealed(s) || pressure_stuck(s)));
    if (row.to == S::approaching) {
        memory.cup.sealed = false;
    } else if (row.to == S::retreating && row.from != S::braking) {
        memory.cup.seals_lost += memory.cup.sealed ? 1 : 0;
    }
    if (row.outcome) {
        memory.ending = Ending{.outcome = *row.outcome, .reason = row.reason};
    }
    memory.state = row.to;
    const bool held_in_retreat = row.from == S::retreating || row.from == S::braking;
    if (row.to == S::deciding || (held_in_retreat && row.to == S::resealing)) {
        memory.grip_W_m = joint_W(s.parameters, estimate);
        memory.off_since_s = -1.0;
    }
    if (row.to == S::aligning) {
        memory.wind.trim_W_m_s2 = lean_W_m_s2(estimate.q_WB);
    }
    if (row.to == S::spinning_up || row.from == S::deciding) {
        memory.wind.side_m_s2 = 0.0;
        memory.wind.turn_rad = lip_turn_rad(memory.wall.into_wall_W(), estimate.q_WB);
    }
    memory.since_s = s.time_s;
    memory.settled_since_s = -1.0;
    memory.rest.q_WB = estimate.q_WB;
    memory.entry_p_W_m = estimate.p_WB_m;
    memory.entry_pitch_rad = windy(s.parameters, memory)
                                 ? pitch_on_lip_rad(memory.wall.into_wall_W(), estimate.q_WB)
                                 : attitude.pitch_rad;
    memory.entry_yaw_rad = attitude.yaw_rad;
}

/// Standing before the wall it estimates the wind; on the cup, what more keeps its side.
void feel_wind(const PerchingParameters& parameters, PerchingMemory& memory,
               const Estimate& estimate, double time_s) {
    constexpr double kLongest_s =
        0.1;  // a clock that jumps; guidance slower than this estimates less
    const double dt_s = std::clamp(time_s - memory.wind.updated_s, 0.0, kLongest_s);
    memory.wind.updated_s = time_s;
    if (!estimate.valid) {
        return;
    }
    if (memory.state == S::aligning) {
        const Vector3 lean = lean_W_m_s2(estimate.q_WB);
        memory.wind.trim_W_m_s2 +=
            dt_s / (parameters.wind_filter_s + dt_s) * (lean - memory.wind.trim_W_m_s2);
        memory.wind.most_m_s2 = std::max(memory.wind.most_m_s2, lean.norm());
    } else if (!sits_on_grip(parameters, memory, estimate)) {
        return;
    } else if (memory.state == S::pitching_up || memory.state == S::pitching_down ||
               memory.state == S::levelled || memory.state == S::releasing ||
               memory.state == S::resealing) {
        memory.wind.side_m_s2 =
            std::clamp(memory.wind.side_m_s2 - dt_s * parameters.side_integral_1_s3 *
                                                   side_error_m(parameters, memory, estimate),
                       -parameters.side_limit_m_s2, parameters.side_limit_m_s2);
        const double turned_rad = lip_turn_rad(memory.wall.into_wall_W(), estimate.q_WB);
        memory.wind.turn_rad +=
            dt_s / (parameters.wind_filter_s + dt_s) * (turned_rad - memory.wind.turn_rad);
    }
}

/// On its legs nothing turns it any more: an attitude that moves there is the estimate's, which is
/// still finding it, as after a gyro's bias has changed.
void watch_rest(const PerchingParameters& parameters, PerchingMemory& memory,
                const Estimate& estimate, double time_s) {
    if (memory.state == S::resting &&
        memory.rest.q_WB.angularDistance(estimate.q_WB) > radians(parameters.moved_limit_deg)) {
        memory.rest.q_WB = estimate.q_WB;
        memory.rest.moved_s = time_s;
    }
}

/// A sensor that is stuck gives one value, any other one scatters.
void watch_pressure(const PerchingParameters& parameters, PerchingMemory& memory,
                    const Readings& readings, double time_s) {
    const double pressure_Pa = readings.cup_pressure.value.pressure_Pa;
    if (std::abs(pressure_Pa - memory.cup.moved_Pa) >= parameters.stuck_pressure_Pa) {
        memory.cup.moved_Pa = pressure_Pa;
        memory.cup.moved_s = time_s;
    }
}

/// The wall is looked at until the docking run, then kept: a beam that pitches away lies.
bool looks_at_wall(PerchingState state) {
    return state == S::pre_positioning || state == S::aligning || state == S::approaching ||
           state == S::braking;
}

}  // namespace

void EventList::add(const Event& event) {
    require(count < events.size(), "there is space for all that can happen in a tick");
    events[count++] = event;
}

PerchingMemory start_perching(const PerchingTask& task, const Estimate& estimate, double time_s) {
    PerchingMemory memory;
    memory.state = task.perch ? S::pre_positioning : S::hovering;
    memory.since_s = time_s;
    memory.line_W_m = estimate.p_WB_m;
    memory.entry_p_W_m = estimate.p_WB_m;
    memory.entry_yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad;
    memory.setpoint.armed = true;
    return memory;
}

bool rest_on(PerchingMemory& memory, double time_s) {
    if (memory.state != PerchingState::finished || memory.setpoint.armed || !memory.has_perched) {
        return false;
    }
    memory.state = PerchingState::resting;
    memory.since_s = time_s;
    memory.settled_since_s = -1.0;
    memory.ending.reset();
    return true;
}

bool end_rest(const PerchingParameters& parameters, PerchingMemory& memory, double time_s) {
    if (!rest_on(memory, time_s) && memory.state != PerchingState::resting) {
        return false;
    }
    memory.since_s = time_s - parameters.rest_s;
    memory.release_given_up = false;
    return true;
}

void update(const PerchingParameters& parameters, const PerchingTask& task, PerchingMemory& memory,
            const Readings& readings, const Estimate& reported, double time_s, EventList& events) {
    Estimate estimate = reported;
    if (memory.state == S::resting && time_s - reported.time_s > parameters.sensor_limit_s) {
        estimate.valid = false;  // nobody leaves the wall by an attitude of long ago
    }
    if (looks_at_wall(memory.state)) {
        see_wall(parameters, memory.wall, readings, estimate);
    }
    feel_wind(parameters, memory, estimate, time_s);
    watch_rest(parameters, memory, estimate, time_s);
    watch_pressure(parameters, memory, readings, time_s);
    const Scene scene{parameters, task, memory, readings, estimate, time_s};
    const auto since = [time_s](double& since_s, bool holds) {
        since_s = !holds ? -1.0 : since_s < 0.0 ? time_s : since_s;
    };
    memory.cup.sealed = memory.cup.sealed || (memory.state == S::holding && sealed(scene));
    since(memory.settled_since_s, guards::settling(scene));
    since(memory.weak_since_s, scene.pressure_known() && guards::weak(scene));
    since(memory.off_since_s, guards::looks_off(scene));
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

}  // namespace limpet::guidance
