// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/campaign/summary.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/statistics/success_curve.hpp"

/// The pendulum trials of Fig. 3: flown, counted by speed, and flown again with what is assumed of
/// them moved.
namespace limpet::paper {

/// Flies a campaign anew into campaigns/NAME/results.sqlite.
/// @param wanted   a file, or a name in campaigns/ of the data
/// @param press_N  takes the mean peak force of each impact speed, if given
/// @throws Interrupted
[[nodiscard]] campaign::CampaignSummary fly_trials(const std::string& wanted, const Study& study,
                                                   std::vector<double>* press_N = nullptr);

/// Success by one of the campaign's keys.
[[nodiscard]] const campaign::KeySummary& success_by(const campaign::CampaignSummary& summary,
                                                     const char* key);
/// The same by the pendulum's impact speed.
[[nodiscard]] const campaign::KeySummary& by_speed(const campaign::CampaignSummary& summary);

/// Successes and runs from one speed to another, both included.
[[nodiscard]] statistics::Proportion between(const std::vector<campaign::Group>& groups,
                                             double from_m_s, double to_m_s);

/// By how much the paper's best speeds, 1.0 to 1.2 m/s, attach more often than any slower one.
struct BestMargin {
    double mean = 0.0;
    double low = 0.0;  ///< of its 95 % interval (normal)
};
[[nodiscard]] BestMargin best_margin(const std::vector<campaign::Group>& groups);

/// The campaign fig3 with one of its assumptions moved.
struct MovedTrials {
    std::string assumption;  ///< "threshold -20 %"; of the first: "as assumed"
    campaign::CampaignSummary summary;
    statistics::SuccessCurve curve;
};

/// The first as assumed; then the threshold's median and the slider's damping a fifth down and up,
/// and the misalignment's spread at 0 and at 8 deg. Each flies the same draws. Its file, for
/// `limpet campaign`, and its results are in campaigns/fig3_NAME/.
/// @param repeats  trials of each speed
/// @throws Interrupted
[[nodiscard]] std::vector<MovedTrials> fly_moved_trials(const Study& study, int repeats);

}  // namespace limpet::paper
