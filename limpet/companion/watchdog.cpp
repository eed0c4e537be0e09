// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/watchdog.hpp"

#include <array>

#include "limpet/core/errors.hpp"

namespace limpet::companion {
namespace {

struct Row {
    Cause cause;
    std::string_view text;
    bool (*applies)(const Signs&);
    std::array<Action, 5> at;  ///< by Place
};

// GCC 10 has no `using enum`.
using A = Action;

/// In the order of Cause.
constexpr std::array kTable = {
    //                                        in_air  pressed  leaving  on_cup  at_rest
    Row{Cause::mode_taken,
        "another mode was chosen",
        [](const Signs& s) { return s.autopilot == mavlink::OffboardState::taken_away; },
        {A::let_go, A::let_go, A::let_go, A::let_go, A::let_go}},
    Row{Cause::disarmed,
        "disarmed by somebody else",
        [](const Signs& s) { return s.disarmed; },
        {A::let_go, A::let_go, A::let_go, A::let_go, A::carry_on}},
    Row{Cause::interrupted,
        "interrupted",
        [](const Signs& s) { return s.interrupted; },
        {A::hold, A::finish, A::finish, A::finish, A::let_go}},
    Row{Cause::autopilot_silent,
        "autopilot silent",
        [](const Signs& s) { return s.autopilot == mavlink::OffboardState::silent; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::loop_late,
        "guidance came too late",
        [](const Signs& s) { return s.late; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::pose_stale,
        "motion-capture pose stale",
        [](const Signs& s) { return !s.pose_fresh; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::estimate_stale,
        "autopilot's pose stale",
        [](const Signs& s) { return !s.estimate_fresh; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
};

const Row& row_of(Cause cause) {
    return kTable.at(static_cast<std::size_t>(cause));
}

}  // namespace

std::string_view to_string(Place place) {
    switch (place) {
        case Place::in_air: return "in the air";
        case Place::pressed: return "pressed on the wall";
        case Place::leaving: return "leaving the wall";
        case Place::on_cup: return "on the cup, motors on";
        case Place::at_rest: return "at rest on the wall";
    }
    throw InternalError("place out of range");
}

std::string_view to_string(Cause cause) {
    return row_of(cause).text;
}

std::string_view to_string(Action action) {
    switch (action) {
        case Action::carry_on: return "carries on";
        case Action::finish: return "goes on until it rests or is off the wall";
        case Action::hold: return "hands back: hold";
        case Action::let_go: return "hands back: nothing requested";
    }
    throw InternalError("action out of range");
}

Place place_of(const guidance::PerchingMemory& memory) {
    switch (memory.state) {
        case guidance::PerchingState::hovering:
        case guidance::PerchingState::pre_positioning:
        case guidance::PerchingState::aligning:
        case guidance::PerchingState::approaching: return Place::in_air;
        case guidance::PerchingState::holding:
        case guidance::PerchingState::deciding: return Place::pressed;
        case guidance::PerchingState::retreating:
        case guidance::PerchingState::backing_off:
        case guidance::PerchingState::braking: return Place::leaving;
        case guidance::PerchingState::pitching_up:
        case guidance::PerchingState::unloading:
        case guidance::PerchingState::spinning_up:
        case guidance::PerchingState::pitching_down:
        case guidance::PerchingState::levelled:
        case guidance::PerchingState::releasing:
        case guidance::PerchingState::resealing: return Place::on_cup;
        case guidance::PerchingState::standing:
        case guidance::PerchingState::resting: return Place::at_rest;
        case guidance::PerchingState::finished:
            return memory.setpoint.armed ? Place::in_air : Place::at_rest;
    }
    throw InternalError("perching state out of range");
}

Action action_for(Cause cause, Place place) {
    return row_of(cause).at[static_cast<std::size_t>(place)];
}

Judgement judge(const Signs& signs, Place place) {
    for (const Row& row : kTable) {
        const Action action = row.at[static_cast<std::size_t>(place)];
        if (row.applies(signs) && action != Action::carry_on) {
            return {.action = action, .cause = row.cause};
        }
    }
    return {};
}

bool watch_arming(ArmingWatch& watch, bool requested, bool armed, double arming_s, double time_s) {
    if (!requested) {
        watch = {};
        return false;
    }
    if (watch.asked_s < 0.0) {
        watch.asked_s = time_s;
    }
    const bool settled = time_s - watch.asked_s >= arming_s;
    watch.seen = watch.seen || (settled && armed);
    return watch.seen && !armed;
}

}  // namespace limpet::companion
