// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {
namespace {

Sample<int> numbered(int value) {
    return {.time_s = 0.001 * value, .value = value};
}

TEST(DelayLine, DeliversAtTheTickOfArrivalNotBefore) {
    DelayLine<int> line;
    Sample<int> latest;
    for (Tick tick = 0; tick < 500; ++tick) {  // several times around the ring
        line.send(numbered(static_cast<int>(tick)), tick + 20);
        line.deliver(tick, latest);
        if (tick < 20) {
            EXPECT_FALSE(latest.ever());
        } else {
            EXPECT_EQ(latest.value, tick - 20);
        }
    }
}

TEST(DelayLine, KeepsTheNewestOfSeveralArrivals) {
    DelayLine<int> line;
    Sample<int> latest;
    line.send(numbered(1), 5);
    line.send(numbered(2), 6);
    line.send(numbered(3), 9);
    line.deliver(7, latest);
    EXPECT_EQ(latest.value, 2);
}

TEST(DelayLine, TripsWhenItOverflows) {
    DelayLine<int> line;
    for (std::size_t i = 0; i < kDelayLineCapacity; ++i) {
        line.send(numbered(0), 1000);
    }
    EXPECT_THROW(line.send(numbered(0), 1000), InternalError);
}

TEST(DelayLine, LatencyIsRoundedToTheNearestTick) {
    EXPECT_EQ(arrival(100, 0.02), 120);
    EXPECT_EQ(arrival(100, 0.0004), 100);
    EXPECT_EQ(arrival(100, 0.0006), 101);
}

}  // namespace
}  // namespace limpet::sensors
