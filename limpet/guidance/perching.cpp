// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/perching.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/motion.hpp"

namespace limpet {
namespace {

/// All that a guard may look at.
struct Scene {
    const PerchingParameters& parameters;
    const PerchingTask& task;
    const PerchingMemory& memory;
    const Readings& readings;
    const Estimate& estimate;
    double time_s;

    [[nodiscard]] double elapsed_s() const { return time_s - memory.since_s; }
    [[nodiscard]] double distance_m() const {
        return memory.wall.distance_m(parameters, estimate.p_WB_m);
    }
    [[nodiscard]] bool settled() const {
        return memory.settled_since_s >= 0.0 &&
               time_s - memory.settled_since_s >= parameters.settle_s;
    }
    [[nodiscard]] double pitch_rad() const {
        return euler_from_quaternion(estimate.q_WB).pitch_rad;
    }
    [[nodiscard]] double roll_rad() const { return euler_from_quaternion(estimate.q_WB).roll_rad; }
    [[nodiscard]] bool pressure_known() const {
        return readings.cup_pressure.fresh(time_s, parameters.sensor_limit_s);
    }
    [[nodiscard]] double pressure_Pa() const { return readings.cup_pressure.value.pressure_Pa; }
};

// --- conditions that must hold for settle_s ---------------------------------------------------

bool stands_at_pre_position(const Scene& s) {
    return s.memory.wall.ever &&
           (s.estimate.p_WB_m - pre_position_W(s.parameters, s.memory)).norm() <
               s.parameters.pre_tolerance_m &&
           s.estimate.v_WB_m_s.norm() < s.parameters.pre_speed_m_s;
}

bool sees_wall(const Scene& s) {
    return s.time_s - s.memory.wall.time_s <= s.parameters.sensor_limit_s;
}

bool faces_wall(const Scene& s) {
    const double off_rad =
        wrap_pi(euler_from_quaternion(s.estimate.q_WB).yaw_rad - s.memory.wall.heading_rad);
    // Half of the limit: the other half is for the noise of the two LiDARs.
    return std::abs(off_rad) < 0.5 * radians(s.parameters.align_limit_deg) &&
           stands_at_pre_position(s);
}

bool rests_on_legs(const Scene& s) {
    return s.elapsed_s() > s.parameters.land_thrust_s &&
           std::abs(s.estimate.w_WB_B_rad_s.y()) < radians(s.parameters.rest_rate_deg_s);
}

bool is_level(const Scene& s) {
    return s.elapsed_s() > s.parameters.level_pitch_s &&
           std::abs(s.pitch_rad()) < radians(s.parameters.level_limit_deg) &&
           s.estimate.w_WB_B_rad_s.norm() < radians(s.parameters.level_rate_deg_s);
}

bool settling(const Scene& s) {
    switch (s.memory.state) {
        case PerchingState::pre_positioning: return stands_at_pre_position(s) && sees_wall(s);
        case PerchingState::retreating:
        case PerchingState::backing_off: return stands_at_pre_position(s);
        case PerchingState::aligning: return faces_wall(s);
        case PerchingState::unloading: return rests_on_legs(s);
        case PerchingState::pitching_down: return is_level(s);
        case PerchingState::hovering:
        case PerchingState::approaching:
        case PerchingState::holding:
        case PerchingState::deciding:
        case PerchingState::pitching_up:
        case PerchingState::standing:
        case PerchingState::resting:
        case PerchingState::spinning_up:
        case PerchingState::levelled:
        case PerchingState::releasing:
        case PerchingState::resealing:
        case PerchingState::finished: return false;
    }
    throw InternalError("perching state out of range");
}

// --- guards -----------------------------------------------------------------------------------

bool always(const Scene&) {
    return true;
}
bool settled(const Scene& s) {
    return s.settled();
}
bool hover_over(const Scene& s) {
    return s.elapsed_s() >= s.task.hover_s;
}
bool waited_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.wait_limit_s;
}
bool battery_low(const Scene& s) {
    return s.readings.battery.ever() &&
           s.readings.battery.value.remaining < s.parameters.battery_reserve;
}
bool wall_lost(const Scene& s) {
    return !sees_wall(s);
}
bool force_lost(const Scene& s) {
    return !s.readings.force.fresh(s.time_s, s.parameters.sensor_limit_s);
}
/// A free cup is at atmospheric pressure: a sensor that says otherwise, or nothing, is broken.
bool pressure_implausible(const Scene& s) {
    return s.elapsed_s() > s.parameters.settle_s &&
           (!s.pressure_known() || s.pressure_Pa() < s.parameters.land_pressure_Pa);
}
bool wall_hit(const Scene& s) {
    return s.readings.force.value.axial_N < -s.parameters.impact_force_N;
}
bool approach_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.approach_limit_s;
}
bool hold_is_over(const Scene& s) {
    return s.elapsed_s() >= s.parameters.hold_s;
}
bool sealed(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() < s.parameters.land_pressure_Pa;
}
bool vacuum_lost(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() > s.parameters.land_pressure_Pa;
}
bool pitched_up(const Scene& s) {
    return s.elapsed_s() >= s.parameters.land_pitch_s;
}
bool landing_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.land_limit_s;
}
bool retreat_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.retreat_limit_s;
}
bool attempts_used_up(const Scene& s) {
    return s.settled() && s.memory.attempt >= static_cast<int>(s.parameters.attempts);
}
bool rest_over(const Scene& s) {
    return s.elapsed_s() >= s.parameters.rest_s;
}
bool rest_over_given_up(const Scene& s) {
    return s.memory.release_given_up && rest_over(s);
}
bool rest_over_stay(const Scene& s) {
    return !s.task.take_off && rest_over(s);
}
bool spun_up(const Scene& s) {
    return s.elapsed_s() >= s.parameters.spin_up_s;
}
bool not_level_in_time(const Scene& s) {
    return s.elapsed_s() > s.parameters.level_limit_s;
}
bool valve_fitted(const Scene& s) {
    return s.parameters.valve_fitted > 0.5;
}
bool pressure_safe(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() > s.parameters.detach_pressure_Pa;
}
bool swings(const Scene& s) {
    return std::max(std::abs(s.pitch_rad()), std::abs(s.roll_rad())) >
           radians(s.parameters.oscillation_limit_deg);
}
bool release_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.release_limit_s;
}
bool reseal_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.reseal_limit_s;
}

// --- the table --------------------------------------------------------------------------------

struct Transition {
    PerchingState from;
    bool (*guard)(const Scene&);
    PerchingState to;
    std::string_view reason;
    std::optional<EventName> event = std::nullopt;
    std::optional<EventName> second_event = std::nullopt;
    std::optional<Outcome> outcome = std::nullopt;
};

using enum PerchingState;
using enum EventName;

/// The first row of the current state whose guard holds is taken; faults stand above success.
constexpr std::array kTable = {
    Transition{hovering, hover_over, finished, "hovered as asked", {}, {}, Outcome::released},

    Transition{pre_positioning,
               battery_low,
               finished,
               "battery low",
               aborted,
               {},
               Outcome::failed_to_seal},
    Transition{pre_positioning,
               waited_too_long,
               finished,
               "no pre-position before the wall in time",
               aborted,
               {},
               Outcome::failed_to_seal},
    Transition{pre_positioning, settled, aligning, "stands at the pre-position", pre_positioned},

    Transition{aligning,
               pressure_implausible,
               finished,
               "pressure sensor stuck or silent",
               aborted,
               {},
               Outcome::failed_to_seal},
    Transition{aligning,
               waited_too_long,
               finished,
               "not perpendicular to the wall in time",
               aborted,
               {},
               Outcome::failed_to_seal},
    Transition{aligning, wall_lost, pre_positioning, "LiDAR lost"},
    Transition{aligning, settled, approaching, "perpendicular to the wall", approach_started},

    Transition{approaching, wall_hit, holding, "pressed on the wall", impact},
    Transition{approaching, wall_lost, retreating, "LiDAR lost", aborted},
    Transition{approaching, force_lost, retreating, "force sensor silent", aborted},
    Transition{approaching, approach_too_long, retreating, "no impact in time", aborted},

    Transition{holding, hold_is_over, deciding, "held", hold_over},
    Transition{deciding, sealed, pitching_up, "pressure below P_land", landing_started},
    Transition{deciding, always, retreating, "no seal", retreat_started},

    Transition{retreating,
               attempts_used_up,
               finished,
               "no seal in any attempt",
               {},
               {},
               Outcome::failed_to_seal},
    Transition{retreating, settled, pre_positioning, "tries again"},
    Transition{retreating,
               retreat_too_long,
               finished,
               "does not get back to the pre-position",
               aborted,
               {},
               Outcome::failed_to_seal},

    Transition{pitching_up, vacuum_lost, retreating, "vacuum lost", aborted},
    Transition{pitching_up, pitched_up, unloading, "pitched up"},
    Transition{unloading, vacuum_lost, retreating, "vacuum lost", aborted},
    Transition{unloading, landing_too_long, pitching_down, "does not come to rest on its legs",
               aborted},
    Transition{unloading, settled, standing, "pitch steady on the legs", perched},
    Transition{standing, always, resting, "rests", motors_off},

    Transition{resting, vacuum_lost, spinning_up, "vacuum weak", motors_on},
    Transition{resting,
               rest_over_given_up,
               finished,
               "rests after the release was given up",
               {},
               {},
               Outcome::release_aborted},
    Transition{resting, rest_over_stay, finished, "rests on the wall", {}, {}, Outcome::perched},
    Transition{resting, rest_over, spinning_up, "rest over", motors_on},

    Transition{spinning_up, spun_up, pitching_down, "rotors carry their share"},
    Transition{pitching_down, settled, levelled, "level and stable", level},
    Transition{pitching_down, not_level_in_time, resealing, "not level in time", aborted},
    Transition{levelled, valve_fitted, releasing, "breaks the vacuum", pump_off, valve_open},
    Transition{levelled, always, releasing, "lets the air in", pump_off},

    Transition{releasing, pressure_safe, backing_off, "pressure above the safe threshold",
               pressure_released},
    Transition{releasing, swings, resealing, "oscillation past its limit", aborted},
    Transition{releasing, release_too_long, resealing, "pressure not released in time", aborted},
    Transition{resealing, sealed, pitching_up, "vacuum is back", landing_started},
    Transition{resealing, reseal_too_long, backing_off, "no vacuum to rest on"},

    Transition{backing_off,
               settled,
               finished,
               "back at the pre-position",
               backed_off,
               {},
               Outcome::released},
    Transition{backing_off, retreat_too_long, resealing, "the cup does not come off", aborted},
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
    return make_event(s.time_s, "guidance", name, row.reason,
                      {{"distance_m", s.memory.wall.ever ? s.distance_m() : 0.0},
                       {"alpha_deg", degrees(s.memory.wall.alpha_rad)},
                       {"pitch_deg", degrees(s.pitch_rad())},
                       {"force_N", s.readings.force.value.axial_N},
                       {"pressure_Pa", s.pressure_Pa()},
                       {"attempt", static_cast<double>(s.memory.attempt)}});
}

void enter(PerchingMemory& memory, const Transition& row, const Estimate& estimate, double time_s) {
    const Euler attitude = euler_from_quaternion(estimate.q_WB);
    if (row.from == retreating && row.to == pre_positioning) {
        ++memory.attempt;
    }
    if (row.to == resealing) {
        memory.release_given_up = true;
    }
    if (row.outcome) {
        memory.ending = Ending{.outcome = *row.outcome, .reason = row.reason};
    }
    memory.state = row.to;
    memory.since_s = time_s;
    memory.settled_since_s = -1.0;
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

void update(const PerchingParameters& parameters, const PerchingTask& task, PerchingMemory& memory,
            const Readings& readings, const Estimate& estimate, double time_s, EventList& events) {
    if (looks_at_wall(memory.state)) {
        see_wall(parameters, memory.wall, readings, estimate);
    }
    const Scene scene{parameters, task, memory, readings, estimate, time_s};
    if (!settling(scene)) {
        memory.settled_since_s = -1.0;
    } else if (memory.settled_since_s < 0.0) {
        memory.settled_since_s = time_s;
    }
    while (const Transition* row = due_row(scene)) {
        if (row->event) {
            events.add(report(scene, *row, *row->event));
        }
        if (row->second_event) {
            events.add(report(scene, *row, *row->second_event));
        }
        enter(memory, *row, estimate, time_s);
    }
    memory.setpoint = motion(parameters, memory, estimate, time_s);
}

}  // namespace limpet
