// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/motion.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/lip_turn.hpp"

namespace limpet::guidance {
namespace {

// Against division by nothing; no flight comes near.
constexpr double kNothing_m_s2 = 1e-6;
constexpr double kSlowestGain_1_s = 0.1;  ///< line_gain_1_s may be 0
constexpr double kUpright = 0.1;  ///< cosine of 84 deg: nobody leans for an acceleration there

AttitudeSetpoint attitude(const PerchingMemory& memory, double pitch_rad, double thrust) {
    return {
        .q_WB = quaternion_from_euler({.pitch_rad = pitch_rad, .yaw_rad = memory.wall.heading_rad}),
        .thrust = thrust};
}

PositionSetpoint stand(const PerchingParameters& parameters, const PerchingMemory& memory) {
    if (!memory.wall.ever) {
        return {.p_W_m = memory.line_W_m, .yaw_rad = memory.entry_yaw_rad};
    }
    return {.p_W_m = pre_position_W(parameters, memory), .yaw_rad = memory.wall.heading_rad};
}

Vector3 right_of(const PerchingMemory& memory) {
    const Vector3 ahead_W = memory.wall.into_wall_W();
    return {-ahead_W.y(), ahead_W.x(), 0.0};
}

/// What an autopilot that was disarmed on the wall does not know any more.
Vector3 wind_trim_W_m_s2(const PerchingParameters& parameters, const PerchingMemory& memory) {
    return memory.has_perched && windy(parameters, memory) ? memory.wind.trim_W_m_s2
                                                           : Vector3(Vector3::Zero());
}

/// Along the wall's normal at the reference, back to the docking line across it.
VelocitySetpoint run(const PerchingParameters& parameters, const PerchingMemory& memory,
                     const Estimate& estimate, const RunReference& reference, double direction) {
    const Vector3 n_W = memory.wall.into_wall_W();
    const Vector3 error_W_m = memory.line_W_m - estimate.p_WB_m;
    const Vector3 across_W_m = error_W_m - n_W * n_W.dot(error_W_m);
    const double feedforward_m_s2 =
        reference.acceleration_m_s2 + parameters.drag_1_s * reference.speed_m_s;
    return {
        .v_W_m_s = direction * reference.speed_m_s * n_W + parameters.line_gain_1_s * across_W_m,
        .yaw_rad = memory.wall.heading_rad,
        .feedforward_a_W_m_s2 =
            direction * feedforward_m_s2 * n_W + wind_trim_W_m_s2(parameters, memory)};
}

/// Back to the pre-position: a run, then the position loop once braking must begin.
void retreat(const PerchingParameters& parameters, const PerchingMemory& memory,
             const Estimate& estimate, double elapsed_s, Setpoint& setpoint) {
    const double left_m =
        parameters.pre_distance_m - memory.wall.distance_m(parameters, estimate.p_WB_m);
    const double speed_m_s = parameters.retreat_speed_m_s;
    const double braking_m = 0.5 * speed_m_s * speed_m_s / parameters.retreat_acceleration_m_s2;
    // The position loop commands line_gain times the distance left: from there on it is the slower
    // one.
    if (left_m <
        std::max(braking_m, speed_m_s / std::max(parameters.line_gain_1_s, kSlowestGain_1_s))) {
        setpoint.motion = stand(parameters, memory);
        const Vector3 trim_W_m_s2 = wind_trim_W_m_s2(parameters, memory);
        if (!trim_W_m_s2.isZero()) {  // a position set-point carries none
            setpoint.motion =
                VelocitySetpoint{.v_W_m_s = parameters.line_gain_1_s *
                                            (pre_position_W(parameters, memory) - estimate.p_WB_m),
                                 .yaw_rad = memory.wall.heading_rad,
                                 .feedforward_a_W_m_s2 = trim_W_m_s2};
        }
    } else {
        setpoint.motion =
            run(parameters, memory, estimate,
                run_reference(elapsed_s, speed_m_s, parameters.retreat_acceleration_m_s2,
                              parameters.dock_ramp_s),
                -1.0);
    }
}

/// The attitude that makes an acceleration, heading for the wall.
/// @param a_W_m_s2  the weight is carried on top of it
AttitudeSetpoint leaning(const PerchingParameters& parameters, const PerchingMemory& memory,
                         const Vector3& a_W_m_s2) {
    const Vector3 ahead_W = memory.wall.into_wall_W();
    const Vector3 right_W = right_of(memory);
    const Vector3 f_W = a_W_m_s2 - Vector3(0.0, 0.0, kGravity_m_s2);
    const double size_m_s2 = std::max(f_W.norm(), kNothing_m_s2);
    return {.q_WB = quaternion_from_euler({.roll_rad = std::asin(f_W.dot(right_W) / size_m_s2),
                                           .pitch_rad = std::atan2(-f_W.dot(ahead_W), -f_W.z()),
                                           .yaw_rad = memory.wall.heading_rad}),
            .thrust = thrust_command(parameters, size_m_s2 / kGravity_m_s2)};
}

/// Without a position: to a stand before the wall by what LiDARs and IMU say, on attitude alone.
/// The wall is kept in the same drifting W as the estimate, so that their difference is the
/// LiDARs'.
AttitudeSetpoint brake(const PerchingParameters& parameters, const PerchingMemory& memory,
                       const Estimate& estimate) {
    const Vector3 n_W = memory.wall.into_wall_W();
    const double too_far_m =
        memory.wall.distance_m(parameters, estimate.p_WB_m) - parameters.pre_distance_m;
    const double speed_m_s =
        std::clamp(parameters.line_gain_1_s * too_far_m, -parameters.retreat_speed_m_s, 0.0);
    const double sink_m_s =
        parameters.altitude_gain_1_s * (memory.entry_p_W_m.z() - estimate.p_WB_m.z());
    Vector3 a_W_m_s2 = parameters.brake_gain_1_s * (speed_m_s * n_W - estimate.v_WB_m_s);
    a_W_m_s2.z() = parameters.climb_rate_gain_1_s * (sink_m_s - estimate.v_WB_m_s.z());
    a_W_m_s2 *= std::min(
        1.0, parameters.brake_acceleration_m_s2 / std::max(a_W_m_s2.norm(), kNothing_m_s2));
    return leaning(parameters, memory,
                   a_W_m_s2 + parameters.drag_1_s * speed_m_s * n_W + memory.wind.trim_W_m_s2);
}

/// States that fly: positions and velocities; attitudes where nobody knows the position.
Setpoint in_the_air(const PerchingParameters& parameters, const PerchingMemory& memory,
                    const Estimate& estimate, double elapsed_s) {
    Setpoint setpoint{.armed = true};
    if (memory.state == PerchingState::finished) {
        setpoint = memory.setpoint;  // as it is: on the wall at rest, in the air standing
        if (setpoint.armed && estimate.valid) {
            setpoint.motion =
                PositionSetpoint{.p_W_m = memory.entry_p_W_m, .yaw_rad = memory.entry_yaw_rad};
        } else if (setpoint.armed) {
            setpoint.motion = attitude(memory, 0.0, thrust_command(parameters, 1.0));
        }
    } else if (memory.state == PerchingState::hovering) {
        setpoint.motion =
            PositionSetpoint{.p_W_m = memory.line_W_m, .yaw_rad = memory.entry_yaw_rad};
    } else if (memory.state == PerchingState::approaching) {
        setpoint.pump_on = true;
        const RunReference reference =
            run_reference(elapsed_s, parameters.dock_speed_m_s, parameters.dock_acceleration_m_s2,
                          parameters.dock_ramp_s);
        setpoint.motion = run(parameters, memory, estimate, reference, 1.0);
    } else if (memory.state == PerchingState::retreating ||
               memory.state == PerchingState::backing_off) {
        setpoint.pump_on = memory.cup.pump_stays;
        setpoint.valve_open = parameters.valve_fitted && !memory.cup.pump_stays;
        retreat(parameters, memory, estimate, elapsed_s, setpoint);
    } else if (memory.state == PerchingState::braking) {
        setpoint.pump_on = memory.cup.pump_stays;
        setpoint.valve_open = parameters.valve_fitted && !memory.cup.pump_stays;
        setpoint.motion = brake(parameters, memory, estimate);
    } else {
        setpoint.motion = stand(parameters, memory);
    }
    return setpoint;
}

/// Share of the weight while level on the cup: all of it; with altitude_hold and in wind it also
/// keeps the joint's height. The vehicle pivots about the cup, so that damping the height of its
/// centre of mass damps its pitch.
double level_share(const PerchingParameters& parameters, const PerchingMemory& memory,
                   const Estimate& estimate) {
    if (!(parameters.altitude_hold || windy(parameters, memory)) ||
        !sits_on_grip(parameters, memory, estimate)) {
        return 1.0;
    }
    const double pitch_rad = level_pitch_rad(parameters, memory);
    const double joint_m =
        parameters.joint_z_m * std::cos(pitch_rad) - parameters.joint_x_m * std::sin(pitch_rad);
    const double height_error_m =
        memory.grip_W_m.z() - joint_m - estimate.p_WB_m.z();  // > 0: too high
    const double sink_m_s = parameters.altitude_gain_1_s * height_error_m;
    const double sink_m_s2 = parameters.climb_rate_gain_1_s * (sink_m_s - estimate.v_WB_m_s.z());
    return 1.0 - sink_m_s2 / kGravity_m_s2;
}

/// On the cup: an attitude in the plane that the turned lip holds, and a roll that keeps the
/// vehicle on neither side of it. Near the wall it stops leaning: both legs shall meet it, what
/// hangs below the cup keeps its side by its weight, and the legs hold it then.
/// @param share  of the weight along the thrust axis as long as it does not roll
AttitudeSetpoint on_the_cup(const PerchingParameters& parameters, const PerchingMemory& memory,
                            const Estimate& estimate, double pitch_rad, double share) {
    const double turn_rad = turn_on_cup_rad(parameters, memory);
    const double near = smoothstep((radians(parameters.perched_pitch_deg) - pitch_rad) /
                                   radians(parameters.roll_fade_deg));
    double side_m_s2 = 0.0;
    if (share > 0.0 && sits_on_grip(parameters, memory, estimate)) {
        const double v_m_s =
            right_of_lip_W(memory.wall.into_wall_W(), turn_rad).dot(estimate.v_WB_m_s);
        const double asked_m_s =
            -parameters.side_gain_1_s * side_error_m(parameters, memory, estimate);
        // Against the wind, and its own weight, which acts towards the lower side of a turned lip.
        const double known_m_s2 = windy(parameters, memory)
                                      ? right_of(memory).dot(memory.wind.trim_W_m_s2) *
                                                std::sqrt(share) * std::cos(turn_rad) -
                                            kGravity_m_s2 * std::sin(turn_rad)
                                      : 0.0;
        side_m_s2 = near * (known_m_s2 + memory.wind.side_m_s2 +
                            parameters.sway_gain_1_s * (asked_m_s - v_m_s));
    }
    const double along_m_s2 = kGravity_m_s2 * std::max(share, 0.0);
    side_m_s2 = std::clamp(side_m_s2, -parameters.roll_limit * along_m_s2,
                           parameters.roll_limit * along_m_s2);
    // The less thrust, the less wind: its weight may turn it back before the legs hold it so.
    const bool lands =
        memory.state == PerchingState::pitching_up || memory.state == PerchingState::unloading;
    const double turn_asked_rad = lands ? near * turn_rad : turn_rad;
    // The thrust that carries the share grows with the whole lean, turn and roll.
    const double part = along_m_s2 > 0.0 ? side_m_s2 / along_m_s2 : 0.0;
    const double roll_rad =
        std::atan(part * std::cos(turn_rad) / (1.0 + part * std::sin(turn_rad)));
    return {.q_WB = attitude_on_lip(memory.wall.heading_rad, turn_asked_rad, pitch_rad, roll_rad),
            .thrust = thrust_command(parameters, share / std::cos(turn_rad + roll_rad))};
}

/// Into the wall, in wind and gusts without being turned about the cup meanwhile.
decltype(Setpoint::motion) press(const PerchingParameters& parameters, const PerchingMemory& memory,
                                 const Estimate& estimate) {
    const Vector3 n_W = memory.wall.into_wall_W();
    const Vector3 right_W = right_of(memory);
    const Vector3 p_W_m = memory.entry_p_W_m + parameters.hold_depth_m * n_W;
    const double side_m = right_W.dot(estimate.p_WB_m - p_W_m);
    if (!windy(parameters, memory) && std::abs(side_m) < parameters.aside_limit_m) {
        return PositionSetpoint{.p_W_m = p_W_m, .yaw_rad = memory.wall.heading_rad};
    }
    const double side_m_s = -parameters.side_gain_1_s * side_m;
    const double side_m_s2 = parameters.sway_gain_1_s * (side_m_s - right_W.dot(estimate.v_WB_m_s));
    const Vector3 ahead_W_m = p_W_m - estimate.p_WB_m + side_m * right_W;
    return VelocitySetpoint{
        .v_W_m_s = parameters.line_gain_1_s * ahead_W_m + side_m_s * right_W,
        .yaw_rad = memory.wall.heading_rad,
        .feedforward_a_W_m_s2 = side_m_s2 * right_W + wind_trim_W_m_s2(parameters, memory)};
}

/// States in which the cup holds: attitude and thrust, since a position loop would pry at it.
Setpoint on_the_wall(const PerchingParameters& parameters, const PerchingMemory& memory,
                     const Estimate& estimate, double elapsed_s) {
    const double perched_rad =
        radians(parameters.perched_pitch_deg + parameters.pitch_over_travel_deg);
    const auto pitch_between = [&](double to_rad, double duration_s) {
        return memory.entry_pitch_rad +
               (to_rad - memory.entry_pitch_rad) * smoothstep(elapsed_s / duration_s);
    };
    const auto hangs = [&](double pitch_rad, double part) {  // rotors carry what the pitch leaves
        return on_the_cup(parameters, memory, estimate, pitch_rad, part * std::cos(pitch_rad));
    };
    const double level_rad = level_pitch_rad(parameters, memory);
    Setpoint setpoint{.armed = true, .pump_on = true};
    if (memory.state == PerchingState::holding || memory.state == PerchingState::deciding) {
        setpoint.hold_integrators = true;
        setpoint.motion = press(parameters, memory, estimate);
    } else if (memory.state == PerchingState::pitching_up) {
        const double pitch_rad = pitch_between(perched_rad, parameters.land_pitch_s);
        setpoint.motion = hangs(pitch_rad, 1.0);
    } else if (memory.state == PerchingState::unloading) {
        setpoint.hold_integrators = true;
        const double left = std::max(0.0, 1.0 - elapsed_s / parameters.land_thrust_s);
        setpoint.motion = hangs(perched_rad, left);
    } else if (memory.state == PerchingState::standing || memory.state == PerchingState::resting) {
        setpoint.armed = false;
    } else if (memory.state == PerchingState::spinning_up) {
        setpoint.hold_integrators = true;
        const double share = std::clamp(elapsed_s / parameters.spin_up_s, 0.0, 1.0);
        setpoint.motion = hangs(memory.entry_pitch_rad, share);
    } else if (memory.state == PerchingState::pitching_down) {
        const double pitch_rad = pitch_between(level_rad, parameters.level_pitch_s);
        setpoint.motion = hangs(pitch_rad, 1.0);
    } else {  // levelled, releasing, resealing
        const bool releases = memory.state == PerchingState::releasing;
        setpoint.pump_on = !releases;
        setpoint.valve_open = releases && parameters.valve_fitted;
        setpoint.motion = on_the_cup(parameters, memory, estimate, level_rad,
                                     level_share(parameters, memory, estimate));
    }
    return setpoint;
}

}  // namespace

Vector3 lean_W_m_s2(const Quaternion& q_WB) {
    const Vector3 up_B_W = q_WB * -Vector3::UnitZ();
    const double up = std::max(-up_B_W.z(), kUpright);
    return Vector3(up_B_W.x(), up_B_W.y(), 0.0) * (kGravity_m_s2 / up);
}

double calm_m_s2(const PerchingParameters& parameters) {
    return kGravity_m_s2 * std::tan(radians(parameters.calm_lean_deg));
}

bool windy(const PerchingParameters& parameters, const PerchingMemory& memory) {
    return memory.wind.most_m_s2 > calm_m_s2(parameters);
}

double level_pitch_rad(const PerchingParameters& parameters, const PerchingMemory& memory) {
    return windy(parameters, memory)
               ? std::atan2(-memory.wall.into_wall_W().dot(memory.wind.trim_W_m_s2), kGravity_m_s2)
               : 0.0;
}

double level_roll_rad(const PerchingParameters& parameters, const PerchingMemory& memory) {
    return windy(parameters, memory)
               ? std::atan2(right_of(memory).dot(memory.wind.trim_W_m_s2), kGravity_m_s2)
               : 0.0;
}

bool sits_on_grip(const PerchingParameters& parameters, const PerchingMemory& memory,
                  const Estimate& estimate) {
    const Vector3 joint_W_m =
        estimate.p_WB_m + estimate.q_WB * Vector3(parameters.joint_x_m, 0.0, parameters.joint_z_m);
    return estimate.valid && (joint_W_m - memory.grip_W_m).norm() < parameters.slip_limit_m;
}

double turn_on_cup_rad(const PerchingParameters& parameters, const PerchingMemory& memory) {
    return windy(parameters, memory) ? memory.wind.turn_rad : 0.0;
}

double side_error_m(const PerchingParameters& parameters, const PerchingMemory& memory,
                    const Estimate& estimate) {
    return right_of_lip_W(memory.wall.into_wall_W(), turn_on_cup_rad(parameters, memory))
        .dot(estimate.p_WB_m - memory.grip_W_m);
}

RunReference run_reference(double time_s, double speed_m_s, double acceleration_m_s2,
                           double ramp_s) {
    const double ramp = std::min(ramp_s, speed_m_s / acceleration_m_s2);
    const double peak_m_s2 =
        ramp > 0.0 ? std::min(acceleration_m_s2, speed_m_s / ramp) : acceleration_m_s2;
    const double hold_s = speed_m_s / peak_m_s2 - ramp;
    const double end_s = hold_s + 2.0 * ramp;
    if (time_s <= 0.0) {
        return {};
    }
    if (time_s >= end_s) {
        return {.speed_m_s = speed_m_s, .acceleration_m_s2 = 0.0};
    }
    if (time_s < ramp) {
        const double a_m_s2 = peak_m_s2 * time_s / ramp;
        return {.speed_m_s = 0.5 * a_m_s2 * time_s, .acceleration_m_s2 = a_m_s2};
    }
    if (time_s < ramp + hold_s) {
        return {.speed_m_s = peak_m_s2 * (time_s - 0.5 * ramp), .acceleration_m_s2 = peak_m_s2};
    }
    const double left_s = end_s - time_s;
    const double a_m_s2 = peak_m_s2 * left_s / ramp;
    return {.speed_m_s = speed_m_s - 0.5 * a_m_s2 * left_s, .acceleration_m_s2 = a_m_s2};
}

double smoothstep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double thrust_command(const PerchingParameters& parameters, double share) {
    const double command =
        parameters.zero_thrust +
        (parameters.hover_thrust - parameters.zero_thrust) * std::sqrt(std::max(share, 0.0));
    return std::clamp(command, 0.0, 1.0);
}

Vector3 pre_position_W(const PerchingParameters& parameters, const PerchingMemory& memory) {
    const Vector3 n_W = memory.wall.into_wall_W();
    const double along_m = memory.wall.offset_m - parameters.pre_distance_m - parameters.lidar_x_m;
    return memory.line_W_m + n_W * (along_m - n_W.dot(memory.line_W_m));
}

Setpoint motion(const PerchingParameters& parameters, const PerchingMemory& memory,
                const Estimate& estimate, double time_s) {
    const double elapsed_s = time_s - memory.since_s;
    switch (memory.state) {
        case PerchingState::hovering:
        case PerchingState::pre_positioning:
        case PerchingState::aligning:
        case PerchingState::approaching:
        case PerchingState::retreating:
        case PerchingState::backing_off:
        case PerchingState::braking:
        case PerchingState::finished: return in_the_air(parameters, memory, estimate, elapsed_s);
        case PerchingState::holding:
        case PerchingState::deciding:
        case PerchingState::pitching_up:
        case PerchingState::unloading:
        case PerchingState::standing:
        case PerchingState::resting:
        case PerchingState::spinning_up:
        case PerchingState::pitching_down:
        case PerchingState::levelled:
        case PerchingState::releasing:
        case PerchingState::resealing: return on_the_wall(parameters, memory, estimate, elapsed_s);
    }
    throw InternalError("perching state out of range");
}

}  // namespace limpet::guidance
