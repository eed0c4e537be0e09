// SPDX-License-Identifier: Apache-2.0
#include "limpet/surroundings/remote_guidance.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <map>

#include "limpet/devices/natnet_client.hpp"
#include "limpet/devices/tfmini.hpp"
#include "limpet/mavlink/mission_report.hpp"
#include "limpet/mavlink/translate.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::surroundings {
namespace {

using namespace std::chrono_literals;

constexpr mavlink::Sender kCompanion{.system = 1, .component = mavlink::kCompanionComponent};

Readings some_readings(double time_s) {
    Readings readings;
    readings.motion_capture = {
        time_s - 0.008,
        {.p_WB_m = {1.0, -2.0, -3.0}, .q_WB = quaternion_from_euler({0.1, 0.2, 0.3})}};
    readings.lidar_left = {time_s, {.distance_m = 1.23, .valid = true}};
    readings.lidar_right = {time_s, {.distance_m = 2.34, .valid = true}};
    readings.force = {time_s, {.axial_N = -12.5}};
    readings.cup_pressure = {time_s, {.pressure_Pa = 61500.0}};
    return readings;
}

/// A companion's end over loopback.
struct Companion {
    mavlink::Link link{open_transport({.medium = wire::Medium::udp, .port = 0}, wire::Role::listen),
                       kCompanion};

    [[nodiscard]] std::unique_ptr<mavlink::Link> outside() const {
        return std::make_unique<mavlink::Link>(
            open_transport(link.transport().address(), wire::Role::connect),
            mavlink::Sender{.system = 1, .component = mavlink::kMechanismComponent});
    }
};

struct RemoteGuidanceOverMavlink : testing::Test {
    Companion companion;
    RemoteGuidance remote{{.sensors = companion.outside()}, {}};
    guidance::PerchingMemory guidance;
    guidance::EventList events;
    std::vector<EventName> told;
    double time_s = 5.0;

    void tick(const Readings& readings = {}) {
        events.count = 0;
        remote.exchange(readings, {}, time_s, guidance, events);
        for (std::size_t i = 0; i < events.count; ++i) {
            told.push_back(events.events[i].name);
        }
        time_s += kTick_s;
    }
    /// Ticks until it is so; five seconds are for a machine in need.
    bool until(const std::function<bool()>& so) {
        const auto end = std::chrono::steady_clock::now() + 5s;
        while (!so() && std::chrono::steady_clock::now() < end) {
            tick();
        }
        return so();
    }
    /// The companion must have heard somebody before it can answer.
    void meet() {
        tick();
        ASSERT_TRUE(companion.link.receive(5s));
    }
    /// Among heartbeats.
    std::optional<mavlink::CommandAck> answer() {
        while (const auto frame = companion.link.receive(200ms)) {
            if (const auto ack = mavlink::decode<mavlink::CommandAck>(*frame)) {
                return ack;
            }
        }
        return std::nullopt;
    }
    void say(std::string_view text) {
        splitter.split(mavlink::MavSeverity::info, text, [this](const mavlink::StatusText& piece) {
            (void)companion.link.send(piece);
        });
    }
    mavlink::TextSplitter splitter;
    void command(float pump, float valve, std::uint8_t component = mavlink::kMechanismComponent) {
        mavlink::CommandLong message =
            mavlink::actuator_command({.pump_on = pump > 0, .valve_open = valve > 0}, 1, 0);
        message.target_component = component;
        ASSERT_EQ(companion.link.send(message), wire::TransferStatus::done);
    }
};

TEST_F(RemoteGuidanceOverMavlink, EachNewReadingGoesOutOnce) {
    const Readings readings = some_readings(time_s);
    for (int i = 0; i < 20; ++i) {
        tick(readings);
    }
    std::map<std::uint32_t, int> count;
    while (const auto frame = companion.link.receive(200ms)) {
        ++count[frame->id];
        if (const auto range = mavlink::decode<mavlink::DistanceSensor>(*frame)) {
            const RangeReading reading = mavlink::range_reading(*range);
            EXPECT_NEAR(reading.distance_m, range->id == 0 ? 1.23 : 2.34, 1e-9);
        }
        if (const auto value = mavlink::decode<mavlink::NamedValueFloat>(*frame)) {
            EXPECT_EQ(value->value,
                      mavlink::text_of(value->name) == mavlink::kForceName ? -12.5F : 615.0F);
        }
        if (const auto odometry = mavlink::decode<mavlink::Odometry>(*frame)) {
            const auto pose = mavlink::pose_reading(*odometry);
            ASSERT_TRUE(pose);
            EXPECT_LT((pose->p_WB_m - Vector3(1.0, -2.0, -3.0)).norm(), 1e-6);
        }
    }
    EXPECT_EQ(count[mavlink::DistanceSensor::kId], 2);
    EXPECT_EQ(count[mavlink::NamedValueFloat::kId], 2);
    EXPECT_EQ(count[mavlink::Odometry::kId], 1);
}

TEST_F(RemoteGuidanceOverMavlink, PumpAndValveObeyAreAnsweredAndKeepTheirStateInSilence) {
    meet();
    command(1.0F, 0.0F);
    EXPECT_TRUE(until([&] { return guidance.setpoint.pump_on; }));
    EXPECT_FALSE(guidance.setpoint.valve_open);
    const auto ack = answer();
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->command, mavlink::MavCmd::do_set_actuator);
    EXPECT_EQ(ack->result, 0);
    EXPECT_EQ(ack->target_component, kCompanion.component);

    for (int i = 0; i < 10000; ++i) {  // ten seconds of silence, simulated
        tick();
    }
    EXPECT_TRUE(guidance.setpoint.pump_on);
    guidance = {};  // a flight begins: the mechanism has not changed
    tick();
    EXPECT_TRUE(guidance.setpoint.pump_on);

    command(0.0F, 1.0F);
    EXPECT_TRUE(until([&] { return guidance.setpoint.valve_open; }));
    EXPECT_FALSE(guidance.setpoint.pump_on);
}

TEST_F(RemoteGuidanceOverMavlink, CommandsToOthersSwitchNothing) {
    meet();
    command(1.0F, 1.0F, mavlink::kAutopilotComponent);
    EXPECT_TRUE(until([&] { return remote.count().refused == 1; }));
    EXPECT_FALSE(guidance.setpoint.pump_on);
    EXPECT_FALSE(answer());
}

TEST_F(RemoteGuidanceOverMavlink, WhatTheCompanionTellsBecomesEventsStateAndOutcome) {
    EXPECT_NE(remote.obstacle(), "");
    meet();
    const Event approach = make_event(9.0, "guidance", EventName::approach_started, "aligned");
    say(mavlink::event_text(approach).view());
    (void)companion.link.send(
        mavlink::guidance_state(static_cast<int>(guidance::PerchingState::approaching), 0));
    (void)companion.link.send(mavlink::guidance_state(200, 0));  // none of ours
    const std::string reason = "backed off, and this is said in more than one text of MAVLink";
    say(mavlink::outcome_text(Outcome::released, reason).view());
    EXPECT_TRUE(until([&] { return guidance.ending.has_value(); }));
    EXPECT_EQ(told, std::vector{EventName::approach_started});
    EXPECT_EQ(guidance.state, guidance::PerchingState::approaching);
    EXPECT_EQ(guidance.attempt, 1);
    EXPECT_EQ(guidance.ending->outcome, Outcome::released);
    EXPECT_EQ(guidance.ending->reason, reason);
    EXPECT_EQ(remote.obstacle(), "");
}

TEST_F(RemoteGuidanceOverMavlink, ACompanionThatHandsBackEndsItWithItsLastWords) {
    meet();
    mavlink::StatusText words;
    mavlink::set_text(words.text, "handed back: pose stale, in the air");
    (void)companion.link.send(words);
    mavlink::Heartbeat last;
    last.system_status = mavlink::MavState::poweroff;
    (void)companion.link.send(last);
    EXPECT_TRUE(until([&] { return guidance.ending.has_value(); }));
    EXPECT_EQ(guidance.ending->outcome, Outcome::timed_out);
    EXPECT_EQ(guidance.ending->reason, "handed back: pose stale, in the air");
}

TEST_F(RemoteGuidanceOverMavlink, AnOutcomeWhoseLastPieceIsLostIsStillOne) {
    meet();
    int pieces = 0;
    splitter.split(mavlink::MavSeverity::info,
                   mavlink::outcome_text(Outcome::release_aborted, std::string(60, 'x')).view(),
                   [&](const mavlink::StatusText& piece) {
                       if (++pieces == 1) {
                           (void)companion.link.send(piece);
                       }
                   });
    EXPECT_EQ(pieces, 2);
    mavlink::Heartbeat last;
    last.system_status = mavlink::MavState::poweroff;
    (void)companion.link.send(last);
    EXPECT_TRUE(until([&] { return guidance.ending.has_value(); }));
    EXPECT_EQ(guidance.ending->outcome, Outcome::release_aborted);
    EXPECT_EQ(guidance.ending->reason, std::string(50 - 26, 'x') + "...");
}

TEST_F(RemoteGuidanceOverMavlink, AFloodOfEventsIsTakenInPiecesNoneLost) {
    meet();
    for (int i = 0; i < 50; ++i) {
        say(mavlink::event_text(make_event(1.0, "guidance", EventName::impact)).view());
    }
    EXPECT_TRUE(until([&] { return told.size() == 50; }));
}

TEST(RemoteGuidanceOverDevices, PosesGoByNatNetWithTheirAge) {
    const Companion companion;
    auto command = open_transport({.medium = wire::Medium::udp, .port = 0}, wire::Role::listen);
    const devices::MocapAxes axes{.up = devices::UpAxis::y, .x_axis_yaw_deg = 30.0};
    devices::NatNetClient motive({.body_id = 4, .axes = axes}, nullptr,
                                 open_transport(command->address(), wire::Role::connect));
    RemoteGuidance remote({.sensors = companion.outside(),
                           .motion_capture = std::make_unique<devices::NatNetSource>(
                               devices::NatNetServer{.version = {4, 1}, .clock_Hz = 1000000},
                               nullptr, std::move(command))},
                          {.axes = axes, .rigid_body = 4});
    guidance::PerchingMemory guidance;
    guidance::EventList events;
    double time_s = 5.0;
    motive.update(0.0);
    std::optional<Sample<PoseReading>> pose;
    const auto end = std::chrono::steady_clock::now() + 5s;
    while (!pose && std::chrono::steady_clock::now() < end) {
        time_s += 0.01;
        remote.exchange(some_readings(time_s), {}, time_s, guidance, events);
        pose = motive.receive(100.0);
    }
    ASSERT_TRUE(pose);
    const PoseReading sent = some_readings(time_s).motion_capture.value;
    EXPECT_LT((pose->value.p_WB_m - sent.p_WB_m).norm(), 1e-5);  // floats on the wire
    EXPECT_LT(pose->value.q_WB.angularDistance(sent.q_WB), 1e-5);
    EXPECT_GT(pose->time_s, 100.0 - 0.0081);
    EXPECT_LE(pose->time_s, 100.0);
}

TEST(RemoteGuidanceOverDevices, LidarsAndMechanismHangOnSerialPorts) {
    const Companion companion;
    const auto folder =
        std::filesystem::temp_directory_path() / ("limpet_outside_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    RemoteGuidance remote({.sensors = companion.outside(),
                           .lidar_left = wire::open_pseudo_terminal(folder / "left"),
                           .lidar_right = wire::open_pseudo_terminal(folder / "right"),
                           .mechanism = wire::open_pseudo_terminal(folder / "mechanism")},
                          {});
    const auto port = [&](const char* name) {
        return open_transport(
            {.medium = wire::Medium::serial, .device = (folder / name).string(), .baud = 115200},
            wire::Role::connect);
    };
    const auto left = port("left");
    const auto mechanism = port("mechanism");
    devices::MechanismBuffer buffer;
    const auto line = devices::encode({.pump_on = true, .valve_open = false}, buffer);
    ASSERT_EQ(mechanism->send(std::as_bytes(std::span(line)), 1s).status,
              wire::TransferStatus::done);

    guidance::PerchingMemory guidance;
    guidance::EventList events;
    double time_s = 5.0;
    const auto end = std::chrono::steady_clock::now() + 5s;
    while (!guidance.setpoint.pump_on && std::chrono::steady_clock::now() < end) {
        time_s += 0.01;
        remote.exchange(some_readings(time_s), {}, time_s, guidance, events);
    }
    ASSERT_TRUE(guidance.setpoint.pump_on);
    remote.exchange(some_readings(time_s + 0.01), {}, time_s + 0.01, guidance, events);

    std::array<std::byte, 4000> in;
    devices::TfminiParser parser;
    std::optional<devices::TfminiFrame> frame;
    for (std::size_t i = 0, n = left->receive(in, 5s).bytes; i < n; ++i) {
        if (const auto next = parser.parse(in[i])) {
            frame = next;
        }
    }
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->distance_cm, 123);

    devices::MechanismParser lines;
    std::optional<devices::MechanismLine> last;
    while (!last || last->pump_on != true) {
        const wire::Transfer transfer = mechanism->receive(in, 5s);
        ASSERT_EQ(transfer.status, wire::TransferStatus::done);
        for (std::size_t i = 0; i < transfer.bytes; ++i) {
            if (const auto next = lines.parse(in[i])) {
                last = next;
            }
        }
    }
    EXPECT_EQ(last->force_N, -12.5);
    EXPECT_EQ(last->pressure_Pa, 61500.0);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace limpet::surroundings
