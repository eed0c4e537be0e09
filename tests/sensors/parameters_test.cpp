// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/parameters.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "tests/core/whole_table.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet {
namespace {

TEST(SensorParameters, TableCoversEveryFieldOnce) {
    const SensorParameters values;
    std::set<std::string_view> names;
    for (const auto& row : sensor_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_LE(row.minimum, row.get(values)) << row.name;
        EXPECT_GE(row.maximum, row.get(values)) << row.name;
        EXPECT_FALSE(row.description.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
    test::expect_whole(sensor_table(), "sensors");
}

TEST(SensorParameters, LimitsKeepTheDelayLinesFromOverflowing) {
    SensorsModel model;
    for (const auto& row : sensor_table()) {
        if (row.name.ends_with("latency_s") || row.name.ends_with("rate_Hz")) {
            row.of(model.parameters).set(row.maximum);
        }
    }
    EXPECT_NO_THROW(test::run(model, 3000, test::at_rest, [](Tick, const Readings&) {}));
}

TEST(SensorParameters, ARateOfZeroMeansNotFitted) {
    SensorsModel model;
    for (const auto& row : sensor_table()) {
        if (row.name.ends_with("rate_Hz")) {
            row.of(model.parameters).set(0.0);
        }
    }
    test::run(model, 1000, test::at_rest, [](Tick, const Readings& r) {
        EXPECT_FALSE(r.imu.ever() || r.barometer.ever() || r.magnetometer.ever() || r.gps.ever() ||
                     r.motion_capture.ever() || r.lidar_left.ever() || r.lidar_right.ever() ||
                     r.force.ever() || r.cup_pressure.ever() || r.battery.ever());
    });
}

}  // namespace
}  // namespace limpet
