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

/// "position (1.20, 0.00, -0.10) m, yaw 3.0 deg", for people.
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

}  // namespace

void PoseEstimate::update(const Sample<PoseReading>& pose) {
    const double dt_s = pose.time_s - estimate_.time_s;
    if (!pose.ever() || (estimate_.valid && dt_s <= 0.0)) {
        return;
    }
    if (estimate_.valid) {
        const double gain = -std::expm1(-dt_s / kFilter_s);
        const Vector3 v_m_s = (pose.value.p_WB_m - estimate_.p_WB_m) / dt_s;
        const Eigen::AngleAxisd turn(estimate_.q_WB.conjugate() * pose.value.q_WB);
        const Vector3 w_rad_s = turn.axis() * (wrap_pi(turn.angle()) / dt_s);
        estimate_.v_WB_m_s += gain * (v_m_s - estimate_.v_WB_m_s);
        estimate_.w_WB_B_rad_s += gain * (w_rad_s - estimate_.w_WB_B_rad_s);
    }
    estimate_.time_s = pose.time_s;
    estimate_.p_WB_m = pose.value.p_WB_m;
    estimate_.q_WB = pose.value.q_WB;
    estimate_.valid = true;
}

void DryRun::tell(double time_s, const guidance::PerchingMemory& memory) {
    const Setpoint& now = memory.setpoint;
    const auto line = [&](std::string& last, const std::string& text) {
        if (text != last) {
            watch_.line(time_s, text);
            last = text;
        }
    };
    line(state_, fmt::format("state     {}", to_string(memory.state)));
    if (!last_ || differs(now, *last_)) {
        watch_.line(time_s, "set-point " + motion_text(now));
        last_ = now;
    }
    line(motors_, fmt::format("motors    {}", now.armed ? "on" : "off"));
    line(pump_, fmt::format("pump      {}", now.pump_on ? "on" : "off"));
    line(valve_, fmt::format("valve     {}", now.valve_open ? "open" : "closed"));
}

}  // namespace limpet::companion
