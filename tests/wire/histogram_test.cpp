// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "limpet/core/random.hpp"

namespace limpet::wire {
namespace {

TEST(DurationHistogram, EmptyItSaysNothing) {
    const DurationHistogram histogram;
    EXPECT_EQ(histogram.count(), 0U);
    EXPECT_EQ(histogram.mean_s(), 0.0);
    EXPECT_EQ(histogram.quantile_s(0.99), 0.0);
}

TEST(DurationHistogram, EdgesAreQuartersOfAnOctave) {
    EXPECT_DOUBLE_EQ(DurationHistogram::edge_s(0), 1e-6);
    EXPECT_DOUBLE_EQ(DurationHistogram::edge_s(4), 2e-6);
    EXPECT_DOUBLE_EQ(DurationHistogram::edge_s(40), 1024e-6);
}

TEST(DurationHistogram, QuantilesAreWithinABinOfTheSortedNumbers) {
    DurationHistogram histogram;
    std::vector<double> sorted;
    RandomStream random(1, 0, Stream::imu);
    double sum_s = 0.0;
    for (int i = 0; i < 10000; ++i) {
        sorted.push_back(1e-3 * std::exp(random.normal()));
        histogram.add(sorted.back());
        sum_s += sorted.back();
    }
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(histogram.count(), 10000U);
    EXPECT_NEAR(histogram.mean_s(), sum_s / 10000.0, 1e-12);
    EXPECT_EQ(histogram.largest_s(), sorted.back());
    for (const double share : {0.01, 0.5, 0.9, 0.99}) {
        const double exact_s = sorted[static_cast<std::size_t>(share * 10000.0) - 1];
        EXPECT_GE(histogram.quantile_s(share), exact_s);
        EXPECT_LE(histogram.quantile_s(share), exact_s * std::exp2(0.25) * (1.0 + 1e-12));
    }
    EXPECT_EQ(histogram.quantile_s(1.0), sorted.back());
}

TEST(DurationHistogram, OddNumbersHaveTheirPlace) {
    DurationHistogram histogram;
    histogram.add(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(histogram.count(), 0U);
    histogram.add(-1.0);
    histogram.add(0.0);
    EXPECT_EQ(histogram.bins()[0], 2U);
    EXPECT_EQ(histogram.quantile_s(0.5), 0.0);
    histogram.add(1000.0);
    EXPECT_EQ(histogram.bins()[DurationHistogram::kBins - 1], 1U);
    EXPECT_EQ(histogram.quantile_s(1.0), 1000.0);
}

}  // namespace
}  // namespace limpet::wire
