// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/sensor.hpp"

#include <gtest/gtest.h>

#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

/// As small as a sensor can be: height by a tape, which nobody in the loop reads.
struct Tape {
    using Reading = double;
    struct Parameters {
        int tape_rate_Hz = 10;
        double tape_bias_m = 0.1;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::test};
    static constexpr auto kRate_Hz = &Parameters::tape_rate_Hz;
    static constexpr auto kBias = &Parameters::tape_bias_m;

    static std::optional<Reading> measure(const Parameters& /*p*/, State& state,
                                          const SensorView& view) {
        if (view.truth.time_s > 0.35) {
            return std::nullopt;
        }
        return state.bias - view.truth.base.p_WF_m.z();
    }
};

/// The same over a slow wire.
struct LateTape : Tape {
    static constexpr double Parameters::*kLatency_s = &Parameters::tape_bias_m;  // 0.1, as it is
};

template <class Sensor>
SensorUnit<Sensor> after(Tick ticks) {
    const Tape::Parameters parameters;
    auto unit = start_unit<Sensor>(parameters, RandomStream(1, 0, Stream::test), test::at_rest(0));
    for (Tick tick = 0; tick < ticks; ++tick) {
        const Truth truth = test::at_rest(tick);
        sense(parameters, unit, {.truth = truth, .mounts = {}}, tick, unit.heard);
    }
    return unit;
}

TEST(Sensor, SpeaksAtItsRateWithItsBiasUntilItIsLost) {
    EXPECT_EQ(after<Tape>(150).heard.time_s, 0.1);
    const SensorUnit<Tape> unit = after<Tape>(1000);
    EXPECT_EQ(unit.heard.time_s, 0.3);
    EXPECT_EQ(unit.state.bias, 0.1 * RandomStream(1, 0, Stream::test).normal());
    EXPECT_EQ(unit.heard.value, 1.0 + unit.state.bias);
}

TEST(Sensor, ALateOneKeepsTheStampOfItsMeasurement) {
    EXPECT_FALSE(after<LateTape>(100).heard.ever());
    EXPECT_EQ(after<LateTape>(101).heard.time_s, 0.0);
    EXPECT_EQ(after<LateTape>(250).heard.time_s, 0.1);
}

TEST(Sample, IsNewToWhoHasSeenAnOlderOne) {
    Sample<int> seen;
    EXPECT_FALSE(seen.newer_than(seen));  // it never came
    EXPECT_FALSE((Sample<int>{.time_s = -0.02}).newer_than(seen));
    const Sample<int> first{.time_s = 0.0};
    EXPECT_TRUE(first.newer_than(seen));
    seen = first;
    EXPECT_FALSE(first.newer_than(seen));
    EXPECT_TRUE((Sample<int>{.time_s = 0.01}).newer_than(seen));
}

TEST(Sample, NothingIsKnownOnceTheClockBeginsAnew) {
    Readings before;
    before.imu.time_s = 12.0;
    Readings now;
    EXPECT_TRUE(began_anew(now, before));
    now.imu.time_s = 12.004;
    EXPECT_FALSE(began_anew(now, before));
}

}  // namespace
}  // namespace limpet::sensors
