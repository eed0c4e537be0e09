// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limpet/sensors/force.hpp"
#include "limpet/sensors/pressure.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::after_a_second;
using test::at_rest;
using test::quiet_model;
using test::run;
using test::statistics;

auto pressed(double force_N, double pressure_Pa = kAtmosphere_Pa) {
    return [=](Tick tick) {
        Truth truth = at_rest(tick);
        truth.slider.force_N = force_N;
        truth.cup_status.pressure_Pa = pressure_Pa;
        return truth;
    };
}

TEST(ForceSensor, KeepsTheSignAndSaturates) {
    const SensorsModel model = quiet_model();
    const auto reading_N = [&](double force_N) {
        return after_a_second(model, pressed(force_N)).force.value.axial_N;
    };
    EXPECT_DOUBLE_EQ(reading_N(-42.0), -42.0);  // pressed
    EXPECT_DOUBLE_EQ(reading_N(12.0), 12.0);    // pulled
    EXPECT_DOUBLE_EQ(reading_N(-500.0), -200.0);
    EXPECT_DOUBLE_EQ(reading_N(500.0), 200.0);
}

TEST(ForceSensor, NoiseHasItsDeviation) {
    SensorsModel model = quiet_model();
    model.parameters.force_noise_N = 0.2;
    std::vector<double> force_N;
    run(model, 40000, pressed(-42.0), [&](Tick tick, const Readings& readings) {
        if (due(tick, 250)) {
            EXPECT_DOUBLE_EQ(readings.force.time_s, seconds(tick));
            force_N.push_back(readings.force.value.axial_N);
        }
    });
    EXPECT_EQ(force_N.size(), 10000U);
    EXPECT_NEAR(statistics(force_N).deviation, 0.2, 0.008);
    EXPECT_NEAR(statistics(force_N).mean, -42.0, 0.01);
}

TEST(PressureSensor, ReadsInStepsAndWithinItsRange) {
    SensorsModel model = quiet_model();
    model.parameters.pressure_resolution_Pa = 50.0;
    const auto reading_Pa = [&](double pressure_Pa) {
        return after_a_second(model, pressed(0.0, pressure_Pa)).cup_pressure.value.pressure_Pa;
    };
    EXPECT_DOUBLE_EQ(reading_Pa(65010.0), 65000.0);
    EXPECT_DOUBLE_EQ(reading_Pa(65030.0), 65050.0);
    EXPECT_DOUBLE_EQ(reading_Pa(10.0), 1000.0);
    EXPECT_DOUBLE_EQ(reading_Pa(2e5), 120000.0);
}

TEST(PressureSensor, NoiseHasItsDeviation) {
    SensorsModel model = quiet_model();
    model.parameters.pressure_noise_Pa = 100.0;
    std::vector<double> pressure_Pa;
    run(model, 100000, at_rest, [&](Tick tick, const Readings& readings) {
        if (due(tick, 100)) {
            pressure_Pa.push_back(readings.cup_pressure.value.pressure_Pa);
        }
    });
    EXPECT_EQ(pressure_Pa.size(), 10000U);
    EXPECT_NEAR(statistics(pressure_Pa).deviation, 100.0, 4.0);
}

}  // namespace
}  // namespace limpet::sensors
