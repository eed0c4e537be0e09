// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "limpet/statistics/shares.hpp"

namespace limpet::campaign {
namespace {

constexpr std::uint32_t kDraws = 20'000;

VariedKey key_of(Spread spread, double first, double second) {
    VariedKey key;
    key.spread = spread;
    key.first = first;
    key.second = second;
    return key;
}

VariedKey list_of(Spread spread, std::vector<SampledValue> values) {
    VariedKey key;
    key.spread = spread;
    key.values = std::move(values);
    return key;
}

std::vector<double> numbers(const VariedKey& key) {
    std::vector<double> values;
    for (std::uint32_t run = 0; run < kDraws; ++run) {
        values.push_back(std::get<double>(draw({key}, 11, run).front()));
    }
    std::sort(values.begin(), values.end());
    return values;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
    const double mean = mean_of(values);
    double sum = 0.0;
    for (const double value : values) {
        sum += (value - mean) * (value - mean);
    }
    return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(Sampling, UniformFillsItsEnds) {
    const auto values = numbers(key_of(Spread::uniform, 2.0, 5.0));
    EXPECT_GE(values.front(), 2.0);
    EXPECT_LT(values.back(), 5.0);
    // Standard error of the mean: 3 / sqrt(12 n) = 0.006.
    EXPECT_NEAR(mean_of(values), 3.5, 0.025);
    EXPECT_NEAR(deviation_of(values), 3.0 / std::sqrt(12.0), 0.02);
}

TEST(Sampling, NormalHasItsMeanAndSigma) {
    const auto values = numbers(key_of(Spread::normal, -1.0, 0.5));
    EXPECT_NEAR(mean_of(values), -1.0, 4.0 * 0.5 / std::sqrt(kDraws));
    EXPECT_NEAR(deviation_of(values), 0.5, 0.012);
    EXPECT_NEAR(statistics::quantile(values, 0.975), -1.0 + statistics::kNormal95 * 0.5, 0.03);
}

TEST(Sampling, LognormalHasItsMedianAndSigmaOfTheLogarithm) {
    const auto values = numbers(key_of(Spread::lognormal, 28.0, 0.3));
    EXPECT_GT(values.front(), 0.0);
    EXPECT_NEAR(statistics::quantile(values, 0.5), 28.0, 0.4);
    // e^(0.3 * 1.0) up: the 84.13 % quantile.
    EXPECT_NEAR(statistics::quantile(values, 0.841345), 28.0 * std::exp(0.3), 0.7);
}

TEST(Sampling, BoundsCutTheTailsOff) {
    VariedKey key = key_of(Spread::normal, 0.0, 1.0);
    key.from = -1.0;
    key.to = 1.0;
    const auto values = numbers(key);
    EXPECT_GE(values.front(), -1.0);
    EXPECT_LE(values.back(), 1.0);
    EXPECT_NEAR(share_within(key), 0.682689, 1e-6);
    // Standard deviation of a normal cut at one sigma: 0.5396.
    EXPECT_NEAR(deviation_of(values), 0.5396, 0.01);
}

TEST(Sampling, ShareOfALognormalWithinBounds) {
    VariedKey key = key_of(Spread::lognormal, 2.0, 0.5);
    EXPECT_DOUBLE_EQ(share_within(key), 1.0);
    key.to = 2.0;
    EXPECT_NEAR(share_within(key), 0.5, 1e-12);
    key.to = 0.0;
    EXPECT_EQ(share_within(key), 0.0);
}

TEST(Sampling, ChoiceTakesAllAlike) {
    std::map<std::string, int> counts;
    const VariedKey key = list_of(Spread::choice, {"a", "b", "c"});
    for (std::uint32_t run = 0; run < kDraws; ++run) {
        ++counts[std::get<std::string>(draw({key}, 5, run).front())];
    }
    ASSERT_EQ(counts.size(), 3U);
    for (const auto& [name, count] : counts) {
        EXPECT_NEAR(count, kDraws / 3.0, 4.0 * std::sqrt(kDraws * 2.0 / 9.0)) << name;
    }
}

TEST(Sampling, GridsMultiplyAndTheLastChangesFastest) {
    const std::vector<VariedKey> keys = {list_of(Spread::grid, {1.0, 2.0}),
                                         key_of(Spread::uniform, 0.0, 1.0),
                                         list_of(Spread::grid, {"a", "b", "c"})};
    ASSERT_EQ(grid_points(keys), 6U);
    std::vector<std::pair<double, std::string>> visited;
    for (std::uint32_t run = 0; run < 7; ++run) {
        const auto sample = draw(keys, 1, run);
        visited.emplace_back(std::get<double>(sample[0]), std::get<std::string>(sample[2]));
    }
    const std::vector<std::pair<double, std::string>> expected = {
        {1, "a"}, {1, "b"}, {1, "c"}, {2, "a"}, {2, "b"}, {2, "c"}, {1, "a"}};
    EXPECT_EQ(visited, expected);
}

TEST(Sampling, SaysWhichPointsOfAGridRunsLeaveOut) {
    std::vector<VariedKey> keys(2);  // of grids
    keys[0].key = "a";
    keys[0].values = {1.0, 2.0, 3.0};
    keys[1].key = "b";
    keys[1].values = {1.0, 2.0};
    EXPECT_EQ(uneven_runs(keys, 6), "");
    EXPECT_EQ(uneven_runs(keys, 18), "");
    EXPECT_EQ(uneven_runs({}, 7), "");
    EXPECT_THAT(uneven_runs(keys, 2),
                testing::HasSubstr("runs: 2 is fewer than the grids' 6 points: 4 of them are not "
                                   "flown"));
    EXPECT_THAT(uneven_runs(keys, 8), testing::HasSubstr("the first 2 are flown once more"));
}

TEST(Sampling, DependsOnSeedAndRunAlone) {
    const std::vector<VariedKey> keys = {key_of(Spread::normal, 0.0, 1.0),
                                         key_of(Spread::uniform, 0.0, 1.0)};
    const auto forth = draw(keys, 4, 17);
    (void)draw(keys, 4, 16);
    EXPECT_EQ(draw(keys, 4, 17), forth);
    EXPECT_NE(draw(keys, 4, 18), forth);
    EXPECT_NE(draw(keys, 5, 17), forth);
}

TEST(Sampling, NumbersSurviveTheirText) {
    const double awkward = 0.1 + 0.2;
    EXPECT_EQ(std::stod(value_text(awkward)), awkward);
    EXPECT_EQ(value_text(std::string("metal")), "metal");
}

}  // namespace
}  // namespace limpet::campaign
