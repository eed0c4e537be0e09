// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/guards.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/guidance/motion.hpp"

namespace limpet::guidance::guards {
namespace {

// --- conditions that must hold for settle_s ---------------------------------------------------

/// What is requested is multiplied by it: 1, and from `patience_s` on in proportion to the time.
double leniency(double waited_s, double patience_s) {
    return std::max(1.0, waited_s / patience_s);
}

double leniency_before_wall(const Scene& s) {
    const bool is_back =
        s.memory.state == PerchingState::retreating || s.memory.state == PerchingState::backing_off;
    const bool hurries = is_back && windy(s.parameters, s.memory);
    return leniency(s.elapsed_s(),
                    hurries ? s.parameters.patience_back_s : s.parameters.patience_s);
}

bool stands_at_pre_position(const Scene& s) {
    if (!s.memory.wall.ever) {
        return false;
    }
    const double off_m = (s.estimate.p_WB_m - pre_position_W(s.parameters, s.memory)).norm();
    const double leans_m_s2 =
        std::max(0.0, lean_W_m_s2(s.estimate.q_WB).norm() - calm_m_s2(s.parameters));
    const double leniency = leniency_before_wall(s);
    return off_m <
               leniency * s.parameters.pre_tolerance_m + s.parameters.lean_error_s2 * leans_m_s2 &&
           s.estimate.v_WB_m_s.norm() < leniency * s.parameters.pre_speed_m_s;
}

bool sees_wall(const Scene& s) {
    return s.time_s - s.memory.wall.time_s <= s.parameters.sensor_limit_s;
}

bool faces_wall(const Scene& s) {
    // Half of the limit, after long waiting all of it: the rest is for the noise of the two LiDARs.
    // Shares of align_limit_deg, no parameters.
    constexpr double kOwnHalf = 0.5, kWhole = 2.0;
    return std::abs(s.misalignment_rad()) < kOwnHalf * std::min(leniency_before_wall(s), kWhole) *
                                                radians(s.parameters.align_limit_deg) &&
           stands_at_pre_position(s);
}

bool rests_on_legs(const Scene& s) {
    return s.elapsed_s() > s.parameters.land_thrust_s &&
           std::abs(s.estimate.w_WB_B_rad_s.y()) < radians(s.parameters.rest_rate_deg_s);
}

bool stands_before_wall(const Scene& s) {
    // By LiDARs and IMU alone nobody stands as still as with a position. A ratio to pre_speed_m_s,
    // no parameter.
    constexpr double kBlind = 2.0;
    const double closing_m_s = s.memory.wall.into_wall_W().dot(s.estimate.v_WB_m_s);
    return s.distance_m() > s.parameters.near_share * s.parameters.pre_distance_m &&
           std::abs(closing_m_s) < kBlind * s.parameters.pre_speed_m_s;
}

bool is_level(const Scene& s) {
    const double waited_s = s.elapsed_s() - s.parameters.level_pitch_s;
    const double leniency_in_wind =
        windy(s.parameters, s.memory) ? leniency(waited_s, s.parameters.patience_level_s) : 1.0;
    return waited_s > 0.0 &&
           std::abs(s.pitch_rad() - level_pitch_rad(s.parameters, s.memory)) <
               leniency_in_wind * radians(s.parameters.level_limit_deg) &&
           s.estimate.w_WB_B_rad_s.norm() <
               leniency_in_wind * radians(s.parameters.level_rate_deg_s);
}

// --- what each sense says of the cup ------------------------------------------------------------

double lean_limit_m_s2(const PerchingParameters& parameters) {
    return kGravity_m_s2 * std::tan(radians(parameters.lean_limit_deg));
}

enum class Vote {
    unknown,
    free,
    held
};

/// The joint stays where the cup gripped, whatever the pitch. An uncertain position must not tear
/// a cup off that holds: five sigma are allowed on top, of which chance is never beyond.
Vote vote_of_pose(const Scene& s) {
    if (!s.estimate.valid) {
        return Vote::unknown;
    }
    double variance_m2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        variance_m2 = std::max(variance_m2, s.estimate.variance[axis]);
    }
    constexpr double kSigmas = 5.0;
    const double moved_m = (joint_W(s.parameters, s.estimate) - s.memory.grip_W_m).norm();
    return moved_m > s.parameters.slip_limit_m + kSigmas * std::sqrt(variance_m2) ? Vote::free
                                                                                  : Vote::held;
}

Vote vote_of_pressure(const Scene& s) {
    if (!s.pressure_known()) {
        return Vote::unknown;
    }
    return s.pressure_Pa() < s.parameters.detach_pressure_Pa ? Vote::held : Vote::free;
}

double grip_force_N(const Scene& s) {
    return s.parameters.grip_force_share * s.parameters.impact_force_N;
}

/// Whatever hangs on the cup pulls or presses there; level, a cup that holds may bear nothing.
Vote vote_of_force(const Scene& s) {
    if (force_lost(s)) {
        return Vote::unknown;
    }
    if (std::abs(s.readings.force.value.axial_N) > grip_force_N(s)) {
        return Vote::held;
    }
    return std::abs(s.pitch_rad()) > radians(s.parameters.hang_pitch_deg) ? Vote::free
                                                                          : Vote::unknown;
}

/// Only a cup that holds is pulled at.
bool pulls(const Scene& s) {
    return !force_lost(s) && s.readings.force.value.axial_N > grip_force_N(s);
}

bool may_hold(const Scene& s) {
    return vote_of_pressure(s) != Vote::free || pulls(s);
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
        case PerchingState::braking: return stands_before_wall(s);
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
bool waited_for_wall(const Scene& s) {
    return waited_too_long(s) && !s.memory.wall.ever;
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
bool too_windy(const Scene& s) {
    return s.elapsed_s() > s.parameters.settle_s &&
           s.memory.wind.trim_W_m_s2.norm() > lean_limit_m_s2(s.parameters);
}
bool too_windy_across(const Scene& s) {
    // What the lip keeps of it turned, the vehicle must stand on its legs; and a wind off the wall
    // takes of what it can lean.
    const double limit_m_s2 = lean_limit_m_s2(s.parameters);
    const Vector3& trim_W_m_s2 = s.memory.wind.trim_W_m_s2;
    const Vector3 n_W = s.memory.wall.into_wall_W();
    const double across =
        n_W.cross(trim_W_m_s2).norm() / (s.parameters.lean_across_share * limit_m_s2);
    const double against = std::max(0.0, n_W.dot(trim_W_m_s2)) / limit_m_s2;
    return s.elapsed_s() > s.parameters.settle_s && std::hypot(across, against) > 1.0;
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
/// Where the force sensor is stuck: the wall has stopped it, and the cup holds.
bool caught(const Scene& s) {
    const double closing_m_s = s.memory.wall.into_wall_W().dot(s.estimate.v_WB_m_s);
    return sealed(s) && s.distance_m() < s.parameters.near_share * s.parameters.pre_distance_m &&
           closing_m_s < s.parameters.caught_speed_share * s.parameters.dock_speed_m_s;
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
bool estimate_back(const Scene& s) {
    return s.estimate.valid;
}
bool estimate_back_perched(const Scene& s) {
    return s.memory.has_perched && estimate_back(s);
}
bool looks_off(const Scene& s) {
    const Vote pose = vote_of_pose(s);
    const Vote pressure = vote_of_pressure(s);
    const Vote force = vote_of_force(s);
    if (pose == Vote::held || force == Vote::held) {
        return false;
    }
    // A pressure sensor may be stuck: two that see the cup off are believed against it.
    return pose == Vote::free ? pressure != Vote::held || force == Vote::free
                              : pressure == Vote::free && force == Vote::free;
}
bool came_off(const Scene& s) {
    return s.memory.off_since_s >= 0.0 &&
           s.time_s - s.memory.off_since_s >= s.parameters.debounce_s;
}
bool seems_sealed(const Scene& s) {
    return vote_of_pressure(s) == Vote::held;
}
bool held_back(const Scene& s) {
    return retreat_too_long(s) &&
           s.distance_m() < s.parameters.near_share * s.parameters.pre_distance_m && may_hold(s);
}
bool brakes_held(const Scene& s) {
    return retreat_too_long(s) && (vote_of_pressure(s) == Vote::held || pulls(s));
}
bool settled_released(const Scene& s) {
    return s.settled() && s.memory.has_perched && s.memory.cup.lets_go;
}
bool too_long_released(const Scene& s) {
    return retreat_too_long(s) && s.memory.has_perched && s.memory.cup.lets_go;
}
bool attempts_used_up(const Scene& s) {
    return s.settled() && s.memory.attempt >= s.parameters.attempts;
}
bool seal_lost(const Scene& s) {
    return s.memory.cup.sealed;
}
bool all_seals_lost(const Scene& s) {
    return attempts_used_up(s) && s.memory.cup.seals_lost >= s.memory.attempt;
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
bool rest_over_still(const Scene& s) {
    return rest_over(s) && (s.time_s - s.memory.rest.moved_s >= s.parameters.still_s ||
                            s.elapsed_s() >= s.parameters.rest_s + s.parameters.still_limit_s);
}
bool rest_over_turned(const Scene& s) {
    // About the vertical alone: on the cup the vehicle also turns about the wall's normal.
    const Quaternion turned =
        s.estimate.q_WB *
        quaternion_from_euler({.pitch_rad = s.pitch_rad(), .yaw_rad = s.memory.wall.heading_rad})
            .conjugate();
    const double about_z_rad = wrap_pi(2.0 * std::atan2(turned.z(), turned.w()));
    return rest_over_still(s) && std::abs(about_z_rad) > radians(s.parameters.turned_limit_deg);
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
    // Not one reading like that of the beginning: where a pump runs on, noise comes back to it.
    return s.time_s - std::max(s.memory.since_s, s.memory.cup.moved_s) > s.parameters.stuck_s;
}
bool stuck_behind_valve(const Scene& s) {
    return valve_fitted(s) && pressure_stuck(s);
}
bool seals_again(const Scene& s) {
    // Half-way back from where it counts as free to where it carries.
    const double again_Pa = 0.5 * (s.parameters.detach_pressure_Pa + s.parameters.land_pressure_Pa);
    return s.memory.cup.lets_go && s.pressure_known() && s.pressure_Pa() < again_Pa &&
           vote_of_pose(s) == Vote::held && s.memory.cup.sealed_again < s.parameters.attempts;
}
bool pressure_safe(const Scene& s) {
    return s.pressure_known() && s.pressure_Pa() > s.parameters.detach_pressure_Pa;
}
bool swings(const Scene& s) {
    return std::max(std::abs(s.pitch_rad() - level_pitch_rad(s.parameters, s.memory)),
                    std::abs(s.roll_rad() - level_roll_rad(s.parameters, s.memory))) >
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
