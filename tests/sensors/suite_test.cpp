// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/suite.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::WallPlant;

Truth hovering(Tick tick) {
    Truth truth = test::at_rest(tick);
    const double t = truth.time_s;
    truth.base.p_WF_m += Vector3(0.1 * std::sin(t), 0.05 * std::cos(2.0 * t), 0.02 * t);
    truth.base.v_WF_W_m_s = {0.1 * std::cos(t), -0.1 * std::sin(2.0 * t), 0.02};
    truth.base.q_WF = quaternion_from_euler({.pitch_rad = 0.05 * std::sin(3.0 * t)});
    truth.slider.force_N = -5.0;
    truth.battery.voltage_V = 24.0;
    return truth;
}

/// The readings as numbers, one row a sensor, in a fixed order.
constexpr std::size_t kSensors = 10;
constexpr std::array<std::string_view, kSensors> kPrefixes = {
    "imu",        "baro",        "mag",   "gps",      "mocap",
    "lidar_left", "lidar_right", "force", "pressure", "battery"};

std::array<std::vector<double>, kSensors> numbers(const Readings& r) {
    const auto list = [](double time_s, const Vector3& a, const Vector3& b) {
        return std::vector<double>{time_s, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()};
    };
    const Vector3 none = Vector3::Zero();
    return {
        list(r.imu.time_s, r.imu.value.specific_force_B_m_s2, r.imu.value.rate_B_rad_s),
        {r.barometer.time_s, r.barometer.value.pressure_Pa, r.barometer.value.altitude_m},
        list(r.magnetometer.time_s, r.magnetometer.value.field_B_gauss, none),
        list(r.gps.time_s, r.gps.value.p_WB_m, r.gps.value.v_WB_m_s),
        list(r.motion_capture.time_s, r.motion_capture.value.p_WB_m,
             r.motion_capture.value.q_WB.vec()),
        {r.lidar_left.time_s, r.lidar_left.value.distance_m, r.lidar_left.value.valid ? 1.0 : 0.0},
        {r.lidar_right.time_s, r.lidar_right.value.distance_m,
         r.lidar_right.value.valid ? 1.0 : 0.0},
        {r.force.time_s, r.force.value.axial_N},
        {r.cup_pressure.time_s, r.cup_pressure.value.pressure_Pa},
        {r.battery.time_s, r.battery.value.voltage_V}};
}

using Log = std::array<std::vector<double>, kSensors>;

Log log_of(const SensorsModel& model, std::uint64_t seed = 1) {
    Log log;
    test::run(
        model, 2000, hovering,
        [&](Tick, const Readings& readings) {
            const auto rows = numbers(readings);
            for (std::size_t i = 0; i < kSensors; ++i) {
                log[i].insert(log[i].end(), rows[i].begin(), rows[i].end());
            }
        },
        seed);
    return log;
}

TEST(Suite, SameSeedSameNumbersOtherSeedOthers) {
    EXPECT_EQ(log_of({}, 1), log_of({}, 1));
    const Log one = log_of({}, 1);
    const Log two = log_of({}, 2);
    for (std::size_t i = 0; i + 1 < kSensors; ++i) {  // the battery's sample has no error
        EXPECT_NE(one[i], two[i]) << kPrefixes[i];
    }
}

TEST(Suite, SilencingOneSensorsNoiseLeavesTheOthersAlone) {
    const Log reference = log_of({});
    SensorParameters silent = test::quiet();
    const auto without = sensor_rows(silent);
    for (const std::string_view prefix :
         {"gyro", "baro", "mag", "gps", "mocap", "lidar", "force", "pressure"}) {
        SensorsModel model;
        const auto rows = sensor_rows(model.parameters);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (rows[k].name.starts_with(prefix)) {
                rows[k].value.set(without[k].value.get());
            }
        }
        const Log changed = log_of(model);
        for (std::size_t i = 0; i < kSensors; ++i) {
            const bool own =
                kPrefixes[i].starts_with(prefix) || (prefix == "gyro" && kPrefixes[i] == "imu");
            EXPECT_EQ(changed[i] == reference[i], !own) << prefix << " " << kPrefixes[i];
        }
    }
}

TEST(Suite, ADropoutLeavesTheOtherNumbersAlone) {
    const Log reference = log_of({});
    SensorsModel model;
    model.parameters.mocap_dropout_probability = 0.5;
    const Log changed = log_of(model);
    for (std::size_t i = 0; i < kSensors; ++i) {
        const bool own = kPrefixes[i] == "mocap";
        EXPECT_EQ(changed[i] == reference[i], !own) << kPrefixes[i];
    }
}

TEST(Suite, ACopyContinuesBitIdentically) {
    const SensorsModel model;
    const WallPlant plant;
    SensorsState original = start(model, hovering(0), 1, 0);
    for (Tick tick = 0; tick < 777; ++tick) {
        sense(model, original, hovering(tick), plant, tick);
    }
    SensorsState copy = original;
    for (Tick tick = 777; tick < 2000; ++tick) {
        sense(model, original, hovering(tick), plant, tick);
        sense(model, copy, hovering(tick), plant, tick);
        ASSERT_EQ(numbers(original.readings), numbers(copy.readings)) << tick;
    }
}

TEST(Suite, EverySensorSpeaksAtItsRate) {
    std::array<int, kSensors> counts{};
    std::array<double, kSensors> last_s{};
    last_s.fill(-1.0);
    // 2 s of exposures, and the time that the last of them takes to arrive
    test::run({}, 2000, hovering, [&](Tick, const Readings& readings) {
        const auto rows = numbers(readings);
        for (std::size_t i = 0; i < kSensors; ++i) {
            counts[i] += rows[i][0] > last_s[i] ? 1 : 0;
            last_s[i] = rows[i][0];
        }
    });
    const std::array<int, kSensors> expected = {500, 100, 200, 10, 238, 199, 199, 500, 200, 20};
    EXPECT_EQ(counts, expected);
}

TEST(Suite, WithoutACupThereAreNoPerchingSensors) {
    SensorsModel model;
    model.has_cup = false;
    test::run(model, 500, hovering, [](Tick, const Readings& r) {
        EXPECT_TRUE(r.imu.ever());
        EXPECT_FALSE(r.lidar_left.ever() || r.lidar_right.ever() || r.force.ever() ||
                     r.cup_pressure.ever());
    });
}

TEST(Suite, NothingIsHeardBeforeTheFirstTick) {
    const SensorsState state = start(SensorsModel{}, hovering(0), 1, 0);
    EXPECT_FALSE(state.readings.imu.ever() || state.readings.motion_capture.ever() ||
                 state.readings.lidar_left.ever() || state.readings.battery.ever());
}

}  // namespace
}  // namespace limpet::sensors
