// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "../support/allocations.hpp"
#include "watched.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

TEST_F(Watched, SendsEveryStreamAtItsRateOfSimulatedTime) {
    fly(501);  // 0 to 10 s, both ends included
    std::map<std::uint32_t, double> wanted;
    for (const Telemetry::Stream& row : Telemetry::kStreams) {
        wanted[row.message_id] += 10.0 * row.rate_Hz + 1.0;
    }
    std::map<std::uint32_t, double> heard;
    for (const auto& bytes : station_.frames) {
        heard[bytes[7] + 256U * bytes[8]] += 1.0;
    }
    EXPECT_EQ(heard, wanted);
    EXPECT_EQ(heard[Heartbeat::kId], 11.0);
    EXPECT_EQ(heard[DistanceSensor::kId], 202.0);
}

TEST_F(Watched, TimeThatLeapsIsNotCaughtUp) {
    fly(1);
    station_.forget();
    time_s_ = 100.0;
    telemetry_.update(view());
    telemetry_.update(view());
    EXPECT_EQ(station_.heard<Heartbeat>().size(), 1U);
    EXPECT_EQ(station_.heard<Attitude>().size(), 1U);
}

TEST_F(Watched, IsAPx4InOffboardArmedOrNot) {
    fly(1);
    Heartbeat beat = last<Heartbeat>();
    EXPECT_EQ(beat.type, 2);        // MAV_TYPE_QUADROTOR
    EXPECT_EQ(beat.autopilot, 12);  // MAV_AUTOPILOT_PX4
    EXPECT_EQ(beat.base_mode & 128, 128);
    EXPECT_EQ(beat.base_mode & 1, 1);
    EXPECT_EQ(beat.custom_mode, 6U << 16U);
    EXPECT_EQ(beat.system_status, 4);  // MAV_STATE_ACTIVE
    EXPECT_EQ(last<ExtendedSysState>().landed_state, 2);
    armed_ = false;
    fly(51);
    beat = last<Heartbeat>();
    EXPECT_EQ(beat.base_mode & 128, 0);
    EXPECT_EQ(beat.system_status, 3);
    EXPECT_EQ(last<ExtendedSysState>().landed_state, 1);
}

TEST_F(Watched, AttitudeAndPlaceByHand) {
    // Yaw 90 deg: q = (cos 45, 0, 0, sin 45).
    estimate_.q_WB = Quaternion(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
    fly(1);
    EXPECT_NEAR(last<Attitude>().yaw, kPi / 2, 1e-6);
    EXPECT_EQ(last<GlobalPositionInt>().hdg, 9000);
    EXPECT_NEAR(last<HomePosition>().x, 1.0, 1e-6);

    estimate_.p_WB_m = {101.0, -52.0, -3.5};
    estimate_.v_WB_m_s = {0.5, -0.25, 0.125};
    fly(10);
    const auto place = last<GlobalPositionInt>();
    // A degree of latitude is pi/180 x 6371 km, one of longitude less by the cosine.
    const double degree_m = kPi / 180.0 * 6371000.0;
    EXPECT_NEAR(place.lat, 1e7 * (47.397742 + 101.0 / degree_m), 2.0);
    EXPECT_NEAR(place.lon, 1e7 * (8.545594 - 52.0 / (degree_m * std::cos(47.397742 * kPi / 180.0))),
                2.0);
    EXPECT_EQ(place.alt, 3500);           // the origin is at sea level
    EXPECT_EQ(place.relative_alt, 3000);  // home is half a metre up
    EXPECT_EQ(place.vx, 50);
    EXPECT_EQ(place.vy, -25);
    EXPECT_EQ(place.vz, 13);
    EXPECT_NEAR(last<LocalPositionNed>().y, -52.0, 1e-5);
    EXPECT_NEAR(last<LocalPositionNed>().vz, 0.125, 1e-7);
    EXPECT_NEAR(last<HomePosition>().x, 1.0, 1e-6) << "home stays";
}

TEST_F(Watched, WithoutAValidEstimateThereIsNoPlace) {
    estimate_.valid = false;
    fly(50);
    EXPECT_THAT(station_.heard<LocalPositionNed>(), IsEmpty());
    EXPECT_THAT(station_.heard<GlobalPositionInt>(), IsEmpty());
    EXPECT_THAT(station_.heard<HomePosition>(), IsEmpty());
    EXPECT_FALSE(station_.heard<Attitude>().empty());
    EXPECT_EQ(last<SysStatus>().onboard_control_sensors_health & 0x200000U, 0U);
}

TEST_F(Watched, BatteryAndLidarsByHand) {
    fly(1);
    const auto battery = last<mavlink::BatteryStatus>();
    EXPECT_EQ(battery.voltages[0], 3700);  // 22.2 V over 6 cells
    EXPECT_EQ(battery.voltages[5], 3700);
    EXPECT_EQ(battery.voltages[6], 65535);
    EXPECT_EQ(battery.current_battery, 2050);
    EXPECT_EQ(battery.battery_remaining, 76);
    EXPECT_EQ(last<SysStatus>().voltage_battery, 22200);
    const auto lidars = station_.heard<DistanceSensor>();
    ASSERT_EQ(lidars.size(), 2U);
    EXPECT_EQ(lidars[0].id, 0);
    EXPECT_EQ(lidars[0].current_distance, 123);
    EXPECT_EQ(lidars[0].max_distance, 1200);
    EXPECT_EQ(lidars[1].id, 1);
    EXPECT_EQ(lidars[1].current_distance, 0) << "no echo";
}

TEST_F(Watched, ASilentSensorIsIll) {
    fly(1);
    constexpr std::uint32_t kGyro = 0x1, kLaser = 0x100, kGps = 0x20;
    EXPECT_EQ(last<SysStatus>().onboard_control_sensors_health & (kGyro | kLaser), kGyro | kLaser);
    EXPECT_EQ(last<SysStatus>().onboard_control_sensors_present & kGps, 0U);
    fly(110);  // the LiDARs have been silent for 2 s; the gyro has not
    EXPECT_EQ(last<SysStatus>().onboard_control_sensors_health & (kGyro | kLaser), kGyro);
    EXPECT_EQ(last<SysStatus>().onboard_control_sensors_present & kLaser, kLaser);
}

TEST_F(Watched, EventsAreTextsWithTheirValues) {
    telemetry_.event(make_event(1.0, "cup", EventName::attached, "", {{"force_N", -21.345}}));
    telemetry_.event(make_event(2.0, "guidance", EventName::aborted, "stale"));
    const auto texts = station_.heard<StatusText>();
    ASSERT_EQ(texts.size(), 2U);
    EXPECT_EQ(text_of(texts[0].text), "attached, force_N -21.34");
    EXPECT_EQ(texts[0].severity, 6);
    EXPECT_EQ(texts[0].id, 0);
    EXPECT_EQ(text_of(texts[1].text), "aborted: stale");
    EXPECT_EQ(texts[1].severity, 4);
}

/// Puts chunks together as the protocol says: until one with a NUL.
std::vector<std::string> whole_texts(const std::vector<StatusText>& chunks) {
    std::vector<std::string> texts;
    std::string text;
    for (const StatusText& chunk : chunks) {
        text += text_of(chunk.text);
        if (chunk.id == 0 || text_of(chunk.text).size() < chunk.text.size()) {
            texts.push_back(text);
            text.clear();
        }
    }
    return texts;
}

TEST_F(Watched, LongTextsComeInChunks) {
    std::vector<std::string> sent;
    for (const std::size_t length : {0U, 1U, 49U, 50U, 51U, 99U, 100U, 101U, 349U}) {
        std::string text;
        for (std::size_t i = 0; i < length; ++i) {
            text += static_cast<char>('a' + i % 26);
        }
        telemetry_.text(Severity::info, text);
        sent.push_back(text);
    }
    const auto chunks = station_.heard<StatusText>();
    EXPECT_EQ(whole_texts(chunks), sent);
    EXPECT_EQ(chunks[4].id, 1);  // the first that is longer than 50
    EXPECT_EQ(chunks[4].chunk_seq, 0);
    EXPECT_EQ(chunks[5].id, 1);
    EXPECT_EQ(chunks[5].chunk_seq, 1);
}

TEST_F(Watched, SaysWhoItIsWhenAsked) {
    fly(1);
    EXPECT_EQ(command(512, 148.0F).result, 0);
    const auto version = last<AutopilotVersion>();
    EXPECT_EQ(version.flight_sw_version, 0x00010000U);
    EXPECT_EQ(version.capabilities & 8192U, 8192U);  // MAVLink 2
    EXPECT_EQ(command(520, 1.0F).result, 0);
    EXPECT_EQ(station_.heard<AutopilotVersion>().size(), 1U);
    EXPECT_EQ(command(512, 242.0F).result, 0);
    EXPECT_EQ(station_.heard<HomePosition>().size(), 1U);
}

TEST_F(Watched, WhatItDoesNotDoItSaysSo) {
    fly(1);
    for (const int order : {400, 176, 22, 21, 20, 511, 512}) {  // arm, mode, take off ...
        const CommandAck ack = command(static_cast<std::uint16_t>(order), 1.0e6F);
        EXPECT_EQ(ack.command, order);
        EXPECT_EQ(ack.result, 3) << order;  // MAV_RESULT_UNSUPPORTED
        EXPECT_EQ(ack.target_system, 255);
        EXPECT_EQ(ack.target_component, kGroundStationComponent);
    }
    station_.forget();
    station_.ask(CommandLong{.target_system = 2, .target_component = 1, .command = 400});
    fly(1);
    EXPECT_THAT(station_.heard<CommandAck>(), IsEmpty()) << "not for us";
}

TEST_F(Watched, RatesCanBeAskedFor) {
    fly(1);
    EXPECT_EQ(command(511, 30.0F, 500000.0F).result, 0);  // ATTITUDE at 2 Hz
    station_.forget();
    fly(500);
    EXPECT_EQ(station_.heard<Attitude>().size(), 20U);
    EXPECT_EQ(command(511, 30.0F, -1.0F).result, 0);
    station_.forget();
    fly(100);
    EXPECT_THAT(station_.heard<Attitude>(), IsEmpty());
    EXPECT_EQ(command(511, 30.0F, 0.0F).result, 0);
    station_.forget();
    fly(500);
    EXPECT_NEAR(static_cast<double>(station_.heard<Attitude>().size()), 200.0, 1.0);
    EXPECT_EQ(command(511, 0.0F, -1.0F).result, 2) << "never without a heartbeat";
    EXPECT_EQ(command(511, 30.0F, std::nanf("")).result, 2);
}

TEST_F(Watched, AnswersTimeSyncPingAndMissionRequests) {
    fly(100);  // now it is 2 s
    station_.forget();
    station_.ask(TimeSync{.tc1 = 0, .ts1 = 123456789});
    station_.ask(TimeSync{.tc1 = 5, .ts1 = 6});  // an answer, to somebody else's question
    station_.ask(Ping{.time_usec = 77, .seq = 9});
    station_.ask(Ping{.time_usec = 78, .seq = 10, .target_system = 3, .target_component = 1});
    station_.ask(MissionRequestList{.target_system = 1, .target_component = 1, .mission_type = 2});
    fly(1);
    const auto times = station_.heard<TimeSync>();
    ASSERT_EQ(times.size(), 1U);
    EXPECT_EQ(times[0].tc1, 2'000'000'000);
    EXPECT_EQ(times[0].ts1, 123456789);
    const auto pings = station_.heard<Ping>();
    ASSERT_EQ(pings.size(), 1U);
    EXPECT_EQ(pings[0].seq, 9U);
    EXPECT_EQ(pings[0].target_system, 255);
    const auto missions = station_.heard<MissionCount>();
    ASSERT_EQ(missions.size(), 1U);
    EXPECT_EQ(missions[0].count, 0);
    EXPECT_EQ(missions[0].mission_type, 2);
}

TEST_F(Watched, ParametersAreServedAndRefusalsTold) {
    fly(1);
    station_.forget();
    station_.ask(ParamRequestList{.target_system = 1});
    ParamSet set{.target_system = 1, .param_value = 9.0F, .param_type = 9};
    set_text(set.param_id, "MPC_XY_P");
    station_.ask(set);
    set.param_value = 1.5F;
    station_.ask(set);
    station_.ask(SetupSigning{.target_system = 1, .target_component = 1});
    fly(1);
    EXPECT_EQ(station_.heard<ParamValue>().size(), 3U);
    EXPECT_THAT(sets_, ElementsAre(testing::Pair("MPC_XY_P", 1.5)));
    EXPECT_THAT(
        whole_texts(station_.heard<StatusText>()),
        ElementsAre("MPC_XY_P = 9 refused, allowed 0 .. 2", HasSubstr("SETUP_SIGNING refused")));
}

TEST_F(Watched, NobodyThereCostsNothing) {
    const std::uint16_t port = station_.ground.transport().address().port;
    station_.ground = Link(open_transport({.medium = wire::Medium::udp}, wire::Role::listen), {});
    ASSERT_NE(station_.ground.transport().address().port, port);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 5000; ++i) {  // refused by the kernel, one after the other
        telemetry_.update(view());
        time_s_ = 0.02 * ++updates_;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(Watched, NothingIsAllocated) {
    fly(1);
    station_.ask(ParamRequestList{.target_system = 1});
    station_.ask(CommandLong{.target_system = 1, .command = 512, .param1 = 148.0F});
    const Event event = make_event(1.0, "cup", EventName::attached, "at last",
                                   {{"force_N", -21.3}, {"pressure_Pa", 95000.0}});
    const long before = allocations();
    for (int i = 0; i < 200; ++i) {
        telemetry_.update(view());
        time_s_ = 0.02 * ++updates_;
    }
    telemetry_.event(event);
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace limpet::ground_station
