// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "limpet/companion/companion.hpp"
#include "tests/support/allocations.hpp"

namespace limpet::companion {
namespace {

TEST(Lateness, OfNoTickIsNone) {
    const Lateness none;
    EXPECT_EQ(none.count(), 0U);
    EXPECT_EQ(none.quantile_s(0.5), 0.0);
    EXPECT_EQ(none.largest_s(), 0.0);
}

TEST(Lateness, IsTheSortedTicksToASixteenth) {
    std::mt19937 random(7);
    std::lognormal_distribution<double> draw(std::log(80e-6), 2.0);
    Lateness lateness;
    std::vector<double> all;
    for (int k = 0; k < 20'000; ++k) {
        all.push_back(draw(random));
        lateness.add(all.back());
    }
    std::sort(all.begin(), all.end());
    for (const double share : {0.01, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
        const auto rank = static_cast<std::size_t>(std::ceil(share * 20'000.0)) - 1;
        EXPECT_GE(lateness.quantile_s(share), all[rank]) << share;
        EXPECT_LE(lateness.quantile_s(share), all[rank] * (1.0 + 1.0 / 16.0) + 1e-6) << share;
    }
    EXPECT_EQ(lateness.largest_s(), all.back());
    EXPECT_EQ(lateness.quantile_s(1.0), all.back()) << "never beyond the worst";
    EXPECT_EQ(lateness.count(), 20'000U);
}

TEST(Lateness, EveryStepBeginsWhereTheLastOneEnds) {
    double last_s = 0.0;
    for (double us = 0.5; us < 1e9; us *= 1.01) {
        Lateness one;
        one.add(1e-6 * us);
        one.add(2000.0);  // so that the worst is no bound
        const double edge_s = one.quantile_s(0.5);
        EXPECT_GT(edge_s, 1e-6 * us);
        EXPECT_GE(edge_s, last_s);
        last_s = edge_s;
    }
}

TEST(Lateness, TakesWhatNoLoopHas) {
    Lateness lateness;
    lateness.add(-1.0);
    lateness.add(1e9);
    EXPECT_EQ(lateness.count(), 2U);
    EXPECT_EQ(lateness.quantile_s(0.5), 1e-6);
    EXPECT_EQ(lateness.largest_s(), 1e9);
    EXPECT_EQ(lateness.quantile_s(1.0), 1e9);
}

TEST(Lateness, AllocatesNothing) {
    Lateness lateness;
    const long before = allocations();
    for (int k = 0; k < 1000; ++k) {
        lateness.add(1e-5 * k);
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(lateness.count(), 1000U);
}

TEST(Lateness, IsSaidInOneLine) {
    Lateness lateness;
    for (int k = 0; k < 999; ++k) {
        lateness.add(50.5e-6);
    }
    lateness.add(0.98);
    EXPECT_EQ(lateness_text(lateness),
              "late by 0.05 ms (median), 0.05 ms (99 %), 0.05 ms (99.9 %), 980.0 ms (worst)");
}

}  // namespace
}  // namespace limpet::companion
