// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/causes/causes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"

namespace limpet::causes {
namespace {

/// A draw and its chance of being flown.
struct Chosen {
    std::size_t set = 0;
    std::size_t draw = 0;
    double chance = 1.0;
    bool explains = false;
};

/// So many draws of all sets: systematic sampling with chances as the square root of the
/// likelihood, by which the error is least, and some for those that the closed form takes for
/// impossible. Source: Cochran, "Sampling techniques", 9A and 5.5 (chances unequal, allocation).
std::vector<Chosen> choose(const CausePosterior& closed, std::size_t draws, RandomStream& random) {
    constexpr double kLeast = 1e-3;  // of a likelihood
    std::vector<Chosen> all;
    double sum = 0.0;
    for (std::size_t set = 0; set < closed.weighted.size(); ++set) {
        for (std::size_t k = 0; k < closed.weighted[set].weights.size(); ++k) {
            all.push_back({set, k, std::sqrt(closed.weighted[set].weights[k] + kLeast)});
            sum += all.back().chance;
        }
    }
    // A chance is 1 at most; what that leaves goes to the others.
    const double wanted = static_cast<double>(std::min(draws, all.size()));
    double scale = wanted / sum;
    for (int i = 0; i < 30; ++i) {
        double reached = 0.0;
        for (const Chosen& one : all) {
            reached += std::min(1.0, scale * one.chance);
        }
        scale *= wanted / reached;
    }
    std::vector<Chosen> chosen;
    double passed = random.uniform();
    for (Chosen& one : all) {
        one.chance = std::min(1.0, scale * one.chance);
        passed += one.chance;
        if (passed >= 1.0) {
            passed -= 1.0;
            chosen.push_back(one);
        }
    }
    return chosen;
}

/// Noise of a draw's flights; the same wherever it is flown.
std::uint32_t run_of(std::size_t draw) {
    return static_cast<std::uint32_t>(3 * draw + 1);
}

}  // namespace

bool explains(const CausePoint& point, const SwingStatement& stated, std::uint32_t run) {
    const auto within = [](double deg, double from, double to) { return deg >= from && deg <= to; };
    return within(flown_swing_deg(kMetalMission, point, run), stated.metal_from_deg,
                  stated.metal_to_deg) &&
           within(flown_swing_deg(kConcreteMission, point, run + 1), stated.concrete_from_deg,
                  stated.concrete_to_deg) &&
           within(flown_swing_deg(kMetalMission, simulated(point), run + 2), 0.0,
                  stated.simulated_to_deg);
}

statistics::Interval FlownCauses::probability_interval(Cause cause) const {
    study::Weighted together;
    for (const study::Weighted& set : posterior.weighted) {
        together.weights.insert(together.weights.end(), set.weights.begin(), set.weights.end());
    }
    return statistics::wilson(posterior.probability(cause), together.effective());
}

FlownCauses fly_chosen(const CausePosterior& closed, const SwingStatement& stated,
                       std::size_t draws, std::uint64_t seed, int jobs,
                       const std::function<void()>& between) {
    RandomStream random(seed, 2, Stream::test);
    std::vector<Chosen> chosen = choose(closed, draws, random);
    for_each_index(chosen.size(), jobs, [&](std::size_t i) {
        if (between) {
            between();
        }
        Chosen& one = chosen[i];
        one.explains = explains((*closed.draws)[one.set][one.draw].point, stated, run_of(one.draw));
    });
    FlownCauses found{.posterior = {.draws = closed.draws, .weighted = closed.weighted},
                      .evidence_errors = {},
                      .shares = std::vector<statistics::Proportion>(closed.weighted.size()),
                      .flown = chosen.size()};
    for (study::Weighted& set : found.posterior.weighted) {
        set.weights.assign(set.weights.size(), 0.0);
    }
    std::vector<double> variances(closed.weighted.size(), 0.0);  // of the sums, by the choice
    for (const Chosen& one : chosen) {
        ++found.shares[one.set].runs;
        if (one.explains) {
            ++found.explaining;
            ++found.shares[one.set].successes;
            found.posterior.weighted[one.set].weights[one.draw] = 1.0 / one.chance;
            variances[one.set] += (1.0 - one.chance) / (one.chance * one.chance);
        }
    }
    for (std::size_t set = 0; set < variances.size(); ++set) {
        const study::Weighted& weighted = found.posterior.weighted[set];
        const auto of = static_cast<double>(weighted.weights.size());
        const double evidence = weighted.evidence();
        found.evidence_errors.push_back(
            std::sqrt(variances[set] / (of * of) + evidence * std::max(0.0, 1.0 - evidence) / of));
    }
    return found;
}

statistics::Proportion fly_plainly(const std::vector<CauseDraw>& set, std::size_t draws,
                                   const SwingStatement& stated, int jobs) {
    std::vector<char> all(std::min(draws, set.size()), 0);
    for_each_index(all.size(), jobs, [&](std::size_t k) {
        all[k] = explains(set[k].point, stated, run_of(k)) ? 1 : 0;
    });
    statistics::Proportion share;
    for (const char one : all) {
        ++share.runs;
        share.successes += one != 0 ? 1 : 0;
    }
    return share;
}

CausePosterior agreeing(const CausePosterior& closed, const CausePosterior& flown) {
    CausePosterior found = closed;
    constexpr int kRounds = 100;  // proportional fitting, each cause in turn
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < kCauses; ++i) {
            const auto cause = static_cast<Cause>(i);
            const double wanted = flown.probability(cause), has = found.probability(cause);
            if (!(has > 0.0 && has < 1.0)) {
                continue;  // nothing left to move
            }
            for (std::size_t set = 0; set < found.weighted.size(); ++set) {
                const double factor =
                    takes_part(set, cause) ? wanted / has : (1.0 - wanted) / (1.0 - has);
                for (double& weight : found.weighted[set].weights) {
                    weight *= factor;
                }
            }
        }
    }
    double all = 0.0, as_flown = 0.0;
    for (std::size_t set = 0; set < found.weighted.size(); ++set) {
        all += found.weighted[set].evidence();
        as_flown += flown.weighted[set].evidence();
    }
    for (study::Weighted& set : found.weighted) {
        for (double& weight : set.weights) {
            weight *= as_flown / all;
        }
    }
    return found;
}

}  // namespace limpet::causes
