// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/guidance/perching.hpp"

/// The guards of the perching table: small questions about one instant, no memory of their own.
namespace limpet::guidance::guards {

/// All that a guard may look at.
struct Scene {
    const PerchingParameters& parameters;
    const PerchingTask& task;
    const PerchingMemory& memory;
    const Readings& readings;
    const Estimate& estimate;
    double time_s;

    [[nodiscard]] double elapsed_s() const { return time_s - memory.since_s; }
    [[nodiscard]] double distance_m() const {
        return memory.wall.distance_m(parameters, estimate.p_WB_m);
    }
    [[nodiscard]] bool settled() const {
        return memory.settled_since_s >= 0.0 &&
               time_s - memory.settled_since_s >= parameters.settle_s;
    }
    [[nodiscard]] double pitch_rad() const {
        return euler_from_quaternion(estimate.q_WB).pitch_rad;
    }
    [[nodiscard]] double roll_rad() const { return euler_from_quaternion(estimate.q_WB).roll_rad; }
    /// Heading off the wall's normal as it is known now, filtered.
    [[nodiscard]] double misalignment_rad() const {
        return wrap_pi(memory.wall.heading_rad - euler_from_quaternion(estimate.q_WB).yaw_rad);
    }
    [[nodiscard]] bool pressure_known() const {
        return !memory.cup.pressure_doubted &&
               readings.cup_pressure.fresh(time_s, parameters.sensor_limit_s);
    }
    [[nodiscard]] double pressure_Pa() const { return readings.cup_pressure.value.pressure_Pa; }
};

/// Where the cup's joint is by the estimate: it stays while the cup holds, whatever the pitch.
[[nodiscard]] Vector3 joint_W(const PerchingParameters& parameters, const Estimate& estimate);

/// The condition of the memory's state that must hold for settle_s; false where a state has none.
[[nodiscard]] bool settling(const Scene& s);

[[nodiscard]] bool always(const Scene& s);
[[nodiscard]] bool settled(const Scene& s);
[[nodiscard]] bool hover_over(const Scene& s);
[[nodiscard]] bool waited_too_long(const Scene& s);
[[nodiscard]] bool waited_for_wall(const Scene& s);
[[nodiscard]] bool battery_low(const Scene& s);
[[nodiscard]] bool wall_lost(const Scene& s);
/// Leans farther against the wind than the wall can be left with.
[[nodiscard]] bool too_windy(const Scene& s);
[[nodiscard]] bool too_windy_across(const Scene& s);
[[nodiscard]] bool force_lost(const Scene& s);
/// A free cup is at atmospheric pressure: a sensor that says otherwise, or nothing, is broken.
[[nodiscard]] bool pressure_implausible(const Scene& s);
[[nodiscard]] bool wall_hit(const Scene& s);
[[nodiscard]] bool caught(const Scene& s);
[[nodiscard]] bool approach_too_long(const Scene& s);
[[nodiscard]] bool hold_is_over(const Scene& s);
[[nodiscard]] bool sealed(const Scene& s);
/// Too weak to land on, at this instant.
[[nodiscard]] bool weak(const Scene& s);
/// And for debounce_s.
[[nodiscard]] bool vacuum_lost(const Scene& s);
[[nodiscard]] bool pitched_up(const Scene& s);
[[nodiscard]] bool landing_too_long(const Scene& s);
[[nodiscard]] bool retreat_too_long(const Scene& s);
[[nodiscard]] bool estimate_lost(const Scene& s);
[[nodiscard]] bool estimate_back(const Scene& s);
[[nodiscard]] bool estimate_back_perched(const Scene& s);
/// Pose, pressure and force vote, as far as each is known: none that can judge says that it holds,
/// or two of three that it does not. At this instant.
[[nodiscard]] bool looks_off(const Scene& s);
/// And for debounce_s.
[[nodiscard]] bool came_off(const Scene& s);
/// As far as the pressure shows.
[[nodiscard]] bool seems_sealed(const Scene& s);
/// Still at the wall when the retreat should be over, and nothing says that wind does it.
[[nodiscard]] bool held_back(const Scene& s);
/// The same without a position.
[[nodiscard]] bool brakes_held(const Scene& s);
/// The pump was switched off to leave, and not since switched on again.
[[nodiscard]] bool settled_released(const Scene& s);
[[nodiscard]] bool too_long_released(const Scene& s);
[[nodiscard]] bool seal_lost(const Scene& s);
[[nodiscard]] bool all_seals_lost(const Scene& s);
[[nodiscard]] bool attempts_used_up(const Scene& s);
[[nodiscard]] bool rest_over(const Scene& s);
[[nodiscard]] bool rest_over_given_up(const Scene& s);
[[nodiscard]] bool rest_over_stay(const Scene& s);
[[nodiscard]] bool spun_up(const Scene& s);
[[nodiscard]] bool not_level_in_time(const Scene& s);
[[nodiscard]] bool rest_over_blind(const Scene& s);
/// A heading that is not the wall's any more: rotors would push it along or off the wall.
[[nodiscard]] bool rest_over_turned(const Scene& s);
/// The estimate has not moved for a while, or is waited for no longer.
[[nodiscard]] bool rest_over_still(const Scene& s);
[[nodiscard]] bool battery_low_flies(const Scene& s);
[[nodiscard]] bool battery_low_stays(const Scene& s);
[[nodiscard]] bool back_unperched(const Scene& s);
[[nodiscard]] bool valve_fitted(const Scene& s);
/// The air comes in, the reading does not move.
[[nodiscard]] bool pressure_stuck(const Scene& s);
[[nodiscard]] bool stuck_behind_valve(const Scene& s);
/// Let go of, it holds again: a pump that runs on, a soft cup that the pull stretches. So often as
/// there are attempts.
[[nodiscard]] bool seals_again(const Scene& s);
[[nodiscard]] bool pressure_safe(const Scene& s);
[[nodiscard]] bool swings(const Scene& s);
[[nodiscard]] bool release_too_long(const Scene& s);
[[nodiscard]] bool no_vacuum(const Scene& s);
/// The vacuum is not known: to let go would be a guess, to rest with the pump on is none.
[[nodiscard]] bool reseals_blind(const Scene& s);

}  // namespace limpet::guidance::guards
