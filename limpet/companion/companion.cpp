// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/companion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/mavlink/mission_report.hpp"
#include "limpet/mavlink/translate.hpp"

// The loop, a line a station, in the order in which data flows; tick() is the picture:
//
//   wires -> readings, estimate -> session (watchdog, guidance) -> autopilot's wire
//     └----> poses to the autopilot                   └----------> mechanism's wire

namespace limpet::companion {
namespace {

constexpr double kRounding_s = 1e-6;

mavlink::OffboardOptions options_of(const CompanionConfig& config) {
    return {.target_system = static_cast<std::uint8_t>(config.system),
            .set_point_rate_Hz = config.limits.guidance_rate_Hz,
            .estimate_limit_s = config.limits.estimate_limit_s,
            .silence_limit_s = config.limits.silence_limit_s,
            .asks_for_mode = config.asks_for_mode,
            .hears_texts = config.hears_texts,
            .sets_origin = config.sets_origin,
            .expected = config.expected};
}

/// Dry, the vehicle is carried: an autopilot that obeys stands in for the real one.
SessionSetup setup_of(const CompanionConfig& config, bool dry_run) {
    return {.task = config.task,
            .guidance = config.guidance,
            .limits = config.limits,
            .rises = config.asks_for_mode && !dry_run,
            .has_mechanism = config.task.perch && !dry_run};
}

}  // namespace

std::string lateness_text(const Lateness& lateness) {
    return fmt::format(
        "late by {:.2f} ms (median), {:.2f} ms (99 %), {:.2f} ms (99.9 %), {:.1f} ms (worst)",
        1e3 * lateness.quantile_s(0.5), 1e3 * lateness.quantile_s(0.99),
        1e3 * lateness.quantile_s(0.999), 1e3 * lateness.largest_s());
}

std::string RefusalWatch::reasons(const mavlink::Refusals& refusals, double time_s,
                                  double limit_s) {
    if (refusals.total() != total_) {
        total_ = refusals.total();
        grew_s_ = time_s;
    }
    return time_s - grew_s_ > limit_s ? "" : reasons_of(refusals);
}

Companion::Companion(const CompanionConfig& config, Wires& wires, record::Recorder* recorder,
                     bool dry_run, CompanionWatch watch)
    : config_(config),
      wires_(wires),
      recorder_(recorder),
      dry_run_(dry_run),
      watch_(std::move(watch)),
      offboard_(options_of(config)),
      inputs_(config),
      pose_watch_(config.limits.pose_watch),
      dry_(watch_),
      session_(
          setup_of(config, dry_run),
          {.on_event = [this](const Event& event) { report(event); }, .on_line = watch_.on_line}) {
    result_.events.reserve(256);
}

/// A disk or a memory that is full must not end a flight: what has been written stays, the rest is
/// not.
template <class Write>
void Companion::write(double time_s, const Write& writes) {
    if (recorder_ == nullptr) {
        return;
    }
    try {
        writes(*recorder_);
    } catch (const InputError& error) {
        recorder_ = nullptr;
        watch_.line(time_s, fmt::format("nothing is recorded any more: {}", error.what()));
    } catch (const std::bad_alloc&) {
        recorder_ = nullptr;
        watch_.line(time_s, "nothing is recorded any more: not enough memory");
    }
}

void Companion::tick(double time_s, double late_s, bool interrupted) {
    ++result_.ticks;
    result_.last_s = time_s;
    result_.late_ticks += late_s > 1.0 / config_.limits.guidance_rate_Hz ? 1 : 0;
    result_.lateness.add(late_s);
    if (over_) {
        return;
    }
    if (interrupted) {
        session_.interrupt();
    }
    poll(time_s);
    feed(time_s);
    const bool was_leaving = phase() == SessionPhase::handed_back;
    const bool was_flying = phase() == SessionPhase::flying;
    session_.tick(time_s);
    if (phase() == SessionPhase::handed_back) {
        conclude(was_leaving, time_s);
    }
    if (!dry_run_) {
        steer(time_s);
    } else if (was_flying || phase() == SessionPhase::flying) {
        dry_.tell(time_s, memory());
    }
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
    watch_pose(time_s);
    carried_.update(pose_);
    forward_pose(time_s);
}

void Companion::watch_pose(double time_s) {
    const Sample<PoseReading>& news = inputs_.readings().motion_capture;
    pose_ = pose_watch_.trusted(news, offboard_.estimate(time_s), mover());
    if (news.newer_than(watched_s_)) {
        watched_s_ = news.time_s;
        ++withheld_.at(static_cast<std::size_t>(pose_watch_.doubt()));
    }
}

/// Of the wire, and of the watch behind it.
PoseReport Companion::pose_report() const {
    PoseReport report = inputs_.pose_report(wires_);
    for (std::size_t i = 1; i < withheld_.size(); ++i) {
        if (withheld_[i] > 0) {
            report.taken -= std::min(report.taken, withheld_[i]);
            report.refused.emplace_back(name_of(static_cast<PoseDoubt>(i)), withheld_[i]);
        }
    }
    if (report.latest.empty() && pose_watch_.doubt() != PoseDoubt::none) {
        report.latest = doubt_text(pose_watch_.doubt(), pose_watch_.away_m());
    }
    return report;
}

Mover Companion::mover() const {
    return offboard_.report().armed          ? Mover::rotors
           : phase() == SessionPhase::flying ? Mover::nothing
                                             : Mover::hand;
}

void Companion::forward_pose(double time_s) {
    const double period_s = 1.0 / config_.limits.pose_rate_Hz;
    if (dry_run_ || offboard_.awaits_origin(time_s) || pose_.time_s <= forwarded_pose_s_ ||
        time_s < forwarded_s_ + period_s - kRounding_s) {
        return;
    }
    // On the grid of the rate while poses keep up with it, so that 120 Hz in give 50 Hz out.
    forwarded_s_ = std::max(forwarded_s_ + period_s, time_s - period_s);
    forwarded_pose_s_ = pose_.time_s;
    const auto time_us =
        static_cast<std::uint64_t>(std::llround(std::max(pose_.time_s, 0.0) * 1e6));
    (void)wires_.autopilot->send(
        mavlink::odometry(pose_.value, std::max<std::uint64_t>(time_us, 1)),
        std::chrono::milliseconds(5));
}

std::string Companion::mechanism_obstacle(double time_s) const {
    constexpr double kAnswer_s = 1.0;
    if (inputs_.mechanism_s() < 0.0 || time_s - inputs_.mechanism_s() > kAnswer_s) {
        return "no answer of pump and valve";
    }
    return inputs_.mechanism_refuses() ? "pump and valve refuse" : "";
}

void Companion::feed(double time_s) {
    const bool flies = phase() == SessionPhase::flying;
    SessionInputs& in = session_.inputs();
    in.readings = inputs_.readings();
    in.readings.motion_capture = pose_;
    in.pose_doubt = pose_watch_.doubt();
    in.pose_away_m = pose_watch_.away_m();
    const Estimate estimate = dry_run_ ? carried_.estimate() : offboard_.estimate(time_s);
    if (estimate.valid) {
        in.pose = {estimate.time_s, {.p_WB_m = estimate.p_WB_m, .q_WB = estimate.q_WB}};
        in.velocity_W_m_s = {estimate.time_s, estimate.v_WB_m_s};
        in.rate_B_rad_s = {estimate.time_s, estimate.w_WB_B_rad_s};
    }
    if (pose_.fresh(time_s, config_.limits.pose_limit_s)) {
        in.pose_refused.clear();
    } else {  // costs memory, where the flight is over anyway
        in.pose_refused = inputs_.pose_report(wires_).latest;
    }
    if (!flies && wires_.sensors) {
        in.sensors_refused = sensors_refusals_.reasons(wires_.sensors->count().refusals, time_s,
                                                       config_.limits.silence_limit_s);
    }
    if (dry_run_) {
        const bool armed = !flies || session_.setpoint().armed;
        in.autopilot = {time_s, {.connected = true, .armed = armed, .offboard = true}};
        return;
    }
    const mavlink::AutopilotReport& report = offboard_.report();
    in.autopilot = {time_s,
                    {.connected = offboard_.state(time_s) != mavlink::OffboardState::silent,
                     .armed = report.armed,
                     .offboard = report.offboard,
                     .in_air = report.landed_state == mavlink::MavLandedState::in_air}};
    if (!flies) {  // for people: costs memory
        in.mechanism = mechanism_obstacle(time_s);
        in.waits_for = offboard_.obstacle(time_s);
        in.autopilot_refused = autopilot_refusals_.reasons(wires_.autopilot->count().refusals,
                                                           time_s, config_.limits.silence_limit_s);
    }
}

/// Until all who must know have received it.
void Companion::conclude(bool was_leaving, double time_s) {
    const bool reports = !dry_run_ && (session_.flew() || session_.left_by() == Action::hold);
    over_ = !reports || (was_leaving && time_s - session_.since_s() >= config_.limits.hand_back_s);
    result_.end = session_.end();
    result_.outcome = session_.outcome();
    result_.reason = session_.reason();
    result_.attempts = session_.flew() ? memory().attempt : 0;
    result_.motion_capture = pose_report();
}

// --- to the wires -----------------------------------------------------------------------------

void Companion::steer(double time_s) {
    if (session_.streams()) {
        offboard_.update(*wires_.autopilot, session_.setpoint(), time_s);
    } else if (!over_) {
        if (phase() == SessionPhase::handed_back && session_.left_by() == Action::hold) {
            offboard_.hand_back(*wires_.autopilot, time_s);
        }
        offboard_.attend(*wires_.autopilot, time_s);
    }
}

void Companion::actuate(double time_s) {
    const mavlink::MechanismCommand wanted{.pump_on = session_.setpoint().pump_on,
                                           .valve_open = session_.setpoint().valve_open};
    if (session_.drives_mechanism() && !over_ &&
        mechanism_.due(wanted, config_.limits.mechanism_rate_Hz, time_s)) {
        tell_mechanism(config_, wires_, wanted, mechanism_.repeats());
    }
}

/// To the sensors' wire: the state of guidance, and at last that the mission is over.
void Companion::tell(double time_s) {
    constexpr double kEvery_s = 0.1;
    if (dry_run_ || !wires_.sensors || time_s - reported_s_ < kEvery_s - kRounding_s) {
        return;
    }
    reported_s_ = time_s;
    if (phase() == SessionPhase::flying) {
        const auto boot_ms = static_cast<std::uint32_t>(std::llround(time_s * 1e3));
        send_sensors(mavlink::guidance_state(static_cast<int>(memory().state), boot_ms));
    } else if (phase() == SessionPhase::handed_back && !over_) {
        send_last_word();
        send_sensors(mavlink::Heartbeat{.type = mavlink::MavType::onboard_controller,
                                        .autopilot = mavlink::MavAutopilot::invalid,
                                        .system_status = mavlink::MavState::poweroff,
                                        .mavlink_version = mavlink::kMavlinkVersion});
    }
}

void Companion::send_text(mavlink::MavSeverity::Value severity, std::string_view text) {
    splitter_.split(severity, text,
                    [this](const mavlink::StatusText& piece) { send_sensors(piece); });
}

void Companion::send_last_word() {
    if (result_.outcome) {
        send_text(mavlink::MavSeverity::info,
                  mavlink::outcome_text(*result_.outcome, result_.reason).view());
    } else {
        send_text(mavlink::MavSeverity::warning, "handed back: " + result_.reason);
    }
}

void Companion::record(double time_s) {
    write(time_s, [&](record::Recorder& to) {
        to.new_readings(inputs_.readings(), recorded_);
        const Estimate estimate = dry_run_ ? carried_.estimate() : offboard_.estimate(time_s);
        if (estimate.time_s > recorded_estimate_s_) {
            to.estimate(estimate);
            recorded_estimate_s_ = estimate.time_s;
        }
        if (!over_ && (phase() == SessionPhase::flying || phase() == SessionPhase::handed_back)) {
            to.setpoint(time_s, session_.setpoint());
            to.guidance(time_s, to_string(memory().state), memory().attempt);
        }
    });
}

void Companion::report(const Event& event) {
    result_.events.push_back(event);
    write(event.time_s, [&](record::Recorder& to) { to.event(event); });
    if (wires_.sensors && !dry_run_) {
        send_text(mavlink::MavSeverity::info, mavlink::event_text(event).view());
    }
    watch_.event(event);
}

void Companion::say_changes(double time_s) {
    constexpr double kAnswer_s = 0.5;
    if (offboard_.report().texts != shown_texts_) {
        shown_texts_ = offboard_.report().texts;
        watch_.line(time_s, fmt::format("the autopilot says: {}", offboard_.report().text));
    }
    if (!dry_run_ && !compared_ && offboard_.compared(time_s)) {
        compared_ = true;
        for (const mavlink::ParameterDifference& difference : offboard_.differences(time_s)) {
            if (difference.value) {  // one that it does not have is another version's
                watch_.line(time_s, fmt::format("the autopilot has {}", text_of(difference)));
            }
        }
    }
    if (pose_watch_.doubt() != shown_doubt_) {
        shown_doubt_ = pose_watch_.doubt();
        watch_.line(time_s, fmt::format("motion capture: {}",
                                        doubt_text(shown_doubt_, pose_watch_.away_m())));
    }
    const bool deaf = session_.drives_mechanism() && phase() == SessionPhase::flying &&
                      time_s - mechanism_.asked_s() > kAnswer_s &&
                      inputs_.mechanism_s() < mechanism_.asked_s();
    if (deaf && !shown_deaf_) {
        watch_.line(time_s, "pump and valve do not answer");
    }
    shown_deaf_ = deaf;
}

}  // namespace limpet::companion
