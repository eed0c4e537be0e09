// SPDX-License-Identifier: Apache-2.0
#include "ros/src/session.hpp"

#include <fmt/format.h>

#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::ros {
namespace {

void name(std::string& list, std::string_view what) {
    list += list.empty() ? "no " : ", no ";
    list += what;
}

}  // namespace

std::string_view to_string(SessionPhase phase) {
    switch (phase) {
        case SessionPhase::waiting: return "waiting";
        case SessionPhase::ready: return "ready";
        case SessionPhase::flying: return "flying";
        case SessionPhase::handed_back: return "handed_back";
    }
    throw InternalError("phase out of range");
}

// --- inputs -------------------------------------------------------------------------------------

bool PerchingSession::estimate_fresh(double time_s) const {
    const double limit_s = setup_.limits.estimate_limit_s;
    return inputs_.pose.fresh(time_s, limit_s) && inputs_.velocity_W_m_s.fresh(time_s, limit_s) &&
           inputs_.rate_B_rad_s.fresh(time_s, limit_s);
}

Estimate PerchingSession::believe(double time_s) const {
    Estimate estimate;
    estimate.time_s = inputs_.pose.time_s;
    estimate.p_WB_m = inputs_.pose.value.p_WB_m;
    estimate.q_WB = inputs_.pose.value.q_WB;
    estimate.v_WB_m_s = inputs_.velocity_W_m_s.value;
    estimate.w_WB_B_rad_s = inputs_.rate_B_rad_s.value;
    estimate.valid = estimate_fresh(time_s);
    return estimate;
}

/// In OFFBOARD and armed, by its last word.
bool PerchingSession::steers(double time_s) const {
    const AutopilotWord& word = inputs_.autopilot.value;
    return inputs_.autopilot.fresh(time_s, setup_.limits.silence_limit_s) && word.connected &&
           word.offboard && word.armed;
}

std::string PerchingSession::missing(double time_s) const {
    const CompanionLimits& limits = setup_.limits;
    const double sensor_s = setup_.guidance.sensor_limit_s;
    const Readings& readings = inputs_.readings;
    std::string list;
    const auto want = [&](bool here, std::string_view what) {
        if (!here) {
            name(list, what);
        }
    };
    want(inputs_.autopilot.fresh(time_s, limits.silence_limit_s) &&
             inputs_.autopilot.value.connected,
         "autopilot");
    want(inputs_.pose.fresh(time_s, limits.estimate_limit_s), "pose");
    want(inputs_.velocity_W_m_s.fresh(time_s, limits.estimate_limit_s), "velocity");
    want(inputs_.rate_B_rad_s.fresh(time_s, limits.estimate_limit_s), "angular velocity");
    want(readings.lidar_left.fresh(time_s, sensor_s), "left LiDAR");
    want(readings.lidar_right.fresh(time_s, sensor_s), "right LiDAR");
    want(readings.force.fresh(time_s, sensor_s), "force");
    want(readings.cup_pressure.fresh(time_s, sensor_s), "cup pressure");
    if (list.empty() && !drives_mechanism_) {
        list = fmt::format(
            "the cup is not free (it holds {:.0f} hPa: on a wall? the pump is left as it is)",
            readings.cup_pressure.value.pressure_Pa / 100.0);
    }
    return list;
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
    Signs signs{.interrupted = aborted_, .late = late_, .estimate_fresh = estimate_fresh(time_s)};
    if (!inputs_.autopilot.fresh(time_s, setup_.limits.silence_limit_s) || !word.connected) {
        signs.autopilot = mavlink::OffboardState::silent;
    } else if (!word.offboard) {
        signs.autopilot =
            engaged_ ? mavlink::OffboardState::taken_away : mavlink::OffboardState::streaming;
    }
    signs.disarmed = arming_.seen && setpoint_.armed && !word.armed;
    return signs;
}

// --- services -----------------------------------------------------------------------------------

Answer PerchingSession::perch(double time_s) {
    if (phase_ == SessionPhase::flying) {
        return {false, place() == Place::at_rest
                           ? "it rests on the wall already"
                           : fmt::format("it is at it: {}", limpet::to_string(memory_.state))};
    }
    if (phase_ == SessionPhase::handed_back) {
        phase_ = SessionPhase::waiting;
        phase_s_ = time_s;
        wait(time_s);
    }
    if (phase_ != SessionPhase::ready) {
        return {false, fmt::format("not ready: {}", obstacle_)};
    }
    if (!inputs_.autopilot.value.armed) {
        return {false, "the autopilot is not armed: fly to before the wall first"};
    }
    asked_ = true;
    return {true,
            steers(time_s) || setup_.asks_for_mode ? "begins" : "begins once OFFBOARD is chosen"};
}

Answer PerchingSession::take_off(double time_s) {
    if (phase_ != SessionPhase::flying) {
        return {false, fmt::format("it does not rest on the wall: {}", to_string(phase_))};
    }
    if (!end_rest(setup_.guidance, memory_, time_s)) {
        return {false,
                fmt::format("it does not rest on the wall: {}", limpet::to_string(memory_.state))};
    }
    takes_off_ = true;
    aborted_ = late_ = false;
    outcome_.reset();
    return {true, "takes off"};
}

Answer PerchingSession::abort(double /*time_s*/) {
    if (phase_ != SessionPhase::flying) {
        const bool was_asked = std::exchange(asked_, false);
        return {was_asked, was_asked ? "not begun any more" : "there is nothing to abort"};
    }
    takes_off_ = false;
    if (place() == Place::at_rest) {
        return {true, "stays at rest on the wall"};
    }
    aborted_ = true;
    return {true, std::string(limpet::to_string(action_for(Cause::interrupted, place())))};
}

// --- the phases ---------------------------------------------------------------------------------

void PerchingSession::tick(double time_s) {
    events_.clear();
    if (last_s_ >= 0.0 && time_s < last_s_) {  // a simulation that began anew
        *this = PerchingSession(setup_);
    }
    const bool late = last_s_ >= 0.0 && time_s - last_s_ > setup_.limits.late_limit_s;
    late_ = late_ || (late && phase_ == SessionPhase::flying);
    last_s_ = time_s;
    switch (phase_) {
        case SessionPhase::waiting: wait(time_s); return;
        case SessionPhase::ready: stand_ready(time_s); return;
        case SessionPhase::flying: fly(time_s); return;
        case SessionPhase::handed_back: return;
    }
}

void PerchingSession::wait(double time_s) {
    const Sample<PressureReading>& pressure = inputs_.readings.cup_pressure;
    drives_mechanism_ =
        drives_mechanism_ || (pressure.fresh(time_s, setup_.guidance.sensor_limit_s) &&
                              pressure.value.pressure_Pa > setup_.guidance.detach_pressure_Pa);
    obstacle_ = missing(time_s);
    if (obstacle_.empty()) {
        phase_ = SessionPhase::ready;
        phase_s_ = time_s;
        setpoint_ = {};
        stay(time_s);
    }
}

/// Set-points follow the vehicle until it flies them. Motors stay as they are.
void PerchingSession::stay(double time_s) {
    const Estimate estimate = believe(time_s);
    if (!steers(time_s) || !std::holds_alternative<PositionSetpoint>(setpoint_.motion)) {
        setpoint_.motion = PositionSetpoint{
            .p_W_m = estimate.p_WB_m, .yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad};
    }
    setpoint_.armed = inputs_.autopilot.value.armed;
}

void PerchingSession::stand_ready(double time_s) {
    obstacle_ = missing(time_s);
    stay(time_s);
    if (steers(time_s) && asked_ && obstacle_.empty()) {
        begin(time_s);
    } else if (steers(time_s)) {
        const Judgement verdict = judge(look(time_s), Place::in_air);
        if (verdict.action != Action::carry_on) {
            hand_back(verdict.action, std::string(limpet::to_string(verdict.cause)), time_s);
        }
    } else if (!obstacle_.empty()) {
        phase_ = SessionPhase::waiting;
        phase_s_ = time_s;
        asked_ = false;
    }
}

void PerchingSession::begin(double time_s) {
    phase_ = SessionPhase::flying;
    phase_s_ = time_s;
    asked_ = aborted_ = late_ = false;
    engaged_ = true;
    takes_off_ = setup_.takes_off;
    outcome_.reset();
    reason_.clear();
    memory_ = start_perching({.perch = true, .take_off = takes_off_}, believe(time_s), time_s);
    arming_ = {.asked_s = time_s, .seen = true};
    fly(time_s);  // in this tick: a set-point that is none yet would stop the rotors
}

void PerchingSession::fly(double time_s) {
    aborted_ = aborted_ && place() != Place::at_rest;  // that is where an abort was to bring it
    const Judgement verdict = judge(look(time_s), place());
    if (verdict.action == Action::hold || verdict.action == Action::let_go) {
        hand_back(
            verdict.action,
            fmt::format("{}, {}", limpet::to_string(verdict.cause), limpet::to_string(place())),
            time_s);
        return;
    }
    obstacle_ = verdict.action == Action::finish ? std::string(limpet::to_string(verdict.cause))
                                                 : std::string();
    const PerchingTask task{.perch = true,
                            .take_off = takes_off_ && verdict.action == Action::carry_on};
    EventList events;
    update(setup_.guidance, task, memory_, inputs_.readings, believe(time_s), time_s, events);
    for (std::size_t k = 0; k < events.count; ++k) {
        report(events.events[k]);
    }
    setpoint_ = memory_.setpoint;
    (void)watch_arming(arming_, setpoint_.armed, inputs_.autopilot.value.armed,
                       setup_.limits.arming_s, time_s);
    if (memory_.ending) {
        come_to_end(time_s);
    }
}

/// At rest it goes on resting; in the air it stays where it is.
void PerchingSession::come_to_end(double time_s) {
    const Ending ending = *memory_.ending;
    const bool rests = rest_on(memory_, time_s);
    if (!rests || !outcome_) {
        outcome_ = ending.outcome;
        reason_ = std::string(ending.reason);
    }
    if (rests) {
        takes_off_ = false;
    } else if (!setpoint_.armed || !estimate_fresh(time_s)) {
        hand_back(setpoint_.armed ? Action::hold : Action::let_go, reason_, time_s);
    } else {
        phase_ = SessionPhase::ready;
        phase_s_ = time_s;
        setpoint_.pump_on = setpoint_.valve_open = false;
    }
}

void PerchingSession::hand_back(Action action, std::string reason, double time_s) {
    const Place from = phase_ == SessionPhase::flying ? place_of(memory_) : Place::in_air;
    const bool on_wall = from == Place::at_rest || from == Place::on_cup || from == Place::pressed;
    if (action == Action::hold || !on_wall) {
        setpoint_.pump_on = setpoint_.valve_open = false;
    }
    if (phase_ == SessionPhase::flying) {
        events_.push_back(
            make_event(time_s, "node", EventName::aborted, limpet::to_string(action)));
    }
    phase_ = SessionPhase::handed_back;
    phase_s_ = time_s;
    asked_ = engaged_ = false;
    arming_ = {};
    left_by_ = action;
    reason_ = std::move(reason);
    obstacle_ = "control was handed back: ask for perch again";
}

/// A mission at rest ends again and again: that it cannot take off is said once.
void PerchingSession::report(const Event& event) {
    const bool rests = place_of(memory_) == Place::at_rest;
    if (!(outcome_ && rests && event.name == EventName::aborted)) {
        events_.push_back(event);
    }
}

// --- what is asked of the autopilot -------------------------------------------------------------

std::string_view PerchingSession::wanted_mode() const {
    const bool offboard = inputs_.autopilot.value.offboard;
    switch (phase_) {
        case SessionPhase::waiting: return "";
        case SessionPhase::ready:
            return asked_ && setup_.asks_for_mode && !offboard ? "OFFBOARD" : "";
        case SessionPhase::flying: return "";
        case SessionPhase::handed_back:
            return left_by_ == Action::hold && offboard ? "AUTO.LOITER" : "";
    }
    throw InternalError("phase out of range");
}

std::optional<bool> PerchingSession::wanted_armed() const {
    // One that is not heard may be that of a simulation that has just begun anew.
    const bool heard = inputs_.autopilot.fresh(last_s_, setup_.limits.silence_limit_s);
    if (phase_ != SessionPhase::flying || !heard ||
        setpoint_.armed == inputs_.autopilot.value.armed) {
        return std::nullopt;
    }
    return setpoint_.armed;
}

}  // namespace limpet::ros
