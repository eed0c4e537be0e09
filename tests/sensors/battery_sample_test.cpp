// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

TEST(BatterySample, CopiesTheTruthTenTimesASecond) {
    const auto draining = [](Tick tick) {
        Truth truth = test::at_rest(tick);
        truth.battery = {.voltage_V = 25.0 - truth.time_s, .current_A = 19.0, .remaining = 0.9};
        return truth;
    };
    test::run(test::quiet_model(), 1000, draining, [](Tick tick, const Readings& readings) {
        const double sampled_s = seconds(tick / 100 * 100);
        EXPECT_DOUBLE_EQ(readings.battery.time_s, sampled_s);
        EXPECT_DOUBLE_EQ(readings.battery.value.voltage_V, 25.0 - sampled_s);
        EXPECT_DOUBLE_EQ(readings.battery.value.current_A, 19.0);
        EXPECT_DOUBLE_EQ(readings.battery.value.remaining, 0.9);
    });
}

}  // namespace
}  // namespace limpet::sensors
