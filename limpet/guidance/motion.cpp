// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/motion.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::guidance {
namespace {

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
        .feedforward_a_W_m_s2 = direction * feedforward_m_s2 * n_W};
}

/// Back to the pre-position: a run, then the position loop once braking must begin.
void retreat(const PerchingParameters& parameters, const PerchingMemory& memory,
             const Estimate& estimate, double elapsed_s, Setpoint& setpoint) {
    const double left_m =
        parameters.pre_distance_m - memory.wall.distance_m(parameters, estimate.p_WB_m);
    const double speed_m_s = parameters.retreat_speed_m_s;
    const double braking_m = 0.5 * speed_m_s * speed_m_s / parameters.retreat_acceleration_m_s2;
    // The position loop asks for line_gain times the distance left: from there on it is the slower
    // one.
    if (left_m < std::max(braking_m, speed_m_s / std::max(parameters.line_gain_1_s, 0.1))) {
        setpoint.motion = stand(parameters, memory);
    } else {
        setpoint.motion =
            run(parameters, memory, estimate,
                run_reference(elapsed_s, speed_m_s, parameters.retreat_acceleration_m_s2,
                              parameters.dock_ramp_s),
                -1.0);
    }
}

/// States that fly: positions and velocities.
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
    } else if (memory.state == PerchingState::retreating) {
        retreat(parameters, memory, estimate, elapsed_s, setpoint);
    } else if (memory.state == PerchingState::backing_off) {
        setpoint.valve_open = parameters.valve_fitted;
        retreat(parameters, memory, estimate, elapsed_s, setpoint);
    } else {
        setpoint.motion = stand(parameters, memory);
    }
    return setpoint;
}

/// Thrust while level on the cup: the weight; with altitude_hold it also keeps the joint's height.
/// The vehicle pivots about the cup, so that damping the height of its centre of mass damps its
/// pitch.
double level_thrust(const PerchingParameters& parameters, const PerchingMemory& memory,
                    const Estimate& estimate) {
    if (!parameters.altitude_hold || !estimate.valid) {
        return thrust_command(parameters, 1.0);
    }
    const double height_error_m =
        memory.grip_W_m.z() - parameters.joint_z_m - estimate.p_WB_m.z();  // > 0: too high
    const double sink_m_s = parameters.altitude_gain_1_s * height_error_m;
    const double sink_m_s2 = parameters.climb_rate_gain_1_s * (sink_m_s - estimate.v_WB_m_s.z());
    return thrust_command(parameters, 1.0 - sink_m_s2 / kGravity_m_s2);
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
    const auto carried = [&](double pitch_rad) {  // the share of the weight that rotors carry
        return thrust_command(parameters, std::cos(pitch_rad));
    };
    Setpoint setpoint{.armed = true, .pump_on = true};
    if (memory.state == PerchingState::holding || memory.state == PerchingState::deciding) {
        setpoint.hold_integrators = true;
        setpoint.motion = PositionSetpoint{
            .p_W_m = memory.entry_p_W_m + parameters.hold_depth_m * memory.wall.into_wall_W(),
            .yaw_rad = memory.wall.heading_rad};
    } else if (memory.state == PerchingState::pitching_up) {
        const double pitch_rad = pitch_between(perched_rad, parameters.land_pitch_s);
        setpoint.motion = attitude(memory, pitch_rad, carried(pitch_rad));
    } else if (memory.state == PerchingState::unloading) {
        setpoint.hold_integrators = true;
        const double left = std::max(0.0, 1.0 - elapsed_s / parameters.land_thrust_s);
        setpoint.motion = attitude(memory, perched_rad, left * carried(perched_rad));
    } else if (memory.state == PerchingState::standing || memory.state == PerchingState::resting) {
        setpoint.armed = false;
    } else if (memory.state == PerchingState::spinning_up) {
        setpoint.hold_integrators = true;
        const double share = std::clamp(elapsed_s / parameters.spin_up_s, 0.0, 1.0);
        setpoint.motion =
            attitude(memory, memory.entry_pitch_rad, share * carried(memory.entry_pitch_rad));
    } else if (memory.state == PerchingState::pitching_down) {
        const double pitch_rad = pitch_between(0.0, parameters.level_pitch_s);
        setpoint.motion = attitude(memory, pitch_rad, carried(pitch_rad));
    } else {  // levelled, releasing, resealing
        const bool releases = memory.state == PerchingState::releasing;
        setpoint.pump_on = !releases;
        setpoint.valve_open = releases && parameters.valve_fitted;
        setpoint.motion = attitude(memory, 0.0, level_thrust(parameters, memory, estimate));
    }
    return setpoint;
}

}  // namespace

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
