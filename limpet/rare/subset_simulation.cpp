// SPDX-License-Identifier: Apache-2.0
#include "limpet/rare/subset_simulation.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::rare {
namespace {

constexpr double kFirstStep = 0.6;          ///< Papaioannou et al.
constexpr double kWantedAcceptance = 0.44;  ///< likewise
constexpr double kLongestStep = 10.0;
constexpr std::uint32_t kFewestSeeds = 10;
constexpr std::uint32_t kFewestInTail = 5;  ///< of the samples, at the end of the curve
constexpr double kNextPlace = 0.75;         ///< of the curve: its share of the last one's samples

using Chain = std::vector<RareSample>;
using Chains = std::vector<Chain>;

RareSample first_sample(const SubsetPlan& plan, std::uint32_t run) {
    RandomStream random(plan.seed, run, Stream::scenario);
    RareSample sample;
    sample.run = sample.parent = sample.ancestor = sample.chain = run;
    sample.point.noise = {{campaign::noise_seed(random), 1.0}};
    for (std::size_t i = 0; i < plan.inputs; ++i) {
        sample.point.normals.push_back(random.normal());
    }
    return sample;
}

/// Reversible with respect to independent standard normals, the noise's among them.
RarePoint near(const RarePoint& point, const std::vector<double>& spread, double step,
               RandomStream& random) {
    const auto keeps = [](double moves) { return std::sqrt(1.0 - moves * moves); };
    RarePoint next = point;
    const double noise_moves = std::min(1.0, step);
    for (NoiseTerm& term : next.noise) {
        term.weight *= keeps(noise_moves);
    }
    if (noise_moves == 1.0) {
        next.noise.clear();
    }
    next.noise.push_back({campaign::noise_seed(random), noise_moves});
    for (std::size_t i = 0; i < spread.size(); ++i) {
        const double moves = std::min(1.0, step * spread[i]);
        next.normals[i] = keeps(moves) * next.normals[i] + moves * random.normal();
    }
    return next;
}

/// Standard deviation of each input among the seeds.
std::vector<double> spread_of(const Chains& chains, std::size_t inputs) {
    std::vector<double> spread;
    for (std::size_t i = 0; i < inputs; ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const Chain& chain : chains) {
            const double x = chain.front().point.normals[i];
            sum += x;
            squares += x * x;
        }
        const auto n = static_cast<double>(chains.size());
        spread.push_back(std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1.0))));
    }
    return spread;
}

template <class Each>
void for_each_sample(const Chains& chains, const Each& each) {
    for (const Chain& chain : chains) {
        for (const RareSample& sample : chain) {
            each(sample);
        }
    }
}

/// Squared coefficient of variation of the share of samples that reach something, with their
/// correlation along the chains (Au and Beck, eqs. 27 to 29, all lags at once: twice the products
/// of a chain's pairs are the square of its sum less its squares).
template <class Reaches>
double variation2_of(const Chains& chains, const Reaches& reaches) {
    double samples = 0.0;
    double reached = 0.0;
    for_each_sample(chains, [&](const RareSample& sample) {
        samples += 1.0;
        reached += reaches(sample) ? 1.0 : 0.0;
    });
    const double p = reached / samples;
    if (p >= 1.0) {
        return 0.0;
    }
    double pairs = 0.0;
    for (const Chain& chain : chains) {
        double sum = 0.0;
        double squares = 0.0;
        for (const RareSample& sample : chain) {
            const double off = (reaches(sample) ? 1.0 : 0.0) - p;
            sum += off;
            squares += off * off;
        }
        pairs += sum * sum - squares;
    }
    const double gamma = std::max(0.0, pairs / (samples * p * (1.0 - p)));
    return (1.0 - p) / (p * samples) * (1.0 + gamma);
}

/// One search, level by level.
class Search {
public:
    Search(const SubsetPlan& plan, const RareJudge& judge) : plan_(plan), judge_(judge) {
        require(plan.level_runs * plan.level_share >= kFewestSeeds, "a level has enough seeds");
    }

    SubsetResult run() {
        result_.ending = search();
        return std::move(result_);
    }

private:
    RareEnding search() {
        if (!draw_first()) {
            return RareEnding::stopped;
        }
        while (true) {
            const bool at_event = conclude_level();
            const SubsetLevel& level = result_.levels.back();
            if (level.reached < kFewestSeeds) {
                return RareEnding::stuck;
            }
            if (at_event) {
                return RareEnding::estimated;
            }
            if (result_.probability() < plan_.least) {
                return RareEnding::too_rare;
            }
            if (!draw_next(level.threshold)) {
                return RareEnding::stopped;
            }
        }
    }

    bool judge(std::vector<RareSample>& runs) {
        if (!judge_(runs, result_)) {
            return false;
        }
        for (const RareSample& run : runs) {
            ++result_.runs;
            if (run.event) {
                ++result_.events;
                if (const double distance = run.point.distance();
                    distance < result_.likeliest_distance) {
                    result_.likeliest = run.run;
                    result_.likeliest_distance = distance;
                }
            }
        }
        return true;
    }

    bool draw_first() {
        std::vector<RareSample> runs;
        while (runs.size() < plan_.level_runs) {
            runs.push_back(first_sample(plan_, static_cast<std::uint32_t>(runs.size())));
        }
        if (!judge(runs)) {
            return false;
        }
        for (RareSample& run : runs) {
            chains_.push_back({std::move(run)});
        }
        return true;
    }

    /// Chains from all that reached the threshold; together as many samples as ever.
    bool draw_next(double threshold) {
        Chains chains;
        for_each_sample(chains_, [&](const RareSample& sample) {
            if (sample.fall <= threshold) {
                RareSample& seed = chains.emplace_back().emplace_back(sample);
                seed.chain = static_cast<std::uint32_t>(chains.size() - 1);
            }
        });
        chains_ = std::move(chains);
        const std::vector<double> spread = spread_of(chains_, plan_.inputs);
        const std::size_t level = result_.levels.size();
        std::size_t samples = chains_.size();
        double accepted = 0.0;
        double proposed = 0.0;
        for (int step = 1; samples < plan_.level_runs; ++step) {
            const std::size_t moving =
                std::min<std::size_t>(chains_.size(), plan_.level_runs - samples);
            std::vector<RareSample> runs;
            for (std::size_t i = 0; i < moving; ++i) {
                const RareSample& parent = chains_[i].back();
                RareSample& next = runs.emplace_back();
                next.run = result_.runs + static_cast<std::uint32_t>(i);
                next.level = static_cast<std::uint32_t>(level);
                next.chain = parent.chain;
                next.parent = parent.run;
                next.ancestor = parent.ancestor;
                RandomStream random(plan_.seed, next.run, Stream::scenario);
                next.point = near(parent.point, spread, step_, random);
            }
            if (!judge(runs)) {
                return false;
            }
            double stayed = 0.0;
            for (std::size_t i = 0; i < moving; ++i) {
                const bool stays = runs[i].fall <= threshold;
                stayed += stays ? 1.0 : 0.0;
                chains_[i].push_back(stays ? std::move(runs[i]) : chains_[i].back());
            }
            samples += moving;
            accepted += stayed;
            proposed += static_cast<double>(moving);
            step_ = std::min(kLongestStep, step_ * std::exp((stayed / static_cast<double>(moving) -
                                                             kWantedAcceptance) /
                                                            std::sqrt(step)));
        }
        acceptance_ = proposed > 0.0 ? accepted / proposed : kNaN;
        return true;
    }

    /// Chooses the threshold. @return whether it is the event's
    bool conclude_level() {
        const double last = result_.levels.empty() ? std::numeric_limits<double>::infinity()
                                                   : result_.levels.back().threshold;
        std::vector<double> falls;
        std::uint32_t events = 0;
        for_each_sample(chains_, [&](const RareSample& sample) {
            falls.push_back(sample.fall);
            events += sample.event ? 1U : 0U;
        });
        std::sort(falls.begin(), falls.end());
        const auto wanted =
            static_cast<std::uint32_t>(std::ceil(plan_.level_share * plan_.level_runs));
        double threshold = falls[wanted - 1];
        if (!(threshold < last)) {  // a plateau: whatever lies below it
            const auto above = std::lower_bound(falls.begin(), falls.end(), last);
            threshold =
                above == falls.begin() ? -std::numeric_limits<double>::infinity() : above[-1];
        }
        const auto below = static_cast<std::uint32_t>(
            std::upper_bound(falls.begin(), falls.end(), threshold) - falls.begin());
        const bool at_event = events >= wanted || (events > 0 && events >= below);
        const auto reaches = [&](const RareSample& sample) {
            return at_event ? sample.event : sample.fall <= threshold;
        };
        SubsetLevel level{.threshold = at_event ? highest_event() : threshold,
                          .samples = plan_.level_runs,
                          .reached = at_event ? events : below,
                          .variation2 = 0.0,
                          .acceptance = result_.levels.empty() ? kNaN : acceptance_,
                          .step = result_.levels.empty() ? kNaN : step_};
        if (level.reached > 0) {
            level.variation2 = variation2_of(chains_, reaches);
            follow_lineages(reaches);
        }
        add_curve(falls, at_event ? kFewestInTail : std::max(below, kFewestInTail));
        result_.levels.push_back(level);
        return at_event;
    }

    [[nodiscard]] double highest_event() const {
        double highest = -std::numeric_limits<double>::infinity();
        for_each_sample(chains_, [&](const RareSample& sample) {
            highest = sample.event ? std::max(highest, sample.fall) : highest;
        });
        return highest;
    }

    /// Lee and Whiteley's estimate of the relative variance of a product of shares: that two of
    /// those that reached it descend from the same run of level 0.
    template <class Reaches>
    void follow_lineages(const Reaches& reaches) {
        std::map<std::uint32_t, double> counts;
        double reached = 0.0;
        for_each_sample(chains_, [&](const RareSample& sample) {
            if (reaches(sample)) {
                counts[sample.ancestor] += 1.0;
                reached += 1.0;
            }
        });
        double alike = 0.0;
        for (const auto& [ancestor, count] : counts) {
            alike += (count / reached) * (count / reached);
        }
        const double n = plan_.level_runs;
        const double more =
            std::pow(n / (n - 1.0), static_cast<double>(result_.levels.size()) + 1.0);
        result_.lineages = 1.0 / alike;
        result_.lineage_variation2 = std::max(0.0, 1.0 - more * (1.0 - alike));
    }

    /// Places of the level's samples, down to the last that count.
    void add_curve(const std::vector<double>& falls, std::uint32_t last) {
        const double before = result_.probability();
        double variation2 = 0.0;
        for (const SubsetLevel& level : result_.levels) {
            variation2 += level.variation2;
        }
        const double n = static_cast<double>(falls.size());
        for (std::size_t rank = falls.size(); rank >= last;
             rank = static_cast<std::size_t>(static_cast<double>(rank) * kNextPlace)) {
            const double fall = falls[rank - 1];
            if (!std::isfinite(fall) ||
                (!result_.curve.empty() && fall >= result_.curve.back().fall)) {
                continue;
            }
            const auto reaches = [fall](const RareSample& sample) { return sample.fall <= fall; };
            const auto below = std::upper_bound(falls.begin(), falls.end(), fall) - falls.begin();
            result_.curve.push_back({fall, before * static_cast<double>(below) / n,
                                     variation2 + variation2_of(chains_, reaches)});
        }
    }

    const SubsetPlan& plan_;
    const RareJudge& judge_;
    SubsetResult result_;
    Chains chains_;
    double step_ = kFirstStep;
    double acceptance_ = kNaN;
};

statistics::Interval lognormal_interval(double probability, double variation2,
                                        double quantile = statistics::kNormal95) {
    const double factor = std::exp(quantile * std::sqrt(std::log1p(variation2)));
    return {probability / factor, std::min(1.0, probability * factor)};
}

}  // namespace

double RarePoint::distance() const {
    double squares = 0.0;
    for (const double normal : normals) {
        squares += normal * normal;
    }
    return std::sqrt(squares);
}

statistics::Interval RarePlace::interval() const {
    return lognormal_interval(probability, variation2);
}

double SubsetResult::probability() const {
    double probability = 1.0;
    for (const SubsetLevel& level : levels) {
        probability *= level.share();
    }
    return probability;
}

double SubsetResult::variation2() const {
    double sum = 0.0;
    for (const SubsetLevel& level : levels) {
        sum += level.variation2;
    }
    return std::max(sum, lineage_variation2);
}

statistics::Interval SubsetResult::interval() const {
    const boost::math::students_t t(std::max(1.0, lineages - 1.0));
    return lognormal_interval(probability(), variation2(), boost::math::quantile(t, 0.975));
}

double SubsetResult::brute_force_runs() const {
    const double p = probability();
    return (1.0 - p) / (p * variation2());
}

SubsetResult subset_simulation(const SubsetPlan& plan, const RareJudge& judge) {
    return Search(plan, judge).run();
}

}  // namespace limpet::rare
