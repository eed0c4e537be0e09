// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/watchdog.hpp"

#include <array>

#include "limpet/core/errors.hpp"

namespace limpet::companion {
namespace {

struct Row {
    Cause cause;
    bool (*applies)(const Signs&);
    std::array<Action, 5> at;  ///< by Place
};

// GCC 10 has no `using enum`.
using A = Action;

constexpr std::array kTable = {
    //                                        in_air  pressed  leaving  on_cup  at_rest
    Row{Cause::mode_taken,
        [](const Signs& s) { return s.autopilot == mavlink::OffboardState::taken_away; },
        {A::let_go, A::let_go, A::let_go, A::let_go, A::let_go}},
    Row{Cause::disarmed,
        [](const Signs& s) { return s.disarmed; },
        {A::let_go, A::let_go, A::let_go, A::let_go, A::carry_on}},
    Row{Cause::interrupted,
        [](const Signs& s) { return s.interrupted; },
        {A::hold, A::finish, A::finish, A::finish, A::let_go}},
    Row{Cause::autopilot_silent,
        [](const Signs& s) { return s.autopilot == mavlink::OffboardState::silent; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::loop_late,
        [](const Signs& s) { return s.late; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::pose_stale,
        [](const Signs& s) { return !s.pose_fresh; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
    Row{Cause::estimate_stale,
        [](const Signs& s) { return !s.estimate_fresh; },
        {A::hold, A::finish, A::hold, A::finish, A::finish}},
};

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
    switch (cause) {
        case Cause::mode_taken: return "another mode was chosen";
        case Cause::disarmed: return "disarmed by somebody else";
        case Cause::interrupted: return "interrupted";
        case Cause::autopilot_silent: return "autopilot silent";
        case Cause::loop_late: return "guidance came too late";
        case Cause::pose_stale: return "motion-capture pose stale";
        case Cause::estimate_stale: return "autopilot's pose stale";
    }
    throw InternalError("cause out of range");
}

std::string_view to_string(Action action) {
    switch (action) {
        case Action::carry_on: return "carries on";
        case Action::finish: return "goes on until it rests or is off the wall";
        case Action::hold: return "hands back: hold";
        case Action::let_go: return "hands back: nothing asked for";
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
        case guidance::PerchingState::backing_off: return Place::leaving;
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
    for (const Row& row : kTable) {
        if (row.cause == cause) {
            return row.at[static_cast<std::size_t>(place)];
        }
    }
    throw InternalError("a cause without a row");
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

bool watch_arming(ArmingWatch& watch, bool asked, bool armed, double arming_s, double time_s) {
    if (!asked) {
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
