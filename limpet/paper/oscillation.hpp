// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "limpet/campaign/statistics.hpp"
#include "limpet/paper/level_on_cup.hpp"

/// The question that the paper leaves open: why its real vehicle swings in pitch while the cup
/// waits to release, and its simulation does not. Candidate: attitude control with a rate
/// integrator, on a pivot with seven times the inertia, behind motors slower than Gazebo's.
namespace limpet::paper {

/// `--set` texts that make a scenario another case.
using Overrides = std::vector<std::string>;

/// Growth and frequency of the pitch mode on the cup, by the linearised loop.
/// @throws InputError when the overrides do not make a scenario
[[nodiscard]] Mode linear_swing(const std::string& scenario, const Overrides& overrides);

/// The same by a whole flight without noise, kicked as it begins to wait for the release, less a
/// twin that was not: what the take-off left does not count.
struct KickedSwing {
    double growth_1_s = 0.0;        ///< NaN when fewer than four extremes stand out
    double frequency_Hz = 0.0;      ///< likewise
    std::vector<double> time_s;     ///< since the kick
    std::vector<double> pitch_deg;  ///< of the kicked flight less its twin's
};
/// @param kick_deg  amplitude that an undamped swing would have
[[nodiscard]] KickedSwing kicked_swing(const std::string& scenario, const Overrides& overrides,
                                       double kick_deg = 0.5);

/// Growth and frequency of the swing in a trace: extremes are found, the logarithm of the
/// differences between neighbours is a line whose slope is the growth.
/// @param floor  smaller differences are noise
[[nodiscard]] KickedSwing measure_swing(std::vector<double> time_s, std::vector<double> pitch_deg,
                                        double floor_deg = 0.02);

/// A vehicle with these motors, up and down alike, and this distance from centre of mass to joint.
[[nodiscard]] Overrides motors_and_pivot(double lag_s, double pivot_m);

/// Growth over motor lag and pivot distance, row by row of the pivot.
struct StabilityMap {
    std::string title = {};
    std::string scenario = {};  ///< all that is not on the axes, dead time included
    Overrides gains = {};
    std::vector<double> lag_s = {};
    std::vector<double> pivot_m = {};
    std::vector<double> growth_1_s = {};  ///< [pivot * lag_s.size() + lag]
    [[nodiscard]] double at(std::size_t pivot, std::size_t lag) const {
        return growth_1_s[pivot * lag_s.size() + lag];
    }
};
/// @param map   all but the growth, which is filled
/// @param jobs  threads
void fill(StabilityMap& map, int jobs);

/// Whole missions: the largest pitch while waiting for the release, over runs with noise and gusts.
struct SwingMissions {
    std::vector<double> pitch_deg;  ///< of the missions that came to wait, sorted
    std::vector<double> swing_deg;  ///< half of the span of their pitch, sorted
    std::uint32_t runs = 0;
    std::uint32_t attached = 0;  ///< perched before
    std::uint32_t crashed = 0;
    [[nodiscard]] double quantile(double share) const;  ///< of pitch_deg
    [[nodiscard]] double median_swing_deg() const;
};
[[nodiscard]] SwingMissions swing_missions(const std::string& scenario, const Overrides& overrides,
                                           std::uint32_t runs, int jobs);

/// How the same vehicle hovers in free air, with its sensors' noise.
/// @return largest tilt after the first seconds [deg]
[[nodiscard]] double hover_tilt_deg(const std::string& scenario);

}  // namespace limpet::paper
