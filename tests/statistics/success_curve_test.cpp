// SPDX-License-Identifier: Apache-2.0
#include "limpet/statistics/success_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limpet/core/frames.hpp"
#include "limpet/core/random.hpp"

namespace limpet::statistics {
namespace {

/// Trials at eleven values, drawn from a curve.
template <class Curve>
std::vector<Trials> drawn(const Curve& curve, std::uint32_t runs, std::uint32_t repetition) {
    RandomStream random(11, repetition, Stream::test);
    std::vector<Trials> all;
    for (int i = 2; i <= 12; ++i) {
        Trials trials{0.1 * i, {0, runs}};
        for (std::uint32_t k = 0; k < runs; ++k) {
            trials.proportion.successes += random.uniform() < curve(trials.x) ? 1 : 0;
        }
        all.push_back(trials);
    }
    return all;
}

double with_plateau(double speed) {
    return 0.8 / (1.0 + std::pow(0.7 / speed, 7.0));
}

TEST(ChiSquared, TablesAndClosedForms) {
    EXPECT_NEAR(chi_squared_beyond(3.841459, 1), 0.05, 1e-7);
    EXPECT_NEAR(chi_squared_beyond(5.991465, 2), 0.05, 1e-7);
    EXPECT_NEAR(chi_squared_beyond(7.814728, 3), 0.05, 1e-7);
    EXPECT_NEAR(chi_squared_beyond(16.918978, 9), 0.05, 1e-7);
    EXPECT_NEAR(chi_squared_beyond(23.209251, 10), 0.01, 1e-7);
    EXPECT_EQ(chi_squared_beyond(0.0, 5), 1.0);
    EXPECT_EQ(chi_squared_beyond(std::numeric_limits<double>::infinity(), 5), 0.0);
    // Many degrees: the median is n - 2/3 and the density there (4 pi n)^-1/2.
    EXPECT_NEAR(chi_squared_beyond(2000.0, 2000), 0.5 - 2.0 / 3.0 / std::sqrt(8000.0 * kPi), 1e-4);
    EXPECT_NEAR(chi_squared_beyond(2001.0, 2001), 0.5 - 2.0 / 3.0 / std::sqrt(8004.0 * kPi), 1e-4);
    EXPECT_EQ(chi_squared_beyond(1e7, 91), 0.0);
}

TEST(Goodness, ByHand) {
    // Expected 5 and 5, 10 and 10: 4 / 5 + 4 / 5 + 0, two cells less one number.
    const std::vector<Trials> trials = {{1.0, {7, 10}}, {2.0, {10, 20}}};
    const auto half = [](double) { return 0.5; };
    const auto good = goodness_of(trials, half, 1);
    ASSERT_TRUE(good);
    EXPECT_DOUBLE_EQ(good->chi2, 1.6);
    EXPECT_EQ(good->degrees, 1);
    EXPECT_NEAR(good->p, std::erfc(std::sqrt(0.8)), 1e-12);
    EXPECT_FALSE(good->rejected());
    EXPECT_FALSE(goodness_of(trials, half, 2));
}

/// Cells that expect next to nothing are not counted as degrees of freedom.
TEST(Goodness, SmallCellsAreTakenTogether) {
    std::vector<Trials> trials;
    for (int i = 0; i < 40; ++i) {
        trials.push_back({static_cast<double>(i), {i % 2 == 0 ? 1U : 0U, 1}});
    }
    const auto good = goodness_of(
        trials, [](double) { return 0.5; }, 0);
    ASSERT_TRUE(good);
    EXPECT_EQ(good->degrees, 10);
    EXPECT_EQ(good->chi2, 0.0);
    EXPECT_FALSE(goodness_of(
        trials, [](double) { return 1e-6; }, 0));
}

TEST(SuccessCurve, ItsIntervalsHoldWhatMadeTheData) {
    constexpr int kRepetitions = 200;
    // 0.8 / (1 + (0.7 / x)^7) = 1/2
    const double half = 0.7 * std::pow(0.6, -1.0 / 7.0);
    int plateau = 0, middle = 0, rejected = 0;
    for (std::uint32_t k = 0; k < kRepetitions; ++k) {
        const auto curve = fit_success_curve(drawn(with_plateau, 60, k));
        ASSERT_TRUE(curve && curve->half) << k;
        EXPECT_TRUE(curve->along_logarithm);
        EXPECT_NEAR(curve->probability(*curve->half), 0.5, 1e-6);
        plateau += curve->plateau_95.low <= 0.8 && 0.8 <= curve->plateau_95.high ? 1 : 0;
        middle += curve->half_95.low <= half && half <= curve->half_95.high ? 1 : 0;
        rejected += curve->goodness.rejected() ? 1 : 0;
    }
    SCOPED_TRACE(testing::Message() << plateau << " " << middle << " " << rejected);
    EXPECT_GE(plateau, 0.90 * kRepetitions);
    EXPECT_LE(plateau, 0.99 * kRepetitions);
    EXPECT_GE(middle, 0.90 * kRepetitions);
    EXPECT_LE(middle, 0.99 * kRepetitions);
    EXPECT_LE(rejected, 0.10 * kRepetitions);
}

TEST(SuccessCurve, IsTheLogisticOneWhereThereIsNoPlateau) {
    const auto rises = [](double x) { return 1.0 / (1.0 + std::pow(0.6 / x, 8.0)); };
    int at_one = 0, held = 0;
    for (std::uint32_t k = 0; k < 20; ++k) {
        std::vector<Trials> trials = drawn(rises, 200, k);
        const auto curve = fit_success_curve(trials);
        ASSERT_TRUE(curve && curve->half);
        held += curve->plateau_95.high == 1.0 ? 1 : 0;
        EXPECT_GT(curve->plateau_95.low, 0.9) << k;
        for (Trials& one : trials) {
            one.x = std::log(one.x);
        }
        const auto plain = fit_logistic(trials);
        ASSERT_TRUE(plain);
        if (curve->plateau == 1.0) {
            ++at_one;
            EXPECT_NEAR(curve->slope, plain->slope, 1e-5 * plain->slope);
            EXPECT_NEAR(*curve->half, std::exp(plain->half), 1e-6);
            EXPECT_NEAR(std::log(curve->half_95.high / *curve->half), kNormal95 * plain->half_error,
                        1e-5);
        }
    }
    EXPECT_GT(at_one, 3);
    EXPECT_GE(held, 18);
}

/// Of values that are not all positive it runs along them; a fall is a rise the other way round.
TEST(SuccessCurve, RunsAlongTheValueWhereThatIsNotPositive) {
    std::vector<Trials> rising = drawn(with_plateau, 400, 1);
    for (Trials& one : rising) {
        one.x -= 0.7;
    }
    const auto up = fit_success_curve(rising);
    ASSERT_TRUE(up && up->half);
    EXPECT_FALSE(up->along_logarithm);
    std::vector<Trials> falling(rising.rbegin(), rising.rend());
    for (Trials& one : falling) {
        one.x = -one.x;
    }
    const auto down = fit_success_curve(falling);
    ASSERT_TRUE(down && down->half);
    EXPECT_NEAR(*down->half, -*up->half, 1e-6);
    EXPECT_NEAR(down->plateau, up->plateau, 1e-6);
    EXPECT_NEAR(down->slope, -up->slope, 1e-5);
}

TEST(SuccessCurve, SaysNoMiddleThatIsNotReached) {
    const auto low = [](double x) { return 0.5 * with_plateau(x); };
    const auto curve = fit_success_curve(drawn(low, 400, 2));
    ASSERT_TRUE(curve);
    EXPECT_NEAR(curve->plateau, 0.4, 0.05);
    EXPECT_FALSE(curve->half);
    EXPECT_FALSE(fit_success_curve({}));
    EXPECT_FALSE(fit_success_curve({{0.1, {0, 9}}, {0.2, {0, 9}}, {0.3, {9, 9}}}));
}

}  // namespace
}  // namespace limpet::statistics
