// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/dry_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace limpet::companion {
namespace {

constexpr double kFar_m = 0.1;
constexpr double kFast_m_s = 0.1;
constexpr double kTurned_deg = 5.0;
constexpr double kStronger = 0.05;

bool turned(double a_rad, double b_rad) {
    return std::abs(wrap_pi(a_rad - b_rad)) > radians(kTurned_deg);
}

bool differs(const Setpoint& a, const Setpoint& b) {
    if (a.motion.index() != b.motion.index()) {
        return true;
    }
    if (const auto* to = std::get_if<PositionSetpoint>(&a.motion)) {
        const auto& from = std::get<PositionSetpoint>(b.motion);
        return (to->p_W_m - from.p_W_m).norm() > kFar_m || turned(to->yaw_rad, from.yaw_rad);
    }
    if (const auto* to = std::get_if<VelocitySetpoint>(&a.motion)) {
        const auto& from = std::get<VelocitySetpoint>(b.motion);
        return (to->v_W_m_s - from.v_W_m_s).norm() > kFast_m_s || turned(to->yaw_rad, from.yaw_rad);
    }
    if (const auto* to = std::get_if<AttitudeSetpoint>(&a.motion)) {
        const auto& from = std::get<AttitudeSetpoint>(b.motion);
        return degrees(to->q_WB.angularDistance(from.q_WB)) > kTurned_deg ||
               std::abs(to->thrust - from.thrust) > kStronger;
    }
    return false;
}

std::string vector_text(const Vector3& v) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
}

}  // namespace

void PoseEstimate::update(const Sample<PoseReading>& pose) {
    if (!pose.ever() || pose.time_s <= last_s_) {
        return;
    }
    if (last_s_ >= 0.0) {
        const double dt_s = pose.time_s - last_s_;
        const double gain = -std::expm1(-dt_s / kFilter_s);
        const Vector3 v_m_s = (pose.value.p_WB_m - estimate_.p_WB_m) / dt_s;
        const Eigen::AngleAxisd turn(estimate_.q_WB.conjugate() * pose.value.q_WB);
        const Vector3 w_rad_s = turn.axis() * (wrap_pi(turn.angle()) / dt_s);
        estimate_.v_WB_m_s += gain * (v_m_s - estimate_.v_WB_m_s);
        estimate_.w_WB_B_rad_s += gain * (w_rad_s - estimate_.w_WB_B_rad_s);
    }
    last_s_ = pose.time_s;
    estimate_.time_s = pose.time_s;
    estimate_.p_WB_m = pose.value.p_WB_m;
    estimate_.q_WB = pose.value.q_WB;
}

Estimate PoseEstimate::estimate(bool fresh) const {
    Estimate estimate = estimate_;
    estimate.valid = fresh && last_s_ >= 0.0;
    return estimate;
}

std::string motion_text(const Setpoint& setpoint) {
    if (const auto* position = std::get_if<PositionSetpoint>(&setpoint.motion)) {
        return fmt::format("position {} m, yaw {:.1f} deg", vector_text(position->p_W_m),
                           degrees(position->yaw_rad));
    }
    if (const auto* velocity = std::get_if<VelocitySetpoint>(&setpoint.motion)) {
        return fmt::format("velocity {} m/s, yaw {:.1f} deg", vector_text(velocity->v_W_m_s),
                           degrees(velocity->yaw_rad));
    }
    if (const auto* attitude = std::get_if<AttitudeSetpoint>(&setpoint.motion)) {
        return fmt::format("pitch {:.1f} deg, thrust {:.2f}",
                           degrees(euler_from_quaternion(attitude->q_WB).pitch_rad),
                           attitude->thrust);
    }
    return "idle";
}

void DryRun::tell(double time_s, const guidance::PerchingMemory& memory) {
    const Setpoint& now = memory.setpoint;
    const auto when = [&](bool changed, const std::string& text) {
        if (changed || !begun_) {
            say_(time_s, text);
        }
    };
    when(memory.state != state_, fmt::format("state     {}", to_string(memory.state)));
    if (!begun_ || differs(now, told_)) {
        say_(time_s, "set-point " + motion_text(now));
        told_.motion = now.motion;
    }
    when(now.armed != told_.armed, fmt::format("motors    {}", now.armed ? "on" : "off"));
    when(now.pump_on != told_.pump_on, fmt::format("pump      {}", now.pump_on ? "on" : "off"));
    when(now.valve_open != told_.valve_open,
         fmt::format("valve     {}", now.valve_open ? "open" : "closed"));
    state_ = memory.state;
    told_.armed = now.armed;
    told_.pump_on = now.pump_on;
    told_.valve_open = now.valve_open;
    begun_ = true;
}

}  // namespace limpet::companion
