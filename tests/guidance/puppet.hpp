// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "limpet/guidance/perching.hpp"

namespace limpet::guidance {

/// A vehicle on strings: it does what the set-point says, at once, before a wall to the north.
/// Enough of a world to walk guidance through its table without any physics.
class Puppet {
public:
    static constexpr double kDt_s = 0.02;
    static constexpr double kWall_m = 2.2;
    static constexpr double kLip_m = 0.5;  ///< ahead of the centre of mass

    PerchingParameters parameters;
    PerchingTask task;
    PerchingMemory memory;
    std::vector<Event> events;
    Readings readings;
    Estimate estimate;
    double time_s = 0.0;
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;

    bool seals = true;        ///< what the wall does
    double leak_tau_s = 0.4;  ///< how fast the vacuum goes when the pump is off
    bool lidar_works = true;
    bool force_works = true;
    bool pressure_works = true;
    bool holds = true;  ///< the cup, while the vehicle flies by attitude
    bool knows_position = true;
    double misled_rad = 0.0;  ///< by so much the estimated heading is off
    double swing_deg = 0.0;   ///< pitch while waiting for the release
    double vacuum_Pa = 65000.0;
    double pump_runs_on_s = 0.0;  ///< after it was switched off
    double ripple_Pa = 0.0;       ///< of the reading, in turn up and down, while the pump draws
    bool clings = false;          ///< the cup, whatever the pump and however the vehicle flies

    Puppet() { restart(); }

    void restart() { memory = start_perching(task, estimate, time_s); }

    void run(double duration_s) {
        for (const double end_s = time_s + duration_s; time_s < end_s && !memory.ending;) {
            tick();
        }
    }

    /// @return whether it got there within the time
    bool run_to(PerchingState state, double limit_s = 60.0) {
        for (const double end_s = time_s + limit_s; time_s < end_s;) {
            if (memory.state == state) {
                return true;
            }
            tick();
        }
        return false;
    }

    [[nodiscard]] std::vector<EventName> names() const {
        std::vector<EventName> list;
        for (const Event& event : events) {
            list.push_back(event.name);
        }
        return list;
    }

    [[nodiscard]] double time_of(EventName name) const {
        for (const Event& event : events) {
            if (event.name == name) {
                return event.time_s;
            }
        }
        return std::nan("");
    }

    /// The world alone: does as memory.setpoint says, measures.
    void step_world() {
        time_s += kDt_s;
        move();
        measure();
    }

    void tick() {
        step_world();
        EventList happened;
        update(parameters, task, memory, readings, estimate, time_s, happened);
        events.insert(events.end(), happened.events.begin(),
                      happened.events.begin() + static_cast<std::ptrdiff_t>(happened.count));
    }

private:
    void move() {
        const Setpoint& setpoint = memory.setpoint;
        const Vector3 joint_B_m(parameters.joint_x_m, 0.0, 0.0);
        const Vector3 joint_W_m = estimate.p_WB_m + estimate.q_WB * joint_B_m;
        bool hangs = false;
        Vector3 v_W = Vector3::Zero();
        pitch_rad = 0.0;
        if (const auto* position = std::get_if<PositionSetpoint>(&setpoint.motion)) {
            const Vector3 error_m = position->p_W_m - estimate.p_WB_m;
            v_W = error_m * std::min(1.0 / std::max(error_m.norm(), 1e-9), 1.0 / kDt_s);
            yaw_rad = position->yaw_rad;
        } else if (const auto* velocity = std::get_if<VelocitySetpoint>(&setpoint.motion)) {
            v_W = velocity->v_W_m_s;
            yaw_rad = velocity->yaw_rad;
        } else if (const auto* attitude = std::get_if<AttitudeSetpoint>(&setpoint.motion)) {
            pitch_rad = euler_from_quaternion(attitude->q_WB).pitch_rad;
            hangs = holds;
        } else {
            pitch_rad = radians(parameters.perched_pitch_deg);  // on its legs
            hangs = true;
        }
        if (memory.state == PerchingState::releasing) {
            pitch_rad += radians(swing_deg);
        }
        estimate.q_WB =
            quaternion_from_euler({.pitch_rad = pitch_rad, .yaw_rad = yaw_rad + misled_rad});
        if (hangs || clings) {  // turns about the cup's joint
            estimate.p_WB_m = joint_W_m - estimate.q_WB * joint_B_m;
        } else {
            estimate.p_WB_m += v_W * kDt_s;
            estimate.p_WB_m.x() = std::min(estimate.p_WB_m.x(), kWall_m - kLip_m + 0.03);
        }
        estimate.v_WB_m_s = v_W;
        estimate.time_s = time_s;
        estimate.valid = knows_position;
    }

    void measure() {
        const double reach_m =
            parameters.joint_x_m * std::cos(pitch_rad) + kLip_m - parameters.joint_x_m;
        const bool touches = estimate.p_WB_m.x() + reach_m >= kWall_m - 1e-9;
        if (lidar_works) {
            const double half_m = 0.5 * parameters.lidar_separation_m;
            const double ahead_m = kWall_m - estimate.p_WB_m.x() - parameters.lidar_x_m;
            const double slope = std::tan(yaw_rad);
            readings.lidar_left = {time_s, {(ahead_m - half_m * slope), true}};
            readings.lidar_right = {time_s, {(ahead_m + half_m * slope), true}};
        }
        if (force_works) {
            readings.force = {time_s, {touches ? -40.0 : 0.0}};
        }
        double& pressure_Pa = pressure_;
        pump_on_s_ = memory.setpoint.pump_on ? time_s : pump_on_s_;
        const bool turns = time_s - pump_on_s_ < pump_runs_on_s || memory.setpoint.pump_on;
        const bool sucks = turns && !memory.setpoint.valve_open;
        if ((touches && seals && sucks) || clings) {
            pressure_Pa = vacuum_Pa + (pressure_Pa - vacuum_Pa) * std::exp(-kDt_s / 0.33);
        } else {
            const double tau_s = memory.setpoint.valve_open ? 0.04 : leak_tau_s;
            pressure_Pa =
                kAtmosphere_Pa + (pressure_Pa - kAtmosphere_Pa) * std::exp(-kDt_s / tau_s);
        }
        if (pressure_works) {
            ripple_Pa = -ripple_Pa;
            readings.cup_pressure = {time_s, {pressure_Pa + (turns ? ripple_Pa : 0.0)}};
        }
    }

    double pressure_ = kAtmosphere_Pa;
    double pump_on_s_ = -1e9;
};

}  // namespace limpet::guidance
