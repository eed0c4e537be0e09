// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/session.hpp"

#include <fmt/format.h>

#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::companion {

PerchingSession::PerchingSession(const SessionSetup& setup, CompanionWatch watch)
    : setup_(setup), watch_(std::move(watch)), task_(setup.task), wanted_(!setup.by_request) {}

CompanionEnd ended_by(Cause cause) {
    return cause == Cause::interrupted ? CompanionEnd::interrupted : CompanionEnd::handed_back;
}

std::string doubt_text(PoseDoubt doubt, double away_m) {
    switch (doubt) {
        case PoseDoubt::none:
        case PoseDoubt::repeats:
        case PoseDoubt::another_body: return std::string(to_string(doubt));
        case PoseDoubt::jumped:
        case PoseDoubt::moves_alone: return fmt::format("{} ({:.2f} m)", to_string(doubt), away_m);
    }
    throw InternalError("pose doubt out of range");
}

/// With what the poses are withheld for.
std::string PerchingSession::cause_text(Cause cause) const {
    if (cause == Cause::pose_stale && inputs_.pose_doubt == PoseDoubt::none &&
        !inputs_.pose_refused.empty()) {
        return fmt::format("{}: {}", to_string(cause), inputs_.pose_refused);
    }
    const bool withheld = cause == Cause::pose_stale && inputs_.pose_doubt != PoseDoubt::none;
    return withheld ? fmt::format("{}: {}", to_string(cause),
                                  doubt_text(inputs_.pose_doubt, inputs_.pose_away_m))
                    : std::string(to_string(cause));
}

void PerchingSession::tick(double time_s) {
    if (last_s_ >= 0.0 && time_s < last_s_) {  // a simulation that began anew
        *this = PerchingSession(setup_, watch_);
    }
    const double period_s = 1.0 / setup_.limits.guidance_rate_Hz;
    const bool late = last_s_ >= 0.0 && time_s - last_s_ - period_s > setup_.limits.late_limit_s;
    const bool flies_us =
        phase_ == SessionPhase::flying || (phase_ == SessionPhase::ready && steers());
    late_ = late_ || (late && flies_us);
    last_s_ = time_s;
    switch (phase_) {
        case SessionPhase::waiting: wait(time_s); break;
        case SessionPhase::ready: stand_ready(time_s); break;
        case SessionPhase::flying: fly(time_s); break;
        case SessionPhase::handed_back: return;
    }
    engaged_ = engaged_ || (streams() && inputs_.autopilot.value.offboard);
}

void PerchingSession::go(SessionPhase phase, double time_s) {
    phase_ = phase;
    phase_s_ = time_s;
}

/// It rests once its motors are known to be off: until then set-points must not stop.
Place PerchingSession::place() const {
    if (phase_ != SessionPhase::flying) {
        return Place::in_air;
    }
    const Place place = place_of(memory_);
    const bool turning = inputs_.autopilot.value.armed;
    return place == Place::at_rest && turning ? Place::on_cup : place;
}

Signs PerchingSession::look(double time_s) const {
    const AutopilotWord& word = inputs_.autopilot.value;
    Signs signs{.disarmed = arming_.seen && setpoint_.armed && !word.armed,
                .interrupted = interrupted_,
                .late = late_,
                .pose_fresh = pose_fresh(time_s),
                .estimate_fresh = stale_estimate(time_s).empty()};
    if (!autopilot_alive(time_s)) {
        signs.autopilot = mavlink::OffboardState::silent;
    } else if (!word.offboard) {
        signs.autopilot =
            engaged_ ? mavlink::OffboardState::taken_away : mavlink::OffboardState::streaming;
    }
    return signs;
}

// --- words of an operator -----------------------------------------------------------------------

Answer PerchingSession::perch(double time_s) {
    if (phase_ == SessionPhase::flying) {
        return {false, place() == Place::at_rest
                           ? "it rests on the wall already"
                           : fmt::format("it is at it: {}", to_string(memory_.state))};
    }
    if (phase_ == SessionPhase::handed_back) {
        interrupted_ = late_ = false;
        go(SessionPhase::waiting, time_s);
        wait(time_s);
    }
    if (phase_ != SessionPhase::ready || !obstacle_.empty()) {
        return {false, fmt::format("not ready: {}", obstacle_)};
    }
    if (!inputs_.autopilot.value.armed) {
        return {false, "the autopilot is not armed: fly to before the wall first"};
    }
    wanted_ = true;
    return {true, steers() || setup_.asks_for_mode ? "begins" : "begins once OFFBOARD is chosen"};
}

Answer PerchingSession::take_off(double time_s) {
    if (phase_ != SessionPhase::flying) {
        return {false, fmt::format("it does not rest on the wall: {}", to_string(phase_))};
    }
    if (!end_rest(setup_.guidance, memory_, time_s)) {
        return {false, fmt::format("it does not rest on the wall: {}", to_string(memory_.state))};
    }
    task_.take_off = true;
    interrupted_ = late_ = false;
    outcome_.reset();
    return {true, "takes off"};
}

Answer PerchingSession::abort() {
    if (phase_ != SessionPhase::flying) {
        const bool was_wanted = std::exchange(wanted_, false);
        return {was_wanted, was_wanted ? "not begun any more" : "there is nothing to abort"};
    }
    task_.take_off = false;
    if (place() == Place::at_rest) {
        return {true, "stays at rest on the wall"};
    }
    interrupted_ = true;
    return {true, std::string(to_string(action_for(Cause::interrupted, place())))};
}

// --- the flight ---------------------------------------------------------------------------------

void PerchingSession::begin(double time_s) {
    go(SessionPhase::flying, time_s);
    wanted_ = interrupted_ = late_ = false;
    task_ = setup_.task;
    pending_ = {};
    outcome_.reset();
    reason_.clear();
    memory_ = start_perching(task_, believe(time_s), time_s);
    arming_ = {.asked_s = time_s, .seen = true};
    watch_.line(time_s, "begins");
    fly(time_s);  // in this tick: a set-point that is none yet would stop the rotors
}

void PerchingSession::fly(double time_s) {
    if (setup_.by_request && place() == Place::at_rest) {
        interrupted_ = false;  // that is where an abort was to bring it
    }
    const Judgement verdict = judge(look(time_s), place());
    if (verdict.action == Action::hold || verdict.action == Action::let_go) {
        watch_.event(make_event(time_s, "companion", EventName::aborted, to_string(verdict.cause)));
        hand_back(verdict.action, ended_by(verdict.cause),
                  fmt::format("{}, {}", cause_text(verdict.cause), to_string(place())), time_s);
        return;
    }
    take_in(verdict, time_s);
    guidance::PerchingTask task = task_;
    task.take_off = task.take_off && verdict.action == Action::carry_on;
    guidance::EventList events;
    update(setup_.guidance, task, memory_, inputs_.readings, believe(time_s), time_s, events);
    for (std::size_t k = 0; k < events.count; ++k) {
        const Event& event = events.events[k];
        // A mission at rest ends again and again: that it cannot take off is reported once.
        const bool rests = place_of(memory_) == Place::at_rest;
        if (!(outcome_ && rests && event.name == EventName::aborted)) {
            watch_.event(event);
        }
    }
    setpoint_ = memory_.setpoint;
    (void)watch_arming(arming_, setpoint_.armed, inputs_.autopilot.value.armed,
                       setup_.limits.arming_s, time_s);
    if (memory_.ending) {
        come_to_end(time_s);
    }
}

/// What is not grave enough to hand back, or is over again.
void PerchingSession::take_in(const Judgement& verdict, double time_s) {
    if (verdict.action == pending_.action && verdict.cause == pending_.cause) {
        return;
    }
    pending_ = verdict;
    const bool well = verdict.action == Action::carry_on;
    obstacle_ = well ? "" : cause_text(verdict.cause);
    watch_.line(time_s, well ? "all is well again"
                             : fmt::format("{}, {}: {}", obstacle_, to_string(place()),
                                           to_string(verdict.action)));
}

void PerchingSession::come_to_end(double time_s) {
    const guidance::Ending ending = *memory_.ending;
    const bool alone = pending_.action == Action::carry_on;
    const bool rests = setup_.by_request && rest_on(memory_, time_s);
    if (!rests || !outcome_) {
        outcome_ = ending.outcome;
        reason_ = alone ? std::string(ending.reason)
                        : fmt::format("{}; {}", ending.reason.view(), to_string(pending_.cause));
    }
    if (rests) {
        task_.take_off = false;
    } else if (setup_.by_request && setpoint_.armed && believe(time_s).valid) {
        go(SessionPhase::ready, time_s);
        setpoint_.pump_on = setpoint_.valve_open = false;
    } else {
        hand_back(setpoint_.armed ? Action::hold : Action::let_go,
                  alone ? CompanionEnd::mission_over : ended_by(pending_.cause), reason_, time_s);
    }
}

// --- after it -----------------------------------------------------------------------------------

void PerchingSession::hand_back(Action action, CompanionEnd end, std::string reason,
                                double time_s) {
    flew_ = phase_ == SessionPhase::flying;
    const Place from = flew_ ? place_of(memory_) : Place::in_air;
    const bool on_wall = from == Place::at_rest || from == Place::on_cup || from == Place::pressed;
    if (action == Action::hold || !on_wall) {
        setpoint_.pump_on = setpoint_.valve_open = false;
    }
    go(SessionPhase::handed_back, time_s);
    wanted_ = engaged_ = false;
    arming_ = {};
    end_ = end;
    left_by_ = action;
    reason_ = std::move(reason);
    obstacle_ = "control was handed back: request perch again";
    watch_.line(time_s, fmt::format("{}{}", to_string(action),
                                    setpoint_.pump_on ? "; the pump stays on" : ""));
}

std::string_view PerchingSession::wanted_mode() const {
    const bool offboard = inputs_.autopilot.value.offboard;
    if (phase_ == SessionPhase::ready && wanted_ && setup_.asks_for_mode && !offboard) {
        return "OFFBOARD";
    }
    const bool holds = phase_ == SessionPhase::handed_back && left_by_ == Action::hold;
    return holds && offboard ? "AUTO.LOITER" : "";
}

std::optional<bool> PerchingSession::wanted_armed() const {
    // One that is silent may be that of a simulation that has just begun anew.
    const bool known = inputs_.autopilot.fresh(last_s_, setup_.limits.silence_limit_s);
    if (phase_ != SessionPhase::flying || !known ||
        setpoint_.armed == inputs_.autopilot.value.armed) {
        return std::nullopt;
    }
    return setpoint_.armed;
}

}  // namespace limpet::companion
