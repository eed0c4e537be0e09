// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/causes/causes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/statistics/shares.hpp"

namespace limpet::causes {
namespace {

constexpr std::size_t kSets = 1U << kCauses;

std::size_t bit(Cause cause) {
    return std::size_t{1} << static_cast<std::size_t>(cause);
}

double likelihood(const CauseDraw& draw, const SwingSize& size, const SwingStatement& stated) {
    if (!draw.swing.rests || !draw.simulated.rests) {
        return 0.0;  // both waited
    }
    const auto of = [&](const WaitSize& wait, const CausePoint& point, const PointSwing& swing,
                        double waited_s) { return expected_swing(wait, point, swing, waited_s); };
    return of(size.metal, draw.point, draw.swing, kMetalWait_s)
               .probability(stated.metal_from_deg, stated.metal_to_deg) *
           of(size.concrete, draw.point, draw.swing, kConcreteWait_s)
               .probability(stated.concrete_from_deg, stated.concrete_to_deg) *
           of(size.metal, simulated(draw.point), draw.simulated, kMetalWait_s)
               .probability(0.0, stated.simulated_to_deg);
}

}  // namespace

CausePoint simulated(CausePoint point) {
    const CausePoint gazebo = as_simulated();
    for (const Eigen::Index i : {kLag, kRatio, kMoment}) {
        point[i] = gazebo[i];
    }
    point[kDelay] *= point[kShared];
    return point;
}

PriorDraws draw_prior(std::size_t draws, std::uint64_t seed, int jobs,
                      const std::function<void()>& between) {
    PriorDraws all(kSets, std::vector<CauseDraw>(draws));
    const auto draw_of = [&](std::size_t i) -> CauseDraw& { return all[i / draws][i % draws]; };
    for_each_index(kSets * draws, jobs, [&](std::size_t i) {
        RandomStream random(seed, static_cast<std::uint32_t>(i % draws), Stream::scenario);
        draw_of(i).point = draw_point(i / draws, random);
    });
    // The air moves the vehicle and not its loop, the simulation has neither air nor slow motors: a
    // set has the swings of the one without them.
    const auto without = [draws](std::size_t i, std::size_t causes) { return i / draws & ~causes; };
    const std::size_t air = bit(Cause::wall_air), real = air | bit(Cause::motors);
    for_each_index(kSets * draws, jobs, [&](std::size_t i) {
        if (between) {
            between();
        }
        CauseDraw& own = draw_of(i);
        if (without(i, air) == i / draws) {
            own.swing = swing_of(own.point);
        }
        if (without(i, real) == i / draws) {
            own.simulated = swing_of(simulated(own.point));
        }
    });
    for (std::size_t i = 0; i < kSets * draws; ++i) {
        draw_of(i).swing = all[without(i, air)][i % draws].swing;
        draw_of(i).simulated = all[without(i, real)][i % draws].simulated;
    }
    return all;
}

std::vector<double> CausePosterior::set_probabilities() const {
    std::vector<double> all;
    double sum = 0.0;
    for (const study::Weighted& one : weighted) {
        all.push_back(one.evidence());
        sum += all.back();
    }
    require(sum > 0.0, "draws that explain something of the statements");
    for (double& one : all) {
        one /= sum;
    }
    return all;
}

double CausePosterior::probability(Cause cause) const {
    const std::vector<double> all = set_probabilities();
    double sum = 0.0;
    for (std::size_t set = 0; set < all.size(); ++set) {
        sum += takes_part(set, cause) ? all[set] : 0.0;
    }
    return sum;
}

double CausePosterior::quantile(const std::function<double(const CauseDraw&)>& of,
                                double share) const {
    study::Weighted together;
    std::vector<double> values;
    for (std::size_t set = 0; set < weighted.size(); ++set) {
        for (std::size_t k = 0; k < weighted[set].weights.size(); ++k) {
            together.weights.push_back(weighted[set].weights[k]);
            values.push_back(of((*draws)[set][k]));
        }
    }
    return together.quantile(values, share);
}

CausePosterior weigh(const PriorDraws& draws, const SwingSize& size, const SwingStatement& stated) {
    CausePosterior posterior{.draws = &draws, .weighted = {}};
    for (const std::vector<CauseDraw>& set : draws) {
        study::Weighted& own = posterior.weighted.emplace_back();
        for (const CauseDraw& draw : set) {
            own.weights.push_back(likelihood(draw, size, stated));
        }
    }
    return posterior;
}

std::vector<CauseMeasurement> measurements(const CausePosterior& posterior, std::uint64_t seed,
                                           int jobs) {
    // Those that explain something; the others hardly count and are many.
    constexpr double kHardly = 1e-3;
    double most = 0.0;
    for (const study::Weighted& one : posterior.weighted) {
        most = std::max(most, *std::max_element(one.weights.begin(), one.weights.end()));
    }
    std::vector<const CauseDraw*> counted;
    std::vector<std::size_t> sets;
    std::vector<double> weights;
    for (std::size_t set = 0; set < posterior.weighted.size(); ++set) {
        for (std::size_t k = 0; k < posterior.weighted[set].weights.size(); ++k) {
            if (posterior.weighted[set].weights[k] > kHardly * most) {
                counted.push_back(&(*posterior.draws)[set][k]);
                sets.push_back(set);
                weights.push_back(posterior.weighted[set].weights[k]);
            }
        }
    }
    std::vector<double> without_integrator(counted.size());
    for_each_index(counted.size(), jobs, [&](std::size_t i) {
        CausePoint off = counted[i]->point;
        off[kRateI] = 0.0;
        without_integrator[i] = swing_of(off).growth_1_s;
    });

    struct Shown {
        const char* name;
        const char* accuracy;
        double deviation;
        std::function<double(std::size_t i)> of;
    };
    const auto input = [&counted](Eigen::Index place) {
        return [&counted, place](std::size_t i) { return counted[i]->point[place]; };
    };
    const std::vector<Shown> shown = {
        {"growth of the swing, from its log", "0.02 1/s", 0.02,
         [&](std::size_t i) { return counted[i]->swing.growth_1_s; }},
        {"frequency of the swing, from its log", "0.02 Hz", 0.02,
         [&](std::size_t i) { return counted[i]->swing.frequency_Hz; }},
        {"growth with the rate integrator off", "0.02 1/s", 0.02,
         [&](std::size_t i) { return without_integrator[i]; }},
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
        std::vector<double> measured, blind;
        for (std::size_t i = 0; i < counted.size(); ++i) {
            measured.push_back(one.of(i) + one.deviation * random.normal());
            blind.push_back(random.uniform());
        }
        // Less what so few, weighted draws give by chance alone.
        const double bits = study::information_bits(sets, measured, weights, kBins) -
                            study::information_bits(sets, blind, weights, kBins);
        all.push_back({one.name, one.accuracy, std::max(0.0, bits)});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.bits > b.bits; });
    return all;
}

}  // namespace limpet::causes
