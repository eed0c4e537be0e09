// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limpet/paper/parts.hpp"
#include "limpet/stability/map.hpp"
#include "limpet/statistics/shares.hpp"

/// The question that the paper leaves open: why its real vehicle swings in pitch while the cup
/// waits to release, and its simulation does not. Candidate: attitude control with a rate
/// integrator, on a pivot with seven times the inertia, behind motors slower than Gazebo's.
namespace limpet::paper {

using stability::Overrides;
/// The scenarios of slow motors, and of Gazebo's.
inline constexpr const char* kSlow = "slow_motors_metal";
inline constexpr const char* kGazebo = "perch_metal";
/// What the paper's vehicle, and each change to it here, keeps.
inline constexpr const char* kSwings = "a vehicle that rests on its cup and swings";
/// Both; where they set the same key the second counts.
[[nodiscard]] Overrides joined(Overrides first, const Overrides& second);

/// Growth and frequency of the pitch mode on the cup by a whole flight without noise, kicked as it
/// begins to wait for the release, less a twin that was not: what the take-off left does not count.
struct KickedSwing {
    double growth_1_s = 0.0;        ///< NaN when fewer than four extremes stand out
    double frequency_Hz = 0.0;      ///< likewise
    std::vector<double> time_s;     ///< since the kick
    std::vector<double> pitch_deg;  ///< of the kicked flight less its twin's
};
/// @param kick_deg  amplitude that an undamped swing would have
/// @return none when the flight does not come to its release, or the vehicle has no rest on its cup
[[nodiscard]] std::optional<KickedSwing> kicked_swing(const std::string& scenario,
                                                      const Overrides& overrides,
                                                      double kick_deg = 0.5);

/// Growth and frequency of the swing in a trace: extremes are found, the logarithm of the
/// differences between neighbours is a line whose slope is the growth.
/// @param floor  smaller differences are noise
[[nodiscard]] KickedSwing measure_swing(std::vector<double> time_s, std::vector<double> pitch_deg,
                                        double floor_deg = 0.02);

/// Axes of the map: the motors' lag, up and down alike [s]; centre of mass to the cup's joint [m].
[[nodiscard]] stability::Axis motor_lags(std::vector<double> lag_s);
[[nodiscard]] stability::Axis pivots(std::vector<double> pivot_m);
/// @param map   all but the growth, which is filled
/// @param jobs  threads
void fill(stability::StabilityMap& map, int jobs);

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

/// Fig. "fig-swing", its table and evidence: the missions of six cases, and with values turned.
void study_missions(Study& study);

/// How the same vehicle hovers in free air, with its sensors' noise.
/// @return largest tilt after the first seconds [deg]
[[nodiscard]] double hover_tilt_deg(const std::string& scenario);

}  // namespace limpet::paper
