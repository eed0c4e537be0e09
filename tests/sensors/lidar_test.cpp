// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::after_a_second;
using test::at_rest;
using test::quiet_model;
using test::run;

/// Vehicle at a distance from the wall, turned by yaw and pitch.
auto facing(double distance_m, double yaw_rad = 0.0, double pitch_rad = 0.0) {
    return [=](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.p_WF_m.x() = -distance_m;
        truth.base.q_WF = quaternion_from_euler({.pitch_rad = pitch_rad, .yaw_rad = yaw_rad});
        return truth;
    };
}

TEST(Lidar, MeasuresFromItsMountAlongXOfB) {
    SensorsModel model = quiet_model();
    model.parameters.lidar_resolution_m = 0.0;
    const Readings square = after_a_second(model, facing(1.5));
    EXPECT_NEAR(square.lidar_left.value.distance_m, 1.5 - 0.205, 1e-12);
    EXPECT_NEAR(square.lidar_right.value.distance_m, 1.5 - 0.205, 1e-12);
    EXPECT_TRUE(square.lidar_left.value.valid);

    // nose to the right: the left unit comes closer, by eq. (7) exactly tan(yaw) over 0.41 m
    const double yaw_rad = radians(10.0);
    const Readings turned = after_a_second(model, facing(1.5, yaw_rad));
    const double difference_m =
        turned.lidar_left.value.distance_m - turned.lidar_right.value.distance_m;
    EXPECT_NEAR(std::atan(difference_m / 0.41), -yaw_rad, 1e-12);

    // pitch lengthens the beam and moves the mount: (d - 0.205 cos) / cos
    const double pitch_rad = radians(20.0);
    const Readings pitched = after_a_second(model, facing(1.5, 0.0, pitch_rad));
    EXPECT_NEAR(pitched.lidar_left.value.distance_m, 1.5 / std::cos(pitch_rad) - 0.205, 1e-12);
}

TEST(Lidar, ReadsInStepsOfItsResolution) {
    const SensorsModel model = quiet_model();
    for (double distance_m = 1.0; distance_m < 1.02; distance_m += 0.0007) {
        const double reading_m =
            after_a_second(model, facing(distance_m)).lidar_left.value.distance_m;
        EXPECT_NEAR(reading_m / 0.005, std::round(reading_m / 0.005), 1e-9);
        EXPECT_LE(std::abs(reading_m - (distance_m - 0.205)), 0.0025 + 1e-12);
    }
}

TEST(Lidar, SaysSoWhenThereIsNoEcho) {
    const SensorsModel model = quiet_model();
    const auto valid = [&](auto truth_at) {
        const Readings readings = after_a_second(model, truth_at);
        EXPECT_TRUE(readings.lidar_left.fresh(0.999, 0.02));  // a sample all the same
        return readings.lidar_left.value.valid;
    };
    EXPECT_TRUE(valid(facing(0.205 + 0.101)));
    EXPECT_FALSE(valid(facing(0.205 + 0.099)));
    EXPECT_TRUE(valid(facing(0.205 + 11.99)));
    EXPECT_FALSE(valid(facing(0.205 + 12.01)));
    EXPECT_FALSE(valid(facing(1.5, kPi)));  // looks away
}

TEST(Lidar, DropsOutAsOftenAsAsked) {
    SensorsModel model = quiet_model();
    model.parameters.lidar_dropout_probability = 0.03;
    std::int64_t lost = 0;
    std::int64_t samples = 0;
    run(model, 200000, facing(1.5), [&](Tick tick, const Readings& readings) {
        if (readings.lidar_left.ever() && due(tick, 100)) {
            ++samples;
            lost += readings.lidar_left.value.valid ? 0 : 1;
        }
    });
    const test::Interval share = test::wilson(lost, samples);
    EXPECT_GT(0.03, share.low);
    EXPECT_LT(0.03, share.high);
    EXPECT_LT(share.high - share.low, 0.02);
}

TEST(Lidar, ErrorIsAConstantBiasAndWhiteNoise) {
    SensorsModel model = quiet_model();
    model.parameters.lidar_resolution_m = 0.0;
    model.parameters.lidar_noise_m = 0.005;
    model.parameters.lidar_bias_m = 0.05;
    std::vector<double> left;
    std::vector<double> right;
    run(model, 100000, facing(1.5), [&](Tick tick, const Readings& readings) {
        if (readings.lidar_left.ever() && due(tick, 100)) {
            left.push_back(readings.lidar_left.value.distance_m - 1.295);
            right.push_back(readings.lidar_right.value.distance_m - 1.295);
        }
    });
    EXPECT_NEAR(test::statistics(left).deviation, 0.005, 0.0002);
    EXPECT_NEAR(test::statistics(right).deviation, 0.005, 0.0002);
    // two units, two biases: far apart against 0.005 / sqrt(10000)
    EXPECT_GT(std::abs(test::statistics(left).mean - test::statistics(right).mean), 0.001);
}

TEST(Lidar, BiasesOfManyUnitsScatterAsAsked) {
    SensorParameters parameters;
    parameters.lidar_bias_m = 0.05;
    std::vector<double> biases;
    for (std::uint32_t number = 0; number < 2000; ++number) {
        biases.push_back(
            start_unit<LidarSensor>(parameters, RandomStream(3, number, Stream::lidar_left), {})
                .state.bias);
    }
    EXPECT_NEAR(test::statistics(biases).deviation, 0.05, 0.005);
    EXPECT_NEAR(test::statistics(biases).mean, 0.0, 0.006);
}

TEST(Lidar, ArrivesLateWithItsOwnStamp) {
    const SensorsModel model = quiet_model();
    // approaching at 1 m/s: the value tells when it was measured
    const auto approaching = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.p_WF_m.x() = -3.0 + truth.time_s;
        return truth;
    };
    run(model, 1000, approaching, [&](Tick tick, const Readings& readings) {
        if (tick >= 20 && due(tick, 100)) {
            EXPECT_DOUBLE_EQ(readings.lidar_left.time_s, seconds(tick - 10));
            EXPECT_NEAR(readings.lidar_left.value.distance_m, 2.795 - seconds(tick - 10), 0.0026);
        }
    });
}

}  // namespace
}  // namespace limpet::sensors
