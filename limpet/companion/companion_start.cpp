// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "limpet/companion/companion.hpp"

// What comes before the flight: waiting for the inputs, then for the autopilot.

namespace limpet {
namespace {

constexpr double kObstacleEvery_s = 5.0;  ///< what is waited for is said again so often

}  // namespace

std::string Companion::mechanism_obstacle(double time_s) const {
    constexpr double kAnswer_s = 1.0;
    const Readings& readings = inputs_.readings();
    if (!config_.task.perch || dry_run_ ||
        !readings.cup_pressure.fresh(time_s, config_.guidance.sensor_limit_s)) {
        return "";
    }
    if (!drives_mechanism_) {
        return fmt::format(
            "the cup is not free (it holds {:.0f} hPa: on a wall? the pump is left as "
            "it is)",
            readings.cup_pressure.value.pressure_Pa / 100.0);
    }
    if (inputs_.mechanism_s() < 0.0 || time_s - inputs_.mechanism_s() > kAnswer_s) {
        return "no answer of pump and valve";
    }
    return inputs_.mechanism_refuses() ? "pump and valve refuse" : "";
}

/// All that keeps it from flying; empty: nothing.
std::string Companion::obstacle(double time_s) const {
    std::string list = inputs_.missing(time_s);
    const auto add = [&list](const std::string& what) {
        if (!what.empty()) {
            list += (list.empty() ? "" : ", ") + what;
        }
    };
    add(mechanism_obstacle(time_s));
    if (dry_run_) {
        return list;
    }
    const mavlink::OffboardState state = offboard_.state(time_s);
    if (state == mavlink::OffboardState::silent || state == mavlink::OffboardState::unready) {
        add(offboard_.obstacle(time_s));
    } else if (inputs_.pose_fresh(time_s)) {
        const PoseReading& pose = inputs_.readings().motion_capture.value;
        const Estimate estimate = offboard_.estimate(time_s);
        const double apart_m = (pose.p_WB_m - estimate.p_WB_m).norm();
        const double apart_deg = degrees(pose.q_WB.angularDistance(estimate.q_WB));
        if (apart_m > config_.limits.agreement_m || apart_deg > config_.limits.agreement_deg) {
            add(
                fmt::format("motion capture and the autopilot's pose differ by {:.2f} m and "
                            "{:.0f} deg",
                            apart_m, apart_deg));
        }
    }
    return list;
}

/// The pump may hold a vehicle that hangs there since the last time: it is told to rest only once
/// the cup is known to be free.
void Companion::wait(double time_s) {
    const Readings& readings = inputs_.readings();
    drives_mechanism_ =
        drives_mechanism_ ||
        (config_.task.perch &&
         readings.cup_pressure.fresh(time_s, config_.guidance.sensor_limit_s) &&
         readings.cup_pressure.value.pressure_Pa > config_.guidance.detach_pressure_Pa);
    const std::string missing = obstacle(time_s);
    if (interrupted_) {
        leave(Action::let_go, CompanionEnd::interrupted, "interrupted before the flight", time_s);
    } else if (missing.empty()) {
        phase_ = CompanionPhase::ready;
        phase_s_ = time_s;
        stay(time_s);
        say(time_s,
            dry_run_ ? "ready: all inputs are here" : "ready: inputs and autopilot are here");
    } else if (time_s - phase_s_ > config_.limits.wait_limit_s) {
        leave(Action::let_go, CompanionEnd::absent,
              fmt::format("waited {:g} s: {}", config_.limits.wait_limit_s, missing), time_s);
    } else if (missing != told_obstacle_ || time_s - told_obstacle_s_ >= kObstacleEvery_s) {
        say(time_s, fmt::format("waits: {}", missing));
        told_obstacle_ = missing;
        told_obstacle_s_ = time_s;
    }
}

/// In OFFBOARD, armed, and where guidance may begin.
bool Companion::at_start(double time_s) {
    constexpr std::uint8_t kInAir = 2;
    if (!engaged(time_s) || !offboard_.report().armed) {
        steady_since_s_ = -1.0;
        return false;
    }
    if (!config_.asks_for_mode) {
        return offboard_.report().landed_state == kInAir;
    }
    const Estimate estimate = believe(time_s);
    const Vector3& target_W_m = std::get<PositionSetpoint>(setpoint_.motion).p_W_m;
    const CompanionLimits& limits = config_.limits;
    const bool still = (estimate.p_WB_m - target_W_m).norm() < limits.begin_tolerance_m &&
                       estimate.v_WB_m_s.norm() < limits.begin_speed_m_s;
    steady_since_s_ = !still ? -1.0 : steady_since_s_ < 0.0 ? time_s : steady_since_s_;
    return still && time_s - steady_since_s_ >= limits.begin_steady_s;
}

/// Set-points follow the vehicle until it flies them. Motors are armed only with asks_for_mode;
/// else they stay as the operator has them: to ask for less would stop them in the air.
void Companion::stay(double time_s) {
    const Estimate estimate = believe(time_s);
    const bool flies = engaged(time_s) && offboard_.report().armed;
    if (!flies || !std::holds_alternative<PositionSetpoint>(setpoint_.motion)) {
        const double rise_m = config_.asks_for_mode ? config_.limits.rise_m : 0.0;
        setpoint_.motion =
            PositionSetpoint{.p_W_m = estimate.p_WB_m - Vector3(0.0, 0.0, rise_m),
                             .yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad};
    }
    setpoint_.armed = config_.asks_for_mode || offboard_.report().armed;
}

void Companion::stand_ready(double time_s) {
    if (dry_run_) {
        begin(time_s);
        return;
    }
    stay(time_s);
    const bool flies = engaged(time_s) && offboard_.report().armed;
    const Judgement verdict = judge(look(time_s), Place::in_air);
    const std::string missing = obstacle(time_s);
    const bool taken = verdict.action != Action::carry_on && verdict.cause == Cause::mode_taken;
    if (taken || (flies && verdict.action != Action::carry_on)) {
        leave(verdict.action,
              verdict.cause == Cause::interrupted ? CompanionEnd::interrupted
                                                  : CompanionEnd::handed_back,
              std::string(to_string(verdict.cause)), time_s);
    } else if (interrupted_) {
        leave(Action::let_go, CompanionEnd::interrupted, "interrupted before the flight", time_s);
    } else if (!flies && !missing.empty()) {
        phase_ = CompanionPhase::waiting;
        phase_s_ = time_s;
        setpoint_ = {};
    } else if (at_start(time_s)) {
        begin(time_s);
    } else if (time_s - phase_s_ > config_.limits.operator_limit_s) {
        leave(flies ? Action::hold : Action::let_go,
              flies ? CompanionEnd::handed_back : CompanionEnd::absent,
              fmt::format("waited {:g} s to be flown: {}", config_.limits.operator_limit_s,
                          flies ? "it does not stand at its start" : offboard_.obstacle(time_s)),
              time_s);
    }
}

void Companion::begin(double time_s) {
    phase_ = CompanionPhase::flying;
    phase_s_ = time_s;
    memory_ = start_perching(config_.task, believe(time_s), time_s);
    arming_ = {.asked_s = time_s, .seen = !dry_run_};
    say(time_s, dry_run_ ? "begins, dry: carry the vehicle" : "begins");
    guide(time_s);  // in this tick: a set-point that is none yet would stop the rotors
}

}  // namespace limpet
