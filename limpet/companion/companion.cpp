// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/companion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/mavlink/mission_report.hpp"
#include "limpet/mavlink/translate.hpp"

// The loop, a line a station, in the order in which data flows; tick() is the picture:
//
//   wires -> readings -> estimate -> watchdog -> guidance -> autopilot's wire
//     └----> poses to the autopilot                └-------> mechanism's wire

namespace limpet {
namespace {

constexpr double kRounding_s = 1e-6;

mavlink::OffboardOptions options_of(const CompanionConfig& config) {
    const CompanionLimits& limits = config.limits;
    return {.target_system = static_cast<std::uint8_t>(config.system),
            .set_point_rate_Hz = limits.guidance_rate_Hz,
            .estimate_limit_s = limits.estimate_limit_s,
            .silence_limit_s = limits.silence_limit_s,
            .asks_for_mode = config.asks_for_mode,
            .hears_texts = config.hears_texts,
            .sets_origin = config.sets_origin};
}

}  // namespace

std::string_view to_string(CompanionPhase phase) {
    switch (phase) {
        case CompanionPhase::waiting: return "waiting";
        case CompanionPhase::ready: return "ready";
        case CompanionPhase::flying: return "flying";
        case CompanionPhase::leaving: return "leaving";
        case CompanionPhase::over: return "over";
    }
    throw InternalError("phase out of range");
}

Companion::Companion(const CompanionConfig& config, Wires& wires, CompanionLog* log, bool dry_run,
                     CompanionWatch watch)
    : config_(config),
      wires_(wires),
      log_(log),
      dry_run_(dry_run),
      watch_(std::move(watch)),
      offboard_(options_of(config)),
      inputs_(config),
      mechanism_(config),
      dry_([this](double time_s, const std::string& text) { say(time_s, text); }) {
    result_.events.reserve(256);
}

/// A disk that is full must not end a flight: what has been written stays, the rest is not.
template <class Write>
void Companion::log(double time_s, Write&& write) {
    if (log_ == nullptr) {
        return;
    }
    try {
        write(*log_);
    } catch (const InputError& error) {
        log_ = nullptr;
        say(time_s, fmt::format("nothing is recorded any more: {}", error.what()));
    }
}

void Companion::tick(double time_s, double late_s, bool interrupted) {
    ++result_.ticks;
    result_.last_s = time_s;
    result_.late_ticks += late_s > 1.0 / config_.limits.guidance_rate_Hz ? 1 : 0;
    result_.latest_s = std::max(result_.latest_s, late_s);
    const bool flies_us =
        phase_ == CompanionPhase::flying || (phase_ == CompanionPhase::ready && steers());
    late_ = late_ || (late_s > config_.limits.late_limit_s && flies_us);
    interrupted_ = interrupted_ || interrupted;

    poll(time_s);
    switch (phase_) {
        case CompanionPhase::waiting: wait(time_s); break;
        case CompanionPhase::ready: stand_ready(time_s); break;
        case CompanionPhase::flying:
            obey(judge(look(time_s), place()), time_s);
            guide(time_s);
            break;
        case CompanionPhase::leaving: take_leave(time_s); break;
        case CompanionPhase::over: return;
    }
    steer(time_s);
    actuate(time_s);
    tell(time_s);
    record(time_s);
    say_changes(time_s);
}

void Companion::poll(double time_s) {
    if (wires_.motion_capture) {
        wires_.motion_capture->update(time_s);
    }
    inputs_.poll(wires_, offboard_, time_s);
    carried_.update(inputs_.readings().motion_capture);
    forward_pose(time_s);
}

void Companion::forward_pose(double time_s) {
    const Sample<PoseReading>& pose = inputs_.readings().motion_capture;
    const double period_s = 1.0 / config_.limits.pose_rate_Hz;
    if (dry_run_ || pose.time_s <= forwarded_pose_s_ ||
        time_s < forwarded_s_ + period_s - kRounding_s) {
        return;
    }
    // On the grid of the rate while poses keep up with it, so that 120 Hz in give 50 Hz out.
    forwarded_s_ = std::max(forwarded_s_ + period_s, time_s - period_s);
    forwarded_pose_s_ = pose.time_s;
    const auto time_us = static_cast<std::uint64_t>(std::llround(std::max(pose.time_s, 0.0) * 1e6));
    (void)wires_.autopilot->send(mavlink::odometry(pose.value, std::max<std::uint64_t>(time_us, 1)),
                                 std::chrono::milliseconds(5));
}

/// Position counts as lost when motion capture is: an estimator that goes on without it must not
/// take off.
Estimate Companion::believe(double time_s) const {
    const bool pose_fresh = inputs_.pose_fresh(time_s);
    if (dry_run_) {
        return carried_.estimate(pose_fresh);
    }
    Estimate estimate = offboard_.estimate(time_s);
    estimate.valid = estimate.valid && pose_fresh;
    return estimate;
}

/// By its last heartbeat.
bool Companion::steers() const {
    return offboard_.report().offboard && offboard_.report().armed;
}

bool Companion::engaged(double time_s) const {
    return offboard_.state(time_s) == mavlink::OffboardState::engaged;
}

/// It rests once its motors are known to be off: until then set-points must not stop.
Place Companion::place() const {
    const Place place = place_of(memory_);
    const bool turning = !dry_run_ && offboard_.report().armed;
    return place == Place::at_rest && turning ? Place::on_cup : place;
}

Signs Companion::look(double time_s) const {
    Signs signs{
        .interrupted = interrupted_, .late = late_, .pose_fresh = inputs_.pose_fresh(time_s)};
    if (!dry_run_) {
        signs.autopilot = offboard_.state(time_s);
        signs.estimate_fresh = offboard_.estimate(time_s).valid;
        signs.disarmed = arming_.seen && setpoint_.armed && !offboard_.report().armed;
    }
    return signs;
}

// --- the flight -------------------------------------------------------------------------------

void Companion::obey(const Judgement& verdict, double time_s) {
    const bool news = verdict.action != pending_.action || verdict.cause != pending_.cause;
    pending_ = verdict;
    switch (verdict.action) {
        case Action::carry_on:
            if (news) {
                say(time_s, "all is well again");
            }
            return;
        case Action::finish:
            if (news) {
                say(time_s, fmt::format("{}, {}: {}", to_string(verdict.cause), to_string(place()),
                                        to_string(verdict.action)));
            }
            return;
        case Action::hold:
        case Action::let_go:
            report(make_event(time_s, "companion", EventName::aborted, to_string(verdict.cause)));
            leave(verdict.action,
                  verdict.cause == Cause::interrupted ? CompanionEnd::interrupted
                                                      : CompanionEnd::handed_back,
                  fmt::format("{}, {}", to_string(verdict.cause), to_string(place())), time_s);
            return;
    }
}

void Companion::guide(double time_s) {
    if (phase_ != CompanionPhase::flying) {
        return;
    }
    PerchingTask task = config_.task;
    task.take_off = task.take_off && pending_.action == Action::carry_on;
    events_.count = 0;
    update(config_.guidance, task, memory_, inputs_.readings(), believe(time_s), time_s, events_);
    for (std::size_t k = 0; k < events_.count; ++k) {
        report(events_.events[k]);
    }
    setpoint_ = memory_.setpoint;
    if (dry_run_) {
        dry_.tell(time_s, memory_);
    }
    (void)watch_arming(arming_, setpoint_.armed && !dry_run_, offboard_.report().armed,
                       config_.limits.arming_s, time_s);
    if (memory_.ending) {
        const bool alone = pending_.action == Action::carry_on;
        result_.outcome = memory_.ending->outcome;
        leave(setpoint_.armed ? Action::hold : Action::let_go,
              alone ? CompanionEnd::mission_over
                    : (pending_.cause == Cause::interrupted ? CompanionEnd::interrupted
                                                            : CompanionEnd::handed_back),
              alone
                  ? std::string(memory_.ending->reason)
                  : fmt::format("{}; {}", memory_.ending->reason.view(), to_string(pending_.cause)),
              time_s);
    }
}

// --- after it ---------------------------------------------------------------------------------

void Companion::leave(Action action, CompanionEnd end, std::string reason, double time_s) {
    const bool flew = phase_ == CompanionPhase::flying;
    const Place place = flew ? place_of(memory_) : Place::in_air;
    const bool on_wall =
        place == Place::at_rest || place == Place::on_cup || place == Place::pressed;
    if (action == Action::hold || !on_wall) {
        setpoint_.pump_on = false;
        setpoint_.valve_open = false;
    }
    result_.end = end;
    result_.reason = std::move(reason);
    result_.attempts = flew ? memory_.attempt : 0;
    leaving_by_ = action;
    const bool flies = !dry_run_ && (flew || action == Action::hold);
    phase_ = flies ? CompanionPhase::leaving : CompanionPhase::over;
    phase_s_ = time_s;
    if (flies) {
        say(time_s,
            fmt::format("{}{}", to_string(action), setpoint_.pump_on ? "; the pump stays on" : ""));
    }
}

/// Until all who must have heard it have.
void Companion::take_leave(double time_s) {
    if (time_s - phase_s_ >= config_.limits.hand_back_s) {
        phase_ = CompanionPhase::over;
    }
}

// --- to the wires -----------------------------------------------------------------------------

void Companion::steer(double time_s) {
    if (dry_run_) {
        return;
    }
    switch (phase_) {
        case CompanionPhase::ready:
        case CompanionPhase::flying: offboard_.update(*wires_.autopilot, setpoint_, time_s); return;
        case CompanionPhase::leaving:
            if (leaving_by_ == Action::hold) {
                offboard_.hand_back(*wires_.autopilot, time_s);
            }
            offboard_.attend(*wires_.autopilot, time_s);
            return;
        case CompanionPhase::waiting: offboard_.attend(*wires_.autopilot, time_s); return;
        case CompanionPhase::over: return;
    }
}

void Companion::actuate(double time_s) {
    if (dry_run_ || !drives_mechanism_ || phase_ == CompanionPhase::over) {
        return;
    }
    mechanism_.update(wires_, {.pump_on = setpoint_.pump_on, .valve_open = setpoint_.valve_open},
                      time_s);
}

/// To the sensors' wire: the state of guidance, and at last that the mission is over.
void Companion::tell(double time_s) {
    constexpr double kEvery_s = 0.1;
    if (dry_run_ || !wires_.sensors || time_s - told_s_ < kEvery_s - kRounding_s) {
        return;
    }
    told_s_ = time_s;
    if (phase_ == CompanionPhase::flying) {
        const auto boot_ms = static_cast<std::uint32_t>(std::llround(time_s * 1e3));
        send_sensors(mavlink::guidance_state(static_cast<int>(memory_.state), boot_ms));
    } else if (phase_ == CompanionPhase::leaving) {
        constexpr std::uint8_t kOnboardController = 18;
        constexpr std::uint8_t kNoAutopilot = 8;
        send_sensors(last_word());
        mavlink::Heartbeat beat;
        beat.type = kOnboardController;
        beat.autopilot = kNoAutopilot;
        beat.system_status = mavlink::kStatePowerOff;
        beat.mavlink_version = 3;
        send_sensors(beat);
    }
}

mavlink::StatusText Companion::last_word() const {
    if (result_.outcome) {
        return mavlink::outcome_text(*result_.outcome, result_.reason);
    }
    constexpr std::uint8_t kWarning = 4;
    mavlink::StatusText text;
    text.severity = kWarning;
    mavlink::set_text(text.text, "handed back: " + result_.reason);
    return text;
}

void Companion::record(double time_s) {
    log(time_s, [&](CompanionLog& to) {
        to.readings(inputs_.readings());
        to.estimate(dry_run_ ? carried_.estimate(true) : offboard_.estimate(time_s));
        if (phase_ == CompanionPhase::flying || phase_ == CompanionPhase::leaving) {
            to.guidance(time_s, setpoint_, memory_);
        }
    });
}

void Companion::report(const Event& event) {
    result_.events.push_back(event);
    log(event.time_s, [&](CompanionLog& to) { to.event(event); });
    if (wires_.sensors && !dry_run_) {
        send_sensors(mavlink::event_text(event));
    }
    if (watch_.on_event) {
        watch_.on_event(event);
    }
}

void Companion::say(double time_s, const std::string& text) const {
    if (watch_.on_line) {
        watch_.on_line(time_s, text);
    }
}

void Companion::say_changes(double time_s) {
    constexpr double kAnswer_s = 0.5;
    if (offboard_.report().texts != told_texts_) {
        told_texts_ = offboard_.report().texts;
        say(time_s, fmt::format("the autopilot says: {}", offboard_.report().text));
    }
    if (phase_ == CompanionPhase::ready) {
        const std::string waits_for = offboard_.obstacle(time_s);
        if (waits_for != told_obstacle_) {
            told_obstacle_ = waits_for;
            if (!waits_for.empty()) {
                say(time_s, waits_for);
            }
        }
    }
    const bool deaf = !dry_run_ && drives_mechanism_ && phase_ == CompanionPhase::flying &&
                      time_s - mechanism_.asked_s() > kAnswer_s &&
                      inputs_.mechanism_s() < mechanism_.asked_s();
    if (deaf && !told_deaf_) {
        say(time_s, "pump and valve do not answer");
    }
    told_deaf_ = deaf;
}

}  // namespace limpet
