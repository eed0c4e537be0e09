// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "limpet/companion/session.hpp"

// What comes before the flight: waiting for the inputs, then for the autopilot.

namespace limpet::companion {
namespace {

constexpr double kObstacleEvery_s = 5.0;  ///< how often what is waited for is repeated

}  // namespace

// --- inputs -------------------------------------------------------------------------------------

bool PerchingSession::autopilot_alive(double time_s) const {
    return inputs_.autopilot.fresh(time_s, setup_.limits.silence_limit_s) &&
           inputs_.autopilot.value.connected;
}

bool PerchingSession::pose_fresh(double time_s) const {
    return !setup_.watches_motion_capture ||
           inputs_.readings.motion_capture.fresh(time_s, setup_.limits.pose_limit_s);
}

/// @return which part of the autopilot's estimate; empty: none
std::string_view PerchingSession::stale_estimate(double time_s) const {
    const double limit_s = setup_.limits.estimate_limit_s;
    return !inputs_.pose.fresh(time_s, limit_s)             ? "pose"
           : !inputs_.velocity_W_m_s.fresh(time_s, limit_s) ? "velocity"
           : !inputs_.rate_B_rad_s.fresh(time_s, limit_s)   ? "angular velocity"
                                                            : "";
}

/// Position counts as lost when motion capture is: an estimator that goes on without it must not
/// take off.
Estimate PerchingSession::believe(double time_s) const {
    Estimate estimate;
    estimate.time_s = inputs_.pose.time_s;
    estimate.p_WB_m = inputs_.pose.value.p_WB_m;
    estimate.q_WB = inputs_.pose.value.q_WB;
    estimate.v_WB_m_s = inputs_.velocity_W_m_s.value;
    estimate.w_WB_B_rad_s = inputs_.rate_B_rad_s.value;
    estimate.valid = stale_estimate(time_s).empty() && pose_fresh(time_s);
    return estimate;
}

/// In OFFBOARD and armed, by its last word: one that falls silent has had no other command.
bool PerchingSession::steers() const {
    return inputs_.autopilot.value.offboard && inputs_.autopilot.value.armed;
}

std::string PerchingSession::disagreement() const {
    const double most_m_s = setup_.limits.stand_speed_m_s;
    if (!inputs_.autopilot.value.armed && inputs_.velocity_W_m_s.value.norm() > most_m_s) {
        return fmt::format("the autopilot's pose moves with motors off (faster than {:g} m/s)",
                           most_m_s);
    }
    const PoseReading& pose = inputs_.readings.motion_capture.value;
    const double apart_m = (pose.p_WB_m - inputs_.pose.value.p_WB_m).norm();
    const double apart_deg = degrees(pose.q_WB.angularDistance(inputs_.pose.value.q_WB));
    if (apart_m <= setup_.limits.agreement_m && apart_deg <= setup_.limits.agreement_deg) {
        return "";
    }
    return fmt::format("motion capture and the autopilot's pose differ by {:.2f} m and {:.0f} deg",
                       apart_m, apart_deg);
}

/// Why there is no pose, as far as that is known.
std::string PerchingSession::pose_obstacle() const {
    const std::string why = inputs_.pose_doubt != PoseDoubt::none
                                ? std::string(to_string(inputs_.pose_doubt))
                                : inputs_.pose_refused;
    return why.empty() ? "no motion-capture pose" : fmt::format("no motion-capture pose ({})", why);
}

/// All that keeps it from flying; empty: nothing. A hover needs no wall.
std::string PerchingSession::missing(double time_s) const {
    const Readings& readings = inputs_.readings;
    std::string list;
    const auto add = [&list](std::string_view what) {
        list += what.empty() || list.empty() ? "" : ", ";
        list += what;
    };
    if (!pose_fresh(time_s)) {
        add(pose_obstacle());
    }
    const auto want = [&](const auto& sample, std::string_view what) {
        if (setup_.task.perch && !sample.fresh(time_s, setup_.guidance.sensor_limit_s)) {
            add(what);
        }
    };
    want(readings.lidar_left, "no left LiDAR");
    want(readings.lidar_right, "no right LiDAR");
    want(readings.force, "no force");
    want(readings.cup_pressure, "no cup pressure");
    const bool pressure = readings.cup_pressure.fresh(time_s, setup_.guidance.sensor_limit_s);
    if (drives_mechanism_) {
        add(inputs_.mechanism);
    } else if (setup_.has_mechanism && pressure) {
        add(fmt::format(
            "the cup is not free (it holds {:.0f} hPa: on a wall? the pump is left as it is)",
            readings.cup_pressure.value.pressure_Pa / 100.0));
    }
    if (!list.empty() && !inputs_.sensors_refused.empty()) {
        add(fmt::format("the sensors' wire brings what is refused ({})", inputs_.sensors_refused));
    }
    if (!autopilot_alive(time_s) && !inputs_.autopilot_refused.empty()) {
        add(fmt::format("no heartbeat of the autopilot that is taken (refused: {})",
                        inputs_.autopilot_refused));
    } else if (!autopilot_alive(time_s)) {
        add("no heartbeat of the autopilot");
    } else if (const std::string_view part = stale_estimate(time_s); !part.empty()) {
        add(fmt::format("the autopilot sends no fresh {}", part));
    } else if (setup_.watches_motion_capture && pose_fresh(time_s)) {
        add(disagreement());
    }
    return list;
}

// --- before a flight ----------------------------------------------------------------------------

/// The pump may hold a vehicle that hangs there since the last time: it is commanded to rest only
/// once the cup is known to be free.
void PerchingSession::wait(double time_s) {
    const Sample<PressureReading>& pressure = inputs_.readings.cup_pressure;
    drives_mechanism_ =
        drives_mechanism_ ||
        (setup_.has_mechanism && pressure.fresh(time_s, setup_.guidance.sensor_limit_s) &&
         pressure.value.pressure_Pa > setup_.guidance.detach_pressure_Pa);
    obstacle_ = missing(time_s);
    if (interrupted_) {
        hand_back(Action::let_go, CompanionEnd::interrupted, "interrupted before the flight",
                  time_s);
    } else if (obstacle_.empty()) {
        go(SessionPhase::ready, time_s);
        setpoint_ = {};
        stay(time_s);
        watch_.line(time_s, "ready: all inputs are here");
    } else if (!setup_.by_request && time_s - phase_s_ > setup_.limits.wait_limit_s) {
        hand_back(Action::let_go, CompanionEnd::absent,
                  fmt::format("waited {:g} s: {}", setup_.limits.wait_limit_s, obstacle_), time_s);
    } else if (obstacle_ != shown_obstacle_ || time_s - shown_obstacle_s_ >= kObstacleEvery_s) {
        watch_.line(time_s, fmt::format("waits: {}", obstacle_));
        shown_obstacle_ = obstacle_;
        shown_obstacle_s_ = time_s;
    }
}

/// Set-points follow the vehicle until it flies them. Motors are armed only by who rises; else they
/// stay as the operator has them: to request less would stop them in the air.
void PerchingSession::stay(double time_s) {
    if (!steers() || !std::holds_alternative<PositionSetpoint>(setpoint_.motion)) {
        const Estimate estimate = believe(time_s);
        const double rise_m = setup_.rises ? setup_.limits.rise_m : 0.0;
        setpoint_.motion =
            PositionSetpoint{.p_W_m = estimate.p_WB_m - Vector3(0.0, 0.0, rise_m),
                             .yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad};
    }
    setpoint_.armed = setup_.rises || inputs_.autopilot.value.armed;
}

/// In OFFBOARD, armed, and where guidance may begin.
bool PerchingSession::at_start(double time_s) {
    if (!setup_.rises || !steers()) {
        steady_since_s_ = -1.0;
        return steers() && inputs_.autopilot.value.in_air;
    }
    const CompanionLimits& limits = setup_.limits;
    const Estimate estimate = believe(time_s);
    const Vector3& target_W_m = std::get<PositionSetpoint>(setpoint_.motion).p_W_m;
    const bool still = (estimate.p_WB_m - target_W_m).norm() < limits.begin_tolerance_m &&
                       estimate.v_WB_m_s.norm() < limits.begin_speed_m_s;
    steady_since_s_ = !still ? -1.0 : steady_since_s_ < 0.0 ? time_s : steady_since_s_;
    return still && time_s - steady_since_s_ >= limits.begin_steady_s;
}

void PerchingSession::stand_ready(double time_s) {
    stay(time_s);
    obstacle_ = missing(time_s);
    const bool there = at_start(time_s);
    const Judgement verdict = judge(look(time_s), Place::in_air);
    const bool wrong = verdict.action != Action::carry_on;
    if (wrong && (steers() || verdict.cause == Cause::mode_taken)) {
        hand_back(verdict.action, ended_by(verdict.cause), cause_text(verdict.cause), time_s);
    } else if (interrupted_) {
        hand_back(Action::let_go, CompanionEnd::interrupted, "interrupted before the flight",
                  time_s);
    } else if (!steers() && !obstacle_.empty()) {
        go(SessionPhase::waiting, time_s);
        wanted_ = !setup_.by_request;
        setpoint_ = {};
    } else if (wanted_ && there && obstacle_.empty()) {
        begin(time_s);
    } else {
        be_patient(time_s);
    }
}

void PerchingSession::be_patient(double time_s) {
    const std::string& waits_for = obstacle_.empty() ? inputs_.waits_for : obstacle_;
    if (!setup_.by_request && time_s - phase_s_ > setup_.limits.operator_limit_s) {
        hand_back(steers() ? Action::hold : Action::let_go,
                  steers() ? CompanionEnd::handed_back : CompanionEnd::absent,
                  fmt::format("waited {:g} s to be flown: {}", setup_.limits.operator_limit_s,
                              waits_for.empty() ? "it does not stand at its start" : waits_for),
                  time_s);
    } else if (waits_for != shown_obstacle_) {
        shown_obstacle_ = waits_for;
        if (!waits_for.empty()) {
            watch_.line(time_s, waits_for);
        }
    }
}

}  // namespace limpet::companion
