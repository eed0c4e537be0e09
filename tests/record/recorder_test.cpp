// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/record/recording.hpp"
#include "tests/support/allocations.hpp"

namespace limpet::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RecordingInfo sample_info() {
    return {.scenario = "perch_concrete",
            .seed = 42,
            .version = "0.1.0",
            .attachments = {{"scenario.yaml", "text/yaml", "vehicle: perching_uav\n", 0},
                            {"model.xml", "text/xml", "<mujoco/>\n", 0}},
            .range_sensor = {}};
}

Truth sample_truth(double time_s, RandomStream& random) {
    Truth truth;
    truth.time_s = time_s;
    truth.base.p_WF_m = random.normal3();
    truth.base.q_WF = quaternion_from_rotation_vector(random.normal3());
    truth.base.v_WF_W_m_s = random.normal3();
    truth.cup_status.pressure_Pa = 9e4 + random.normal();
    truth.rotor_speed_rad_s = {560.0, 561.0, 562.0, random.normal()};
    return truth;
}

/// A tick's worth of everything.
void record_tick(Recorder& recorder, double t, RandomStream& random) {
    recorder.truth(sample_truth(t, random));
    recorder.imu({t, {random.normal3(), random.normal3()}});
    recorder.range_left({t, {random.uniform(), true}});
    recorder.range_right({t, {0.0, false}});
    recorder.force({t, {random.normal()}});
    recorder.cup_pressure({t, {9e4}});
    recorder.motion_capture({t, {random.normal3(), Quaternion::Identity()}});
    recorder.barometer({t, {kAtmosphere_Pa, 0.0}});
    recorder.magnetometer({t, {random.normal3()}});
    recorder.gps({t, {random.normal3(), random.normal3()}});
    recorder.battery({t, {22.2, 15.0, 0.9}});
    Estimate estimate;
    estimate.time_s = t;
    recorder.estimate(estimate);
    recorder.consistency({.time_s = t, .nees = random.uniform(), .nees_of = {}, .nis_of = {}});
    recorder.setpoint(t, {.motion = PositionSetpoint{}, .armed = true});
    recorder.guidance(t, "hold", 1);
    recorder.rotor_command(t, {{0.1, 0.2, 0.3, 0.4}, true});
    recorder.event(make_event(t, "guidance", EventName::impact, "force", {{"force_N", -30.0}}));
}

void record_flight(const std::filesystem::path& path, int ticks) {
    Recorder recorder(path, sample_info());
    RandomStream random(3, 0, Stream::test);
    for (int tick = 0; tick < ticks; ++tick) {
        record_tick(recorder, tick * 1e-3, random);
    }
    recorder.finish("{\"outcome\":\"released\"}");
}

TEST(Recorder, AllocatesNothingWhileFlying) {
    const TestFolder folder;
    Recorder recorder(folder / "a.mcap", sample_info());
    RandomStream random(3, 0, Stream::test);
    const long before = allocations();
    for (int tick = 0; tick < 2000; ++tick) {  // about ten chunks
        record_tick(recorder, tick * 1e-3, random);
    }
    EXPECT_EQ(allocations() - before, 0);
    recorder.finish("{}");
    EXPECT_GT(allocations(), before);  // the counter counts
}

TEST(Recorder, TheSameFlightGivesTheSameBytes) {
    const TestFolder folder;
    record_flight(folder / "a.mcap", 500);
    record_flight(folder / "b.mcap", 500);
    const mcap::Bytes a = load(folder / "a.mcap");
    EXPECT_GT(a.size(), 100'000u);
    EXPECT_TRUE(a == load(folder / "b.mcap"));
}

/// The last message of what `fill` records, byte by byte.
template <class Fill>
std::vector<int> last_message(Fill&& fill) {
    const TestFolder folder;
    Recorder recorder(folder / "a.mcap", sample_info());
    fill(recorder);
    recorder.finish("{}");
    std::vector<int> bytes;
    (void)mcap::read(folder / "a.mcap", [&](const mcap::Contents&, const mcap::Message& message) {
        bytes.assign(message.data.begin(), message.data.end());
    });
    return bytes;
}

TEST(Recorder, BytesDoNotDependOnWhatStoodInTheBufferBefore) {
    const std::string tildes(200, '~');
    EXPECT_EQ(last_message([](Recorder& r) { r.guidance(5.0, "dock", 1); }),
              last_message([&](Recorder& r) {
                  r.event(make_event(0.0, tildes, EventName::level));
                  r.guidance(5.0, "dock", 1);
              }));
}

TEST(Recorder, RotorCommandByHand) {
    EXPECT_THAT(last_message([](Recorder& r) {
                    r.rotor_command(1.000000002, {{0.5, 1.0, 0.0, 2.0}, true});
                }),
                ElementsAre(0, 1, 0, 0,                    // little-endian CDR
                            1, 0, 0, 0, 2, 0, 0, 0,        // 1 s, 2 ns
                            0, 0, 0, 0, 0, 0, 0xE0, 0x3F,  // 0.5
                            0, 0, 0, 0, 0, 0, 0xF0, 0x3F,  // 1
                            0, 0, 0, 0, 0, 0, 0, 0,        // 0
                            0, 0, 0, 0, 0, 0, 0, 0x40,     // 2
                            1));                           // armed
}

TEST(Recorder, GuidanceStateByHand) {
    EXPECT_THAT(last_message([](Recorder& r) { r.guidance(0.0, "dock", 3); }),
                ElementsAre(0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,          // header, time 0
                            5, 0, 0, 0, 'd', 'o', 'c', 'k', 0, 0, 0, 0,  // text, zero, alignment
                            3, 0, 0, 0));
}

TEST(Recorder, RefusesEndlessTexts) {
    const TestFolder folder;
    Recorder recorder(folder / "a.mcap", sample_info());
    EXPECT_THROW(recorder.guidance(0.0, std::string(257, 'x'), 0), InternalError);
}

class Recorded : public ::testing::Test {
protected:
    /// Records what `fill` does and reads it back.
    template <class Fill>
    void record(Fill&& fill) {
        Recorder recorder(folder_ / "a.mcap", sample_info());
        fill(recorder);
        recorder.finish("{}");
        recording_ = read_recording(folder_ / "a.mcap");
        EXPECT_EQ(recording_.damage, "");
    }
    [[nodiscard]] double value(const char* topic, const char* column) const {
        return recording_.series(topic, column).values.back();
    }

    TestFolder folder_;
    Recording recording_;
};

TEST_F(Recorded, ImuAtRestReadsOneGUpwards) {
    record([](Recorder& r) { r.imu({0.004, {{0.1, 0.2, -kGravity_m_s2}, {0.5, 0.25, 0.125}}}); });
    EXPECT_EQ(recording_.series("/sensors/imu", "angular_velocity.x").time_s[0], 0.004);
    EXPECT_EQ(value("/sensors/imu", "header.stamp"), 0.004);
    EXPECT_EQ(value("/sensors/imu", "angular_velocity.x"), 0.5);
    EXPECT_EQ(value("/sensors/imu", "angular_velocity.y"), -0.25);
    EXPECT_EQ(value("/sensors/imu", "angular_velocity.z"), -0.125);
    EXPECT_EQ(value("/sensors/imu", "linear_acceleration.y"), -0.2);
    EXPECT_EQ(value("/sensors/imu", "linear_acceleration.z"), kGravity_m_s2);
    EXPECT_EQ(value("/sensors/imu", "orientation_covariance[0]"), -1.0);
    EXPECT_EQ(recording_.table("/sensors/imu").find_text("header.frame_id")->values[0],
              "base_link");
}

TEST_F(Recorded, SensorsOfTheMechanism) {
    record([](Recorder& r) {
        r.range_left({0.01, {1.25, true}});
        r.range_right({0.01, {7.0, false}});
        r.force({0.01, {-31.5}});
        r.cup_pressure({0.02, {88000.0}});
        r.battery({0.02, {22.5, 12.0, 0.75}});
    });
    EXPECT_EQ(value("/sensors/range_left", "range"), 1.25);
    EXPECT_EQ(value("/sensors/range_left", "max_range"), 12.0);
    EXPECT_EQ(value("/sensors/range_right", "range"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(value("/sensors/force", "wrench.force.x"), -31.5);
    EXPECT_EQ(value("/sensors/cup_pressure", "fluid_pressure"), 88000.0);
    EXPECT_EQ(value("/sensors/battery", "voltage"), 22.5);
    EXPECT_EQ(value("/sensors/battery", "current"), -12.0);  // ROS: negative when discharging
    EXPECT_EQ(value("/sensors/battery", "percentage"), 0.75);
    EXPECT_EQ(value("/sensors/battery", "present"), 1.0);
}

TEST_F(Recorded, WhatTellsWhereItIsOutdoors) {
    record([](Recorder& r) {
        r.magnetometer({0.01, {{0.21, 0.02, 0.42}}});
        r.gps({0.02, {{1.0, 2.0, -3.0}, {0.1, 0.2, 0.3}}});
    });
    EXPECT_NEAR(value("/sensors/magnetometer", "magnetic_field.x"), 2.1e-5, 1e-18);   // tesla
    EXPECT_NEAR(value("/sensors/magnetometer", "magnetic_field.y"), -2e-6, 1e-18);    // left
    EXPECT_NEAR(value("/sensors/magnetometer", "magnetic_field.z"), -4.2e-5, 1e-18);  // up
    EXPECT_EQ(value("/sensors/gps", "east_m"), 2.0);
    EXPECT_EQ(value("/sensors/gps", "down_m"), -3.0);
    EXPECT_EQ(value("/sensors/gps", "velocity_down_m_s"), 0.3);
}

TEST_F(Recorded, TruthIsInTheFramesOfItsMessages) {
    Truth truth;
    truth.time_s = 2.5;
    truth.base.p_WF_m = {1.0, 2.0, -3.0};
    truth.base.q_WF = quaternion_from_euler({0.0, 0.0, kPi / 2});  // nose east
    truth.base.v_WF_W_m_s = {0.0, 1.1, 0.2};                       // forward and down
    truth.base.w_WF_F_rad_s = {0.1, 0.2, 0.3};
    truth.slider = {-0.02, -0.5, -40.0};
    truth.cup_status.phase = CupPhase::attached;
    truth.cup_status.pressure_Pa = 80000.0;
    truth.cup_status.pull_N = 55.0;
    truth.cup_status.wrench_C = {{55.0, 1.0, -30.0}, {0.0, 2.0, 0.0}};
    truth.rotor_speed_rad_s = {1.0, 2.0, 3.0, 4.0};
    truth.thrust_N = 31.4;
    truth.battery.energy_used_J = 1234.0;
    record([&](Recorder& r) { r.truth(truth); });

    EXPECT_EQ(value("/truth/pose", "pose.position.x"), 2.0);  // east
    EXPECT_EQ(value("/truth/pose", "pose.position.y"), 1.0);  // north
    EXPECT_EQ(value("/truth/pose", "pose.position.z"), 3.0);  // up
    EXPECT_NEAR(value("/truth/pose", "pose.orientation.w"), 1.0, 1e-12);
    EXPECT_NEAR(value("/truth/twist", "twist.linear.x"), 1.1, 1e-12);  // forward
    EXPECT_NEAR(value("/truth/twist", "twist.linear.y"), 0.0, 1e-12);
    EXPECT_NEAR(value("/truth/twist", "twist.linear.z"), -0.2, 1e-12);  // up
    EXPECT_EQ(value("/truth/twist", "twist.angular.y"), -0.2);
    EXPECT_NEAR(value("/truth/vehicle", "yaw_rad"), kPi / 2, 1e-12);
    EXPECT_EQ(value("/truth/vehicle", "velocity_east_m_s"), 1.1);
    EXPECT_EQ(value("/truth/vehicle", "rate_down_rad_s"), 0.3);
    EXPECT_EQ(value("/truth/vehicle", "slider_force_N"), -40.0);
    EXPECT_EQ(value("/truth/vehicle", "rotor_speed_rad_s[3]"), 4.0);
    EXPECT_EQ(value("/truth/vehicle", "thrust_N"), 31.4);
    EXPECT_EQ(value("/truth/vehicle", "battery_energy_used_J"), 1234.0);
    EXPECT_EQ(value("/cup", "phase"), 3.0);
    EXPECT_EQ(value("/cup", "pressure_Pa"), 80000.0);
    EXPECT_EQ(value("/cup", "pull_N"), 55.0);
    EXPECT_EQ(value("/truth/cup_wrench", "wrench.force.x"), 55.0);
    EXPECT_EQ(value("/truth/cup_wrench", "wrench.force.y"), -1.0);
    EXPECT_EQ(value("/truth/cup_wrench", "wrench.force.z"), 30.0);
    EXPECT_EQ(value("/truth/cup_wrench", "wrench.torque.y"), -2.0);
}

TEST_F(Recorded, SetpointsOfEveryKind) {
    record([](Recorder& r) {
        r.setpoint(0.0, {});
        r.setpoint(1.0, {.motion = PositionSetpoint{{1, 2, 3}, 0.5, {4, 5, 6}}, .armed = true});
        r.setpoint(2.0, {.motion = VelocitySetpoint{{7, 8, 9}, 0.25, {0, 0, 1}}, .pump_on = true});
        r.setpoint(3.0, {.motion = AttitudeSetpoint{quaternion_from_euler({0, 1.1, 0.2}), 0.6},
                         .valve_open = true,
                         .hold_integrators = true});
    });
    const auto column = [&](const char* name) {
        return recording_.series("/setpoint", name).values;
    };
    EXPECT_THAT(column("mode"), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(column("armed"), ElementsAre(0, 1, 0, 0));
    EXPECT_THAT(column("pump_on"), ElementsAre(0, 0, 1, 0));
    EXPECT_THAT(column("hold_integrators"), ElementsAre(0, 0, 0, 1));
    EXPECT_EQ(column("position_down_m")[1], 3.0);
    EXPECT_EQ(column("velocity_east_m_s")[1], 5.0);
    EXPECT_EQ(column("velocity_north_m_s")[2], 7.0);
    EXPECT_EQ(column("acceleration_down_m_s2")[2], 1.0);
    EXPECT_NEAR(column("pitch_rad")[3], 1.1, 1e-12);
    EXPECT_EQ(column("thrust")[3], 0.6);
    EXPECT_TRUE(std::isnan(column("position_north_m")[2]));
    EXPECT_TRUE(std::isnan(column("thrust")[1]));
}

TEST_F(Recorded, EstimateGuidanceAndEvents) {
    record([](Recorder& r) {
        Estimate estimate;
        estimate.time_s = 0.5;
        estimate.p_WB_m = {1, 2, 3};
        estimate.v_WB_m_s = {1, 0, 0};
        estimate.variance.fill(0.04);
        estimate.variance[7] = 9.0;
        r.estimate(estimate);
        r.consistency({.time_s = 0.48,
                       .nees = 1.5,
                       .nees_of = {1.0, 2.0, 3.0, 4.0, 5.0},
                       .nis_of = {0.1, 0.2, 0.3, 0.4, 0.5, kNaN}});
        r.guidance(0.5, "dock", 2);
        r.event(make_event(0.5, "guidance", EventName::approach_started));
        r.event(make_event(0.75, "cup", EventName::attached, "sealed",
                           {{"pressure_Pa", 88000.0}, {"time_s", 0.15}}));
    });
    EXPECT_EQ(value("/estimate/pose", "pose.position.z"), -3.0);
    EXPECT_EQ(value("/estimate/twist", "twist.linear.x"), 1.0);
    EXPECT_EQ(value("/estimate/deviation", "position_north_m"), 0.2);
    EXPECT_EQ(value("/estimate/deviation", "attitude_right_rad"), 3.0);
    EXPECT_EQ(value("/estimate/deviation", "accelerometer_bias_down_m_s2"), 0.2);
    EXPECT_EQ(value("/estimate/consistency", "nees"), 1.5);
    EXPECT_EQ(value("/estimate/consistency", "position_nees"), 1.0);
    EXPECT_EQ(value("/estimate/consistency", "accelerometer_bias_nees"), 5.0);
    EXPECT_EQ(value("/estimate/consistency", "gps_position_nis"), 0.3);
    EXPECT_TRUE(std::isnan(value("/estimate/consistency", "magnetometer_nis")));
    EXPECT_EQ(value("/guidance", "attempt"), 2.0);
    EXPECT_EQ(recording_.table("/guidance").find_text("state")->values.back(), "dock");

    ASSERT_EQ(recording_.events.size(), 2u);
    EXPECT_EQ(recording_.events[0].name, "approach_started");
    EXPECT_TRUE(recording_.events[0].values.empty());
    const RecordedEvent& attached = recording_.events[1];
    EXPECT_EQ(attached.time_s, 0.75);
    EXPECT_EQ(attached.station, "cup");
    EXPECT_EQ(attached.reason, "sealed");
    EXPECT_THAT(attached.values, ElementsAre(std::pair<std::string, double>("pressure_Pa", 88000.0),
                                             std::pair<std::string, double>("time_s", 0.15)));
}

TEST_F(Recorded, SaysWhatItIs) {
    record([](Recorder& r) { r.guidance(0.0, "dock", 1); });
    EXPECT_EQ(recording_.metadata.at("limpet").at("scenario"), "perch_concrete");
    EXPECT_EQ(recording_.metadata.at("limpet").at("seed"), "42");
    EXPECT_EQ(recording_.metadata.at("limpet").at("version"), "0.1.0");
    EXPECT_EQ(recording_.attachment("model.xml")->text, "<mujoco/>\n");
    EXPECT_EQ(recording_.attachment("summary.json")->text, "{}");
    EXPECT_EQ(recording_.attachment("other"), nullptr);
}

TEST(Recorder, NewReadingsAreThoseSinceTheClockBegan) {
    const TestFolder folder;
    Readings readings;
    Readings last;
    {
        Recorder recorder(folder / "a.mcap", sample_info());
        readings.motion_capture = {-0.02, {}};  // arrived at once, measured before
        recorder.new_readings(readings, last);
        readings.motion_capture = {0.01, {}};
        recorder.new_readings(readings, last);
        recorder.finish("{}");
    }
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_EQ(recording.table("/sensors/motion_capture").time_s.size(), 1U);
}

TEST(Recorder, KeepsNumbersOfASensorThatNoTopicIsFor) {
    const TestFolder folder;
    constexpr std::array<std::string_view, 2> kColumns = {"air_degC", "slope_Pa"};
    RecordingInfo info = sample_info();
    info.columns = {{"/sensors/own", "limpet_msgs/msg/Own", kColumns}};
    {
        Recorder recorder(folder / "a.mcap", info);
        const std::array<double, 2> numbers = {21.5, -3.0};
        recorder.columns(0, Sample<int>{}, numbers);  // it has not come yet
        recorder.columns(0, Sample<int>{.time_s = 0.01}, numbers);
        recorder.columns(0, Sample<int>{.time_s = 0.01}, numbers);  // the same one
        recorder.columns(0, Sample<int>{.time_s = 0.02}, std::array{22.0, 0.0});
        recorder.finish("{}");
    }
    const Recording recording = read_recording(folder / "a.mcap");
    const Table& own = recording.table("/sensors/own");
    EXPECT_EQ(own.time_s, (std::vector<double>{0.01, 0.02}));
    EXPECT_EQ(own.find("air_degC")->values, (std::vector<double>{21.5, 22.0}));
    EXPECT_EQ(own.find("slope_Pa")->values, (std::vector<double>{-3.0, 0.0}));
}

TEST(Recorder, ASampleThatNeverCameIsAMistake) {
    const TestFolder folder;
    Recorder recorder(folder / "a.mcap", sample_info());
    EXPECT_THROW(recorder.imu({}), InternalError);
    EXPECT_THROW(recorder.guidance(std::nan(""), "dock", 0), InternalError);
}

}  // namespace
}  // namespace limpet::record
