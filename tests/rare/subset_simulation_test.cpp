// SPDX-License-Identifier: Apache-2.0
//
// Against probabilities that are known: half spaces of standard normals, and by brute force.
#include "limpet/rare/subset_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace limpet::rare {
namespace {

using Fall = std::function<double(const RarePoint& point)>;

SubsetResult search(const Fall& fall, std::size_t inputs, std::uint64_t seed,
                    std::uint32_t level_runs = 1000) {
    const SubsetPlan plan{.seed = seed, .inputs = inputs, .level_runs = level_runs};
    return subset_simulation(plan, [&](std::span<RareSample> runs, const SubsetResult&) {
        for (RareSample& run : runs) {
            run.fall = fall(run.point);
            run.event = run.fall <= 0.0;
        }
        return true;
    });
}

/// Linear in the inputs: P = Phi(-beta), whatever their number.
Fall half_space(double beta) {
    return [beta](const RarePoint& point) {
        double sum = 0.0;
        for (const double normal : point.normals) {
            sum += normal;
        }
        return beta - sum / std::sqrt(static_cast<double>(point.normals.size()));
    };
}

/// The same of a flight's own random numbers: no input tells anything.
Fall half_space_of_noise(double beta, int draws) {
    return [beta, draws](const RarePoint& point) {
        RandomStream random(1, 0, Stream::test, point.noise);
        double sum = 0.0;
        for (int i = 0; i < draws; ++i) {
            sum += random.normal();
        }
        return beta - sum / std::sqrt(static_cast<double>(draws));
    };
}

struct Repeats {
    double covered = 0.0;  ///< share of the intervals that hold the probability
    double bias = 0.0;     ///< mean estimate over the probability
    double spread = 0.0;   ///< coefficient of variation of the estimates
    double told = 0.0;     ///< root of the mean of what they say of it
};

Repeats repeat(const Fall& fall, std::size_t inputs, double probability, int times,
               std::uint32_t level_runs) {
    Repeats repeats;
    double squares = 0.0;
    for (int i = 0; i < times; ++i) {
        const SubsetResult result = search(fall, inputs, 100 + i, level_runs);
        EXPECT_EQ(result.ending, RareEnding::estimated);
        const statistics::Interval interval = result.interval();
        repeats.covered += interval.low <= probability && probability <= interval.high ? 1.0 : 0.0;
        const double ratio = result.probability() / probability;
        repeats.bias += ratio;
        squares += ratio * ratio;
        repeats.told += result.variation2();
    }
    repeats.covered /= times;
    repeats.bias /= times;
    repeats.spread = std::sqrt(squares / times - repeats.bias * repeats.bias);
    repeats.told = std::sqrt(repeats.told / times);
    return repeats;
}

TEST(SubsetSimulation, IntervalsHoldTheHalfSpacesProbability) {
    struct Case {
        double beta;
        std::size_t inputs;
        std::uint32_t level_runs;
    };
    for (const auto& [beta, inputs, level_runs] :
         {Case{3.719, 2, 500}, Case{4.265, 20, 300}, Case{5.199, 5, 500}}) {
        const double probability = normal_probability(-beta);  // 1e-4, 1e-5, 1e-7
        const Repeats repeats = repeat(half_space(beta), inputs, probability, 50, level_runs);
        EXPECT_GE(repeats.covered, 0.90) << beta << " " << inputs;
        EXPECT_NEAR(repeats.bias, 1.0, 0.25) << beta << " " << inputs;
        EXPECT_LT(repeats.spread, 1.0) << beta << " " << inputs;
        EXPECT_GT(repeats.told, 0.7 * repeats.spread) << beta << " " << inputs;
        EXPECT_LT(repeats.told, 1.5 * repeats.spread) << beta << " " << inputs;
    }
}

TEST(SubsetSimulation, NoiseAloneLeadsToTheEventAsWell) {
    const Repeats repeats =
        repeat(half_space_of_noise(4.265, 3), 0, normal_probability(-4.265), 20, 500);
    EXPECT_GE(repeats.covered, 0.9);
    EXPECT_NEAR(repeats.bias, 1.0, 0.5);
}

/// Two ways into the event, one through inputs, one through noise.
TEST(SubsetSimulation, AgreesWithBruteForce) {
    const Fall fall = [](const RarePoint& point) {
        RandomStream random(1, 0, Stream::test, point.noise);
        const double x = point.normals[0];
        const double y = point.normals[1];
        return 9.5 - std::max(x * x + 0.5 * x * y, 2.0 * std::abs(y) + 1.5 * random.normal());
    };
    int events = 0;
    constexpr int kBrute = 200'000;
    for (int i = 0; i < kBrute; ++i) {
        RandomStream random(77, static_cast<std::uint32_t>(i), Stream::test);
        RarePoint point;
        point.normals = {random.normal(), random.normal()};
        point.noise = {{static_cast<std::uint64_t>(i), 1.0}};
        events += fall(point) <= 0.0 ? 1 : 0;
    }
    const statistics::Interval brute =
        statistics::Proportion{static_cast<std::uint32_t>(events), kBrute}.interval();
    EXPECT_GT(events, 100);
    const SubsetResult result = search(fall, 2, 5, 2000);
    EXPECT_LT(result.interval().low, brute.high);
    EXPECT_GT(result.interval().high, brute.low);
    EXPECT_LT(result.interval().high / result.interval().low, 3.0);
    EXPECT_LT(result.runs, 10'000U);
}

TEST(SubsetSimulation, ASingleLevelIsACount) {
    const SubsetResult result = search(half_space(0.5), 1, 3);
    ASSERT_EQ(result.levels.size(), 1U);
    const double p = result.probability();
    EXPECT_NEAR(p, normal_probability(-0.5), 0.04);
    EXPECT_NEAR(result.variation2(), (1.0 - p) / (p * 1000.0), 1e-4);
    EXPECT_NEAR(result.brute_force_runs(), 1000.0, 10.0);
    EXPECT_EQ(result.runs, 1000U);
}

TEST(SubsetSimulation, SaysWhatItFlewAndFound) {
    const SubsetResult result = search(half_space(4.0), 3, 1);
    ASSERT_EQ(result.levels.size(), 5U);
    EXPECT_EQ(result.runs, 1000U + 4U * 900U);
    for (std::size_t i = 0; i + 1 < result.levels.size(); ++i) {
        EXPECT_EQ(result.levels[i].reached, 100U);
        EXPECT_GT(result.levels[i].threshold, result.levels[i + 1].threshold);
    }
    EXPECT_NEAR(result.levels.back().acceptance, 0.44, 0.1);
    EXPECT_NEAR(result.likeliest_distance, 4.0, 0.3);  // the half space is as far away
    // Brute force needs (1 - p) / (p cov^2).
    EXPECT_GT(result.brute_force_runs(), 20.0 * result.runs);
    double last = 2.0;
    for (const RarePlace& place : result.curve) {
        const double known = normal_probability(place.fall - 4.0);
        EXPECT_LT(place.probability, last);
        EXPECT_LE(place.interval().low, 1.5 * known);
        EXPECT_GE(place.interval().high, known / 1.5);
        last = place.probability;
    }
    EXPECT_LT(last, 2e-5);
}

TEST(SubsetSimulation, ThePlanAloneDecides) {
    const SubsetResult one = search(half_space(4.0), 3, 1);
    EXPECT_EQ(one.probability(), search(half_space(4.0), 3, 1).probability());
    EXPECT_NE(one.probability(), search(half_space(4.0), 3, 2).probability());
}

/// What cannot be reached, and what gives nothing to go by.
TEST(SubsetSimulation, SaysWhenThereIsNoEstimate) {
    EXPECT_EQ(search(half_space(9.0), 2, 1, 200).ending, RareEnding::too_rare);
    EXPECT_EQ(search([](const RarePoint&) { return 1.0; }, 2, 1, 200).ending, RareEnding::stuck);
    const double none = std::numeric_limits<double>::infinity();
    EXPECT_EQ(search([&](const RarePoint&) { return none; }, 2, 1, 200).ending, RareEnding::stuck);
    EXPECT_TRUE(search([&](const RarePoint&) { return none; }, 2, 1, 200).curve.empty());
}

/// A figure that half of the flights do not have, and one that falls in stairs.
TEST(SubsetSimulation, GoesOnOverPlateaus) {
    const double none = std::numeric_limits<double>::infinity();
    const Fall sparse = [&](const RarePoint& point) {
        return point.normals[0] < 1.645 ? none : half_space(3.0)({{point.normals[1]}, {}});
    };
    const SubsetResult result = search(sparse, 2, 1);
    EXPECT_EQ(result.ending, RareEnding::estimated);
    const double known = normal_probability(-1.645) * normal_probability(-3.0);
    EXPECT_LT(result.interval().low, known);
    EXPECT_GT(result.interval().high, known);
    const Fall stairs = [](const RarePoint& point) {
        return std::ceil(std::max(0.0, half_space(4.0)(point)));
    };
    const SubsetResult stepped = search(stairs, 1, 1);
    EXPECT_LT(stepped.interval().low, normal_probability(-4.0));
    EXPECT_GT(stepped.interval().high, normal_probability(-4.0));
}

/// An event that its figure knows nothing of: few of level 0 are its ancestors, and the interval
/// says so.
TEST(SubsetSimulation, AFigureThatDoesNotLeadThereWidensTheInterval) {
    int covered = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const SubsetPlan plan{.seed = seed, .inputs = 2, .level_runs = 1000};
        const SubsetResult result =
            subset_simulation(plan, [](std::span<RareSample> runs, const SubsetResult&) {
                for (RareSample& run : runs) {
                    run.event = run.point.normals[1] > 2.75;  // 3e-3
                    run.fall = run.event ? -std::numeric_limits<double>::infinity()
                                         : -run.point.normals[0];
                }
                return true;
            });
        ASSERT_EQ(result.ending, RareEnding::estimated);
        EXPECT_LT(result.lineages, 15.0);
        const statistics::Interval interval = result.interval();
        covered +=
            interval.low < normal_probability(-2.75) && normal_probability(-2.75) < interval.high;
    }
    EXPECT_GE(covered, 18);
}

TEST(SubsetSimulation, StopsWhenTheJudgeDoes) {
    int asked = 0;
    const SubsetResult result =
        subset_simulation({.seed = 1, .inputs = 1}, [&](std::span<RareSample> runs, const auto&) {
            std::set<std::uint32_t> numbers;
            for (RareSample& run : runs) {
                run.fall = 5.0 - run.point.normals[0];
                numbers.insert(run.run);
            }
            EXPECT_EQ(numbers.size(), runs.size());
            return ++asked < 5;
        });
    EXPECT_EQ(asked, 5);
    EXPECT_EQ(result.ending, RareEnding::stopped);
    EXPECT_EQ(result.levels.size(), 1U);
}

}  // namespace
}  // namespace limpet::rare
