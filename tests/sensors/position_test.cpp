// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limpet/sensors/gps.hpp"
#include "limpet/sensors/motion_capture.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::at_rest;
using test::quiet_model;
using test::run;
using test::statistics;

Truth flying(Tick tick) {
    Truth truth = at_rest(tick);
    truth.base.p_WF_m.x() = 2.0 * truth.time_s;
    truth.base.v_WF_W_m_s = {2.0, 0.0, 0.0};
    truth.base.q_WF = quaternion_from_euler({.yaw_rad = 0.3 * truth.time_s});
    return truth;
}

TEST(MotionCapture, Takes120SamplesASecondStampedAtTheExposure) {
    std::vector<double> stamps_s;
    run(quiet_model(), 10020, flying, [&](Tick tick, const Readings& readings) {
        const auto& pose = readings.motion_capture;
        if (pose.ever() && (stamps_s.empty() || pose.time_s > stamps_s.back())) {
            stamps_s.push_back(pose.time_s);
            EXPECT_NEAR(seconds(tick) - pose.time_s, 0.020, 1e-12);  // seen as soon as it arrives
            EXPECT_NEAR(pose.value.p_WB_m.x(), 2.0 * pose.time_s, 1e-12);
            EXPECT_NEAR(euler_from_quaternion(pose.value.q_WB).yaw_rad, 0.3 * pose.time_s, 1e-12);
        }
    });
    EXPECT_EQ(stamps_s.size(), 1200U);
    for (std::size_t i = 0; i < stamps_s.size(); ++i) {
        const double late_s = stamps_s[i] - static_cast<double>(i) / 120.0;
        EXPECT_GE(late_s, -1e-12);
        EXPECT_LT(late_s, kTick_s);
    }
}

TEST(MotionCapture, NoiseHasItsDeviation) {
    SensorsModel model = quiet_model();
    model.parameters.mocap_position_noise_m = 0.0005;
    model.parameters.mocap_attitude_noise_deg = 0.1;
    std::vector<double> shift_m;
    std::vector<double> turn_rad;
    run(model, 100000, at_rest, [&](Tick tick, const Readings& readings) {
        if (readings.motion_capture.ever() && due(tick - 20, 120)) {
            const PoseReading& pose = readings.motion_capture.value;
            shift_m.push_back(pose.p_WB_m.y());
            turn_rad.push_back(rotation_vector_from_quaternion(pose.q_WB).x());
            EXPECT_NEAR(pose.q_WB.norm(), 1.0, 1e-12);
        }
    });
    EXPECT_NEAR(statistics(shift_m).deviation, 0.0005, 0.00002);
    EXPECT_NEAR(statistics(turn_rad).deviation, radians(0.1), 0.04 * radians(0.1));
}

TEST(MotionCapture, DropsOutAsOftenAsAsked) {
    SensorsModel model = quiet_model();
    model.parameters.mocap_dropout_probability = 0.2;
    std::int64_t arrived = 0;
    double last_s = -1.0;
    run(model, 100020, at_rest, [&](Tick, const Readings& readings) {
        if (readings.motion_capture.time_s > last_s) {
            last_s = readings.motion_capture.time_s;
            ++arrived;
        }
    });
    const test::Interval share = test::wilson(12000 - arrived, 12000);
    EXPECT_GT(0.2, share.low);
    EXPECT_LT(0.2, share.high);
}

TEST(Gps, ArrivesAfterItsLatency) {
    int samples = 0;
    double last_s = -1.0;
    run(quiet_model(), 2000, flying, [&](Tick tick, const Readings& readings) {
        if (readings.gps.time_s > last_s) {
            last_s = readings.gps.time_s;
            ++samples;
            EXPECT_NEAR(seconds(tick) - last_s, 0.11, 1e-12);
            EXPECT_NEAR(readings.gps.value.p_WB_m.x(), 2.0 * last_s, 1e-12);
            EXPECT_NEAR(readings.gps.value.v_WB_m_s.x(), 2.0, 1e-12);
        }
    });
    EXPECT_EQ(samples, 10);
}

TEST(Gps, WanderKeepsItsDeviationFromTheStart) {
    SensorParameters parameters = test::quiet();
    parameters.gps_drift_horizontal_m = 0.5;
    parameters.gps_drift_vertical_m = 0.75;
    parameters.gps_drift_tau_s = 10.0;
    parameters.gps_latency_s = 0.0;
    std::vector<double> first;
    std::vector<double> last;
    std::vector<double> down;
    std::vector<double> speed;
    for (std::uint32_t number = 0; number < 1500; ++number) {
        auto unit = start_unit<GpsSensor>(parameters, RandomStream(5, number, Stream::gps), {});
        const auto look = [&](Tick tick, Sample<GpsReading>& reading) {
            const Truth truth = at_rest(tick);
            sense(parameters, unit, {.truth = truth, .mounts = {}}, tick, reading);
        };
        Sample<GpsReading> reading;
        look(0, reading);
        first.push_back(reading.value.p_WB_m.y());
        for (Tick tick = 200; tick <= 10000; tick += 200) {
            look(tick, reading);
        }
        last.push_back(reading.value.p_WB_m.y());
        down.push_back(reading.value.p_WB_m.z());
        speed.push_back(reading.value.v_WB_m_s.norm());
    }
    EXPECT_NEAR(statistics(first).deviation, 0.5, 0.05);
    EXPECT_NEAR(statistics(last).deviation, 0.5, 0.05);
    EXPECT_NEAR(statistics(down).deviation, 0.75, 0.075);
    EXPECT_EQ(statistics(speed).deviation, 0.0);
    // one correlation time later: a correlation of 1/e
    double product = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        product += first[i] * last[i] / static_cast<double>(first.size());
    }
    EXPECT_NEAR(product / 0.25, std::exp(-1.0), 0.12);
}

}  // namespace
}  // namespace limpet::sensors
