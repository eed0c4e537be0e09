// SPDX-License-Identifier: Apache-2.0
#include "limpet/statistics/shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/random.hpp"

namespace limpet::statistics {
namespace {

TEST(Wilson, HandCalculations) {
    // k = 8, n = 10: (0.8 + 0.19207) / 1.38415 -+ 1.95996 / 1.38415 sqrt(0.016 + 0.0096036)
    const Interval most = Proportion{8, 10}.interval();
    EXPECT_NEAR(most.low, 0.490162, 1e-6);
    EXPECT_NEAR(most.high, 0.943318, 1e-6);
    // Without a success the upper end is z^2 / (n + z^2).
    const Interval none = Proportion{0, 20}.interval();
    EXPECT_EQ(none.low, 0.0);
    EXPECT_NEAR(none.high, kNormal95 * kNormal95 / (20.0 + kNormal95 * kNormal95), 1e-12);
    const Interval all = Proportion{20, 20}.interval();
    EXPECT_EQ(all.high, 1.0);
    EXPECT_NEAR(all.low, 1.0 - none.high, 1e-12);
}

TEST(Wilson, OfAnEffectiveNumberIsThatOfAsManyRuns) {
    EXPECT_EQ(wilson(0.8, 10.0).low, (Proportion{8, 10}.interval().low));
    const Interval part = wilson(0.8, 10.5);
    EXPECT_GT(part.low, wilson(0.8, 10.0).low);
    EXPECT_LT(part.low, wilson(0.8, 11.0).low);
    EXPECT_EQ(wilson(1.0, 7.3).high, 1.0);
    EXPECT_EQ(wilson(0.5, 0.0).high, 1.0);
}

TEST(Wilson, WithoutRunsNothingIsKnown) {
    EXPECT_TRUE(std::isnan(Proportion{}.probability()));
    EXPECT_EQ(Proportion{}.interval().low, 0.0);
    EXPECT_EQ(Proportion{}.interval().high, 1.0);
}

TEST(Wilson, CoversTheTruthAsOftenAsItSays) {
    int covered = 0;
    constexpr int kRepetitions = 4000;
    for (std::uint32_t repetition = 0; repetition < kRepetitions; ++repetition) {
        RandomStream random(2, repetition, Stream::test);
        Proportion p{0, 40};
        for (int i = 0; i < 40; ++i) {
            p.successes += random.uniform() < 0.3 ? 1 : 0;
        }
        const Interval interval = p.interval();
        covered += interval.low <= 0.3 && 0.3 <= interval.high ? 1 : 0;
    }
    EXPECT_NEAR(covered / static_cast<double>(kRepetitions), 0.95, 0.02);
}

TEST(Logistic, SymmetricDataHasAnAnswerByHand) {
    // 1 of 4, 2 of 4, 3 of 4 at -1, 0, 1: the log odds are -ln 3, 0, ln 3, on a line.
    const auto fit = fit_logistic({{-1.0, {1, 4}}, {0.0, {2, 4}}, {1.0, {3, 4}}});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, std::log(3.0), 1e-9);
    EXPECT_NEAR(fit->intercept, 0.0, 1e-9);
    EXPECT_NEAR(fit->half, 0.0, 1e-9);
    EXPECT_NEAR(fit->probability(1.0), 0.75, 1e-9);
    // Information of the slope: sum n p (1 - p) x^2 = 2 * 4 * 3/16 = 1.5; of the intercept 2.5.
    EXPECT_NEAR(fit->slope_error, 1.0 / std::sqrt(1.5), 1e-9);
    EXPECT_NEAR(fit->half_error, 1.0 / std::sqrt(2.5) / std::log(3.0), 1e-9);
}

TEST(Logistic, ShiftAndScaleOfXMoveTheFitAlong) {
    const auto fit = fit_logistic({{90.0, {1, 4}}, {100.0, {2, 4}}, {110.0, {3, 4}}});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, std::log(3.0) / 10.0, 1e-9);
    EXPECT_NEAR(fit->half, 100.0, 1e-6);
}

TEST(Logistic, RecoversWhatMadeTheData) {
    constexpr double kHalf = 0.7;
    constexpr double kSlope = 11.0;
    int covered = 0;
    for (std::uint32_t repetition = 0; repetition < 200; ++repetition) {
        RandomStream random(3, repetition, Stream::test);
        std::vector<Trials> trials;
        for (int i = 0; i < 250; ++i) {
            const double x = 0.2 + 1.2 * random.uniform();
            const double p = 1.0 / (1.0 + std::exp(-kSlope * (x - kHalf)));
            trials.push_back({x, {random.uniform() < p ? 1U : 0U, 1}});
        }
        const auto fit = fit_logistic(trials);
        ASSERT_TRUE(fit);
        covered += std::abs(fit->half - kHalf) < kNormal95 * fit->half_error ? 1 : 0;
    }
    EXPECT_GE(covered, 180);  // 90 %
}

TEST(TrialsAlong, ManyAreTakenTogetherAndFittedAsEachByItself) {
    constexpr std::uint32_t kRuns = 40'000;
    RandomStream random(3, 0, Stream::test);
    std::vector<Trials> each;
    for (std::uint32_t i = 0; i < kRuns; ++i) {
        const double x = -3.0 + 7.0 * std::pow(random.uniform(), 3);
        const double p = 1.0 / (1.0 + std::exp(-1.3 * (x - 0.2)));
        each.push_back({x, {random.uniform() < p ? 1U : 0U, 1}});
    }
    std::sort(each.begin(), each.end(), [](const Trials& a, const Trials& b) { return a.x < b.x; });
    TrialsAlong along({each.front().x, each.back().x}, kRuns);
    Proportion sum;
    for (const Trials& trials : each) {
        along.add(trials);
        sum.successes += trials.proportion.successes;
    }
    EXPECT_LE(along.all().size(), TrialsAlong::kMost + 1);
    for (const Trials& trials : along.all()) {
        sum.runs += trials.proportion.runs;
        sum.successes -= trials.proportion.successes;
    }
    EXPECT_EQ(sum.runs, kRuns);
    EXPECT_EQ(sum.successes, 0U);
    const auto exact = fit_logistic(each);
    const auto together = fit_logistic(along.all());
    ASSERT_TRUE(exact && together);
    EXPECT_NEAR(together->slope, exact->slope, 1e-3 * exact->slope_error);
    EXPECT_NEAR(together->half, exact->half, 1e-3 * exact->half_error);
}

TEST(TrialsAlong, FewStayAsTheyAre) {
    TrialsAlong along({0.0, 1.0}, TrialsAlong::kMost);
    for (const double x : {0.0, 1e-9, 2e-9, 1.0}) {
        along.add({x, {1, 1}});
    }
    EXPECT_EQ(along.all().size(), 4U);
    EXPECT_EQ(along.all()[1].x, 1e-9);
}

TEST(Logistic, SaysNothingWhereNothingCanBeSaid) {
    EXPECT_FALSE(fit_logistic({}));
    EXPECT_FALSE(fit_logistic({{0.0, {0, 5}}, {1.0, {0, 5}}, {2.0, {0, 5}}}));  // no success
    EXPECT_FALSE(fit_logistic({{0.0, {1, 5}}, {1.0, {3, 5}}}));                 // two values
    EXPECT_FALSE(fit_logistic({{0.0, {0, 9}}, {1.0, {0, 9}}, {2.0, {9, 9}}}));  // parted cleanly
    EXPECT_FALSE(fit_logistic({{1.0, {1, 5}}, {1.0, {2, 5}}, {1.0, {3, 5}}}));  // one value
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
    const std::vector<double> sorted = {1.0, 2.0, 4.0, 8.0};
    EXPECT_DOUBLE_EQ(quantile(sorted, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(quantile(sorted, 0.5), 3.0);
    EXPECT_DOUBLE_EQ(quantile(sorted, 1.0), 8.0);
    EXPECT_DOUBLE_EQ(quantile({5.0}, 0.95), 5.0);
}

TEST(Quantile, OfNumbersThatPassByIsThatOfAllOfThem) {
    for (const std::size_t count : {1U, 2U, 3U, 7U, 40U}) {
        std::vector<double> sorted;
        for (std::size_t i = 0; i < count; ++i) {
            sorted.push_back(static_cast<double>(i * i) + 0.5);
        }
        std::size_t at = 0;
        const std::vector<double> shares = {0.0, 0.05, 0.1, 0.5, 0.95, 1.0};
        const std::vector<double> found = quantiles(count, shares, [&] { return sorted.at(at++); });
        for (std::size_t k = 0; k < shares.size(); ++k) {
            EXPECT_EQ(found[k], quantile(sorted, shares[k])) << count << " " << shares[k];
            const double place = shares[k] * static_cast<double>(count - 1);
            EXPECT_NEAR(found[k], place * place + 0.5, 0.2501);  // chords of a parabola
        }
    }
}

}  // namespace
}  // namespace limpet::statistics
