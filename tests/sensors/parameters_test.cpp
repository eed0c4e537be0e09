// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "limpet/sensors/registry.hpp"
#include "tests/core/whole_table.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

TEST(SensorParameters, TableCoversEveryFieldOnce) {
    SensorParameters values;
    std::set<std::string_view> names;
    for (const auto& row : sensor_rows(values)) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_LE(row.minimum, row.value.get()) << row.name;
        EXPECT_GE(row.maximum, row.value.get()) << row.name;
        EXPECT_FALSE(row.description.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
    for_each_type(Sensors{}, [](auto sensor) {
        test::expect_whole(decltype(sensor)::type::table(), "sensors");
    });
}

TEST(SensorParameters, LimitsKeepTheDelayLinesFromOverflowing) {
    SensorsModel model;
    for (const auto& row : sensor_rows(model.parameters)) {
        if (row.name.ends_with("latency_s") || row.name.ends_with("rate_Hz")) {
            row.value.set(row.maximum);
        }
    }
    EXPECT_NO_THROW(test::run(model, 3000, test::at_rest, [](Tick, const Readings&) {}));
}

TEST(SensorParameters, ARateOfZeroMeansNotFitted) {
    SensorsModel model;
    for (const auto& row : sensor_rows(model.parameters)) {
        if (row.name.ends_with("rate_Hz")) {
            row.value.set(0.0);
        }
    }
    test::run(model, 1000, test::at_rest, [](Tick, const Readings& r) {
        EXPECT_FALSE(r.imu.ever() || r.barometer.ever() || r.magnetometer.ever() || r.gps.ever() ||
                     r.motion_capture.ever() || r.lidar_left.ever() || r.lidar_right.ever() ||
                     r.force.ever() || r.cup_pressure.ever() || r.battery.ever());
    });
}

}  // namespace
}  // namespace limpet::sensors
