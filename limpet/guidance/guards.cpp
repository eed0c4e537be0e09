// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/guards.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/motion.hpp"

namespace limpet::guidance::guards {
namespace {

// --- conditions that must hold for settle_s ---------------------------------------------------

bool stands_at_pre_position(const Scene& s) {
    return s.memory.wall.ever &&
           (s.estimate.p_WB_m - pre_position_W(s.parameters, s.memory)).norm() <
               s.parameters.pre_tolerance_m &&
           s.estimate.v_WB_m_s.norm() < s.parameters.pre_speed_m_s;
}

bool sees_wall(const Scene& s) {
    return s.time_s - s.memory.wall.time_s <= s.parameters.sensor_limit_s;
}

bool faces_wall(const Scene& s) {
    // Half of the limit: the other half is for the noise of the two LiDARs.
    return std::abs(s.misalignment_rad()) < 0.5 * radians(s.parameters.align_limit_deg) &&
           stands_at_pre_position(s);
}

bool rests_on_legs(const Scene& s) {
    return s.elapsed_s() > s.parameters.land_thrust_s &&
           std::abs(s.estimate.w_WB_B_rad_s.y()) < radians(s.parameters.rest_rate_deg_s);
}

bool is_level(const Scene& s) {
    return s.elapsed_s() > s.parameters.level_pitch_s &&
           std::abs(s.pitch_rad()) < radians(s.parameters.level_limit_deg) &&
           s.estimate.w_WB_B_rad_s.norm() < radians(s.parameters.level_rate_deg_s);
}

}  // namespace

Vector3 joint_W(const PerchingParameters& parameters, const Estimate& estimate) {
    return estimate.p_WB_m +
           estimate.q_WB * Vector3(parameters.joint_x_m, 0.0, parameters.joint_z_m);
}

bool settling(const Scene& s) {
    switch (s.memory.state) {
        case PerchingState::pre_positioning: return stands_at_pre_position(s) && sees_wall(s);
        case PerchingState::retreating:
        case PerchingState::backing_off: return stands_at_pre_position(s);
        case PerchingState::aligning: return faces_wall(s);
        case PerchingState::unloading: return rests_on_legs(s);
        case PerchingState::pitching_down: return is_level(s);
        case PerchingState::hovering:
        case PerchingState::approaching:
        case PerchingState::holding:
        case PerchingState::deciding:
        case PerchingState::pitching_up:
        case PerchingState::standing:
        case PerchingState::resting:
        case PerchingState::spinning_up:
        case PerchingState::levelled:
        case PerchingState::releasing:
        case PerchingState::resealing:
        case PerchingState::finished: return false;
    }
    throw InternalError("perching state out of range");
}

// --- guards -----------------------------------------------------------------------------------

bool always(const Scene&) {
    return true;
}
bool settled(const Scene& s) {
    return s.settled();
}
bool hover_over(const Scene& s) {
    return s.elapsed_s() >= s.task.hover_s;
}
bool waited_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.wait_limit_s;
}
bool battery_low(const Scene& s) {
    return s.readings.battery.ever() &&
           s.readings.battery.value.remaining < s.parameters.battery_reserve;
}
bool wall_lost(const Scene& s) {
    return !sees_wall(s);
}
bool force_lost(const Scene& s) {
    return !s.readings.force.fresh(s.time_s, s.parameters.sensor_limit_s);
}
bool pressure_implausible(const Scene& s) {
    return s.elapsed_s() > s.parameters.settle_s &&
           (!s.pressure_known() || s.pressure_Pa() < s.parameters.land_pressure_Pa);
}
bool wall_hit(const Scene& s) {
    return s.readings.force.value.axial_N < -s.parameters.impact_force_N;
}
bool approach_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.approach_limit_s;
}
bool hold_is_over(const Scene& s) {
    return s.elapsed_s() >= s.parameters.hold_s;
}
bool sealed(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() < s.parameters.land_pressure_Pa;
}
bool weak(const Scene& s) {
    return s.pressure_Pa() > s.parameters.land_pressure_Pa;
}
bool vacuum_lost(const Scene& s) {
    return s.memory.weak_since_s >= 0.0 &&
           s.time_s - s.memory.weak_since_s >= s.parameters.debounce_s;
}
bool pitched_up(const Scene& s) {
    return s.elapsed_s() >= s.parameters.land_pitch_s;
}
bool landing_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.land_limit_s;
}
bool retreat_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.retreat_limit_s;
}
bool estimate_lost(const Scene& s) {
    return !s.estimate.valid;
}
bool came_off(const Scene& s) {
    // An uncertain position must not tear a cup off that holds: five sigma are allowed on top.
    double variance_m2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        variance_m2 = std::max(variance_m2, s.estimate.variance[axis]);
    }
    return s.estimate.valid && (joint_W(s.parameters, s.estimate) - s.memory.grip_W_m).norm() >
                                   s.parameters.slip_limit_m + 5.0 * std::sqrt(variance_m2);
}
bool held_back(const Scene& s) {
    return retreat_too_long(s) && s.distance_m() < 0.5 * s.parameters.pre_distance_m;
}
bool held_by_vacuum(const Scene& s) {
    return held_back(s) &&
           (!s.pressure_known() || s.pressure_Pa() < s.parameters.detach_pressure_Pa);
}
bool attempts_used_up(const Scene& s) {
    return s.settled() && s.memory.attempt >= s.parameters.attempts;
}
bool rest_over(const Scene& s) {
    return s.elapsed_s() >= s.parameters.rest_s;
}
bool rest_over_given_up(const Scene& s) {
    return s.memory.release_given_up && rest_over(s);
}
bool rest_over_stay(const Scene& s) {
    return !s.task.take_off && rest_over(s);
}
bool spun_up(const Scene& s) {
    return s.elapsed_s() >= s.parameters.spin_up_s;
}
bool not_level_in_time(const Scene& s) {
    return s.elapsed_s() > s.parameters.level_limit_s;
}
bool rest_over_blind(const Scene& s) {
    return rest_over(s) && estimate_lost(s);
}
bool battery_low_flies(const Scene& s) {
    return s.task.take_off && battery_low(s);
}
bool battery_low_stays(const Scene& s) {
    return !s.task.take_off && battery_low(s);
}
bool back_unperched(const Scene& s) {
    return s.settled() && !s.memory.has_perched;
}
bool valve_fitted(const Scene& s) {
    return s.parameters.valve_fitted;
}
bool pressure_stuck(const Scene& s) {
    return s.elapsed_s() > s.parameters.stuck_s &&
           std::abs(s.pressure_Pa() - s.memory.entry_pressure_Pa) < 1.0;
}
bool stuck_behind_valve(const Scene& s) {
    return valve_fitted(s) && pressure_stuck(s);
}
bool pressure_safe(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() > s.parameters.detach_pressure_Pa;
}
bool swings(const Scene& s) {
    return std::max(std::abs(s.pitch_rad()), std::abs(s.roll_rad())) >
           radians(s.parameters.oscillation_limit_deg);
}
bool release_too_long(const Scene& s) {
    return s.elapsed_s() > s.parameters.release_limit_s;
}
bool no_vacuum(const Scene& s) {
    return s.elapsed_s() > s.parameters.reseal_limit_s && s.pressure_known();
}
bool reseals_blind(const Scene& s) {
    return s.elapsed_s() > s.parameters.reseal_limit_s && !s.pressure_known();
}

}  // namespace limpet::guidance::guards
