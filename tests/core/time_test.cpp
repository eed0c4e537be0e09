// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/time.hpp"

#include <gtest/gtest.h>

namespace limpet {
namespace {

TEST(Time, EveryRateRunsItsNumberOfTimesASecond) {
    for (const int rate_Hz : {1, 5, 7, 50, 100, 120, 250, 333, 1000}) {
        int runs = 0;
        for (Tick tick = 1; tick <= 10 * kTicksPerSecond; ++tick) {
            runs += due(tick, rate_Hz) ? 1 : 0;
        }
        EXPECT_EQ(runs, 10 * rate_Hz) << rate_Hz;
    }
}

TEST(Time, UnevenRatesJitterByLessThanATick) {
    Tick last = 0;
    for (Tick tick = 1; tick <= 10000; ++tick) {
        if (due(tick, 120)) {
            EXPECT_GE(tick - last, 8);
            EXPECT_LE(tick - last, 9);
            last = tick;
        }
    }
}

}  // namespace
}  // namespace limpet
