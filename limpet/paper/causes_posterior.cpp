// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/campaign/statistics.hpp"
#include "limpet/paper/cause_places.hpp"
#include "limpet/paper/causes.hpp"

namespace limpet::paper {
namespace {

/// That a lognormal with this middle lies between two ends.
double probability_between(double middle, double scatter, double from, double to) {
    return normal_probability(std::log(to / middle) / scatter) -
           normal_probability(std::log(from / middle) / scatter);
}

double likelihood(const SwingSurrogate& swing, const SwingSize& size, const SwingSaid& said,
                  const CausePoint& point, double growth_1_s, double frequency_Hz) {
    const double missed = swing.growth_1_s.left_out_rms();  // by the surrogate
    const double metal = swing_deg(size, point, growth_1_s, frequency_Hz, kMetalWait_s);
    const double concrete = swing_deg(size, point, growth_1_s, frequency_Hz, kConcreteWait_s);
    // The paper's simulation: the same arm, gains and joint, Gazebo's motors in still air, and of
    // the dead time what the autopilot brings with it.
    CausePoint simulated = point;
    const CausePoint gazebo = as_simulated();
    for (const Eigen::Index i : {kLag, kRatio, kMoment}) {
        simulated[i] = gazebo[i];
    }
    simulated[kDelay] *= point[kShared];
    const double still = swing_deg(size, simulated, swing.growth_1_s(simulated.head(kOfLoop)),
                                   swing.frequency_Hz(simulated.head(kOfLoop)), kMetalWait_s);
    const double scatter = std::hypot(size.metal_scatter, missed * kMetalWait_s);
    return probability_between(metal, scatter, said.metal_from_deg, said.metal_to_deg) *
           probability_between(concrete, size.concrete_scatter, said.concrete_from_deg,
                               said.concrete_to_deg) *
           normal_probability(std::log(said.simulated_to_deg / still) / scatter);
}

}  // namespace

std::vector<double> CausePosterior::subset_probabilities() const {
    std::vector<double> all;
    double sum = 0.0;
    for (const SubsetDraws& draws : subsets) {
        all.push_back(draws.weighted.evidence());
        sum += all.back();
    }
    for (double& one : all) {
        one /= sum;
    }
    return all;
}

double CausePosterior::probability(Cause cause) const {
    const std::vector<double> all = subset_probabilities();
    double sum = 0.0;
    for (std::size_t subset = 0; subset < all.size(); ++subset) {
        sum += takes_part(subset, cause) ? all[subset] : 0.0;
    }
    return sum;
}

double CausePosterior::quantile(
    const std::function<double(const SubsetDraws& draws, std::size_t k)>& of, double share) const {
    study::Weighted together;
    std::vector<double> values;
    for (const SubsetDraws& draws : subsets) {
        for (std::size_t k = 0; k < draws.points.size(); ++k) {
            together.weights.push_back(draws.weighted.weights[k]);
            values.push_back(of(draws, k));
        }
    }
    return together.quantile(values, share);
}

CausePosterior weigh(const SwingSurrogate& swing, const SwingSize& size, const SwingSaid& said,
                     std::size_t draws, std::uint64_t seed) {
    CausePosterior posterior;
    for (std::size_t subset = 0; subset < (1U << kCauses); ++subset) {
        SubsetDraws& own = posterior.subsets.emplace_back();
        for (std::size_t k = 0; k < draws; ++k) {
            RandomStream random(seed, static_cast<std::uint32_t>(k), Stream::scenario);
            own.points.push_back(draw_point(subset, random));
            const CausePoint& point = own.points.back();
            own.growth_1_s.push_back(swing.growth_1_s(point.head(kOfLoop)));
            own.frequency_Hz.push_back(swing.frequency_Hz(point.head(kOfLoop)));
            own.weighted.weights.push_back(likelihood(
                swing, size, said, point, own.growth_1_s.back(), own.frequency_Hz.back()));
        }
    }
    return posterior;
}

std::vector<CauseMeasurement> measurements(const SwingSurrogate& swing,
                                           const CausePosterior& posterior, std::uint64_t seed) {
    struct Shown {
        const char* name;
        const char* accuracy;
        double deviation;
        std::function<double(const SubsetDraws&, std::size_t)> of;
    };
    const auto input = [](Eigen::Index i) {
        return [i](const SubsetDraws& draws, std::size_t k) { return draws.points[k][i]; };
    };
    const std::vector<Shown> shown = {
        {"growth of the swing, from its log", "0.02 1/s", 0.02,
         [](const SubsetDraws& draws, std::size_t k) { return draws.growth_1_s[k]; }},
        {"frequency of the swing, from its log", "0.02 Hz", 0.02,
         [](const SubsetDraws& draws, std::size_t k) { return draws.frequency_Hz[k]; }},
        {"growth with the rate integrator off", "0.02 1/s", 0.02,
         [&swing](const SubsetDraws& draws, std::size_t k) {
             CausePoint off = draws.points[k];
             off[kRateI] = 0.0;
             return swing.growth_1_s(off.head(kOfLoop));
         }},
        {"step response of a motor on the stand", "2 ms", 0.002, input(kLag)},
        {"dead time, from gyro and actuator records", "2 ms", 0.002, input(kDelay)},
        {"place of the joint, by a ruler", "5 mm", 0.005, input(kJointX)},
        {"inertia, hung up and swung", "0.003 kg m2", 0.003, input(kInertia)},
        {"rate gains that flew", "1 %", 0.01, input(kRateK)},
        {"slider's stiffness, by a scale", "20 N/m", 20.0, input(kStiffness)},
        {"moment of the air at the wall, on a stand", "0.01 N m", 0.01, input(kMoment)},
    };
    constexpr std::size_t kBins = 24;
    std::vector<CauseMeasurement> all;
    for (const Shown& one : shown) {
        RandomStream random(seed, 1, Stream::test);
        std::vector<std::size_t> kinds;
        std::vector<double> measured, blind, weights;
        for (std::size_t subset = 0; subset < posterior.subsets.size(); ++subset) {
            const SubsetDraws& draws = posterior.subsets[subset];
            for (std::size_t k = 0; k < draws.points.size(); ++k) {
                kinds.push_back(subset);
                measured.push_back(one.of(draws, k) + one.deviation * random.normal());
                blind.push_back(random.uniform());
                weights.push_back(draws.weighted.weights[k]);
            }
        }
        // What draws so few and so weighted tell by chance alone is taken off.
        const double bits = study::information_bits(kinds, measured, weights, kBins) -
                            study::information_bits(kinds, blind, weights, kBins);
        all.push_back({one.name, one.accuracy, std::max(0.0, bits)});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.bits > b.bits; });
    return all;
}

}  // namespace limpet::paper
