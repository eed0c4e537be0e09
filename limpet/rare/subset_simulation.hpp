// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "limpet/campaign/sampling.hpp"
#include "limpet/statistics/shares.hpp"

namespace limpet::rare {

/// Where a run stands in what is random: an independent standard normal for each drawn input, and
/// the noise that it flies with.
struct RarePoint {
    std::vector<double> normals;
    NoiseBlend noise;

    /// Distance of the inputs from their medians, in standard deviations: the smaller, the more
    /// likely. The noise does not count.
    [[nodiscard]] double distance() const;
};

/// A run of a search for a rare event.
struct RareSample {
    std::uint32_t run = 0;     ///< its number, from 0 in the order of the search
    std::uint32_t level = 0;   ///< 0: drawn as a campaign draws
    std::uint32_t chain = 0;   ///< of its level
    std::uint32_t parent = 0;  ///< the run near which it was proposed; itself on level 0
    RarePoint point;
    /// Falls towards the event, and is no higher at the event than anywhere else; infinite where
    /// the flight has no such figure.
    double fall = std::numeric_limits<double>::infinity();
    bool event = false;
    std::uint32_t ancestor = 0;  ///< its run of level 0
};

struct SubsetPlan {
    std::uint64_t seed = 1;
    std::size_t inputs = 0;
    std::uint32_t level_runs = 1000;  ///< N
    double level_share = 0.1;         ///< p0 of the samples go on to the next level
    double least = 1e-9;              ///< below it the search ends
};

/// A level and what goes on from it.
struct SubsetLevel {
    double threshold = 0.0;  ///< of `fall`, that the share reaches; of the last level the event's
    std::uint32_t samples = 0;
    std::uint32_t reached = 0;  ///< of them
    /// Squared coefficient of variation of reached / samples, with the chains' correlation.
    double variation2 = 0.0;
    double acceptance = 0.0;  ///< of the proposals; of level 0 NaN
    double step = 0.0;        ///< of the proposals, at the level's end; of level 0 NaN

    [[nodiscard]] double share() const { return static_cast<double>(reached) / samples; }
};

enum class RareEnding {
    estimated,  ///< the last level's threshold is the event
    too_rare,   ///< less probable than the plan's least
    stuck,      ///< too few runs come any nearer: the figure is not there, or does not fall on
    stopped,    ///< by the judge
};

/// Probability of coming as near to the event as `fall`, or nearer.
struct RarePlace {
    double fall = 0.0;
    double probability = 0.0;
    double variation2 = 0.0;

    [[nodiscard]] statistics::Interval interval() const;
};

struct SubsetResult {
    RareEnding ending = RareEnding::stopped;
    std::vector<SubsetLevel> levels;
    std::vector<RarePlace> curve;  ///< from 1 down to the event, or as near as was come
    std::uint32_t runs = 0;        ///< all that were judged
    std::uint32_t events = 0;      ///< of them, rejected proposals too
    std::uint32_t likeliest = 0;   ///< the event's run of the least distance, where there are any
    double likeliest_distance = std::numeric_limits<double>::infinity();
    double lineages = 0.0;            ///< effective number of runs of level 0 that the last
                                      ///< threshold's samples descend from
    double lineage_variation2 = 0.0;  ///< of `probability`, from these

    /// Of reaching the last level's threshold.
    [[nodiscard]] double probability() const;
    /// Squared coefficient of variation: the larger of what the chains and the lineages say.
    [[nodiscard]] double variation2() const;
    /// 95 %, of a lognormal with that coefficient, which is known from so many lineages only:
    /// Student's t with as many degrees of freedom less one.
    [[nodiscard]] statistics::Interval interval() const;
    /// Independent runs that would give an interval as narrow.
    [[nodiscard]] double brute_force_runs() const;
};

/// Sets `fall` and `event` of runs that do not depend on each other.
/// @param so_far  levels that are done
/// @return false: stop
using RareJudge = std::function<bool(std::span<RareSample> runs, const SubsetResult& so_far)>;

/// Subset simulation in the space of inputs and noise, both moved by conditional sampling: a
/// proposal stands as far from its parent as makes 44 % of them stay within the level. All chains
/// of a level take their steps together. Depends on the plan and the judge alone.
/// Sources: Au and Beck, Probabilistic Engineering Mechanics 16 (2001) 263; Papaioannou, Betz,
/// Zwirglmaier and Straub, Prob. Eng. Mech. 41 (2015) 89; lineages: Lee and Whiteley, Biometrika
/// 105 (2018) 609.
[[nodiscard]] SubsetResult subset_simulation(const SubsetPlan& plan, const RareJudge& judge);

}  // namespace limpet::rare
