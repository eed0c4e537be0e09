// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstring>

#include "limpet/mavlink/translate.hpp"
#include "offboard_peer.hpp"

namespace limpet::mavlink {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Offboard, StreamsBeforeItAsksForTheModeAndArmsOnlyInIt) {
    Peer peer;
    EXPECT_EQ(peer.offboard.state(0.0), OffboardState::silent);
    peer.run(0.9);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::streaming);
    EXPECT_THAT(peer.commands(MavCmd::do_set_mode), IsEmpty()) << "set-points first, for a second";
    EXPECT_GE(peer.wire.sent<SetPositionTargetLocalNed>().size(), 40U);
    peer.run(1.0);
    ASSERT_FALSE(peer.commands(MavCmd::do_set_mode).empty());
    EXPECT_EQ(peer.commands(MavCmd::do_set_mode)[0].param2, 6.0F);
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), IsEmpty());
    peer.mode = kMainModeOffboard;
    peer.beat();
    peer.run(0.1);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::engaged);
    ASSERT_FALSE(peer.commands(MavCmd::component_arm_disarm).empty());
    EXPECT_EQ(peer.commands(MavCmd::component_arm_disarm)[0].param1, 1.0F);
    EXPECT_EQ(peer.commands(MavCmd::component_arm_disarm)[0].param2, 0.0F)
        << "arming is never forced";
}

TEST(Offboard, StreamsFarAboveTheRateThatPx4Asks) {
    Peer peer;
    peer.engage();
    peer.forget();
    peer.run(1.0);
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>().size(),
                testing::AllOf(testing::Ge(48U), testing::Le(51U)));
}

TEST(Offboard, LeavesTheModeToAnOperatorWhenTold) {
    OffboardOptions options;
    options.asks_for_mode = false;
    Peer peer(options);
    peer.run(5.0);
    EXPECT_THAT(peer.commands(MavCmd::do_set_mode), IsEmpty());
    EXPECT_THAT(peer.offboard.obstacle(peer.time_s), HasSubstr("waits for the mode OFFBOARD"));
    peer.mode = kMainModeOffboard;
    peer.run(1.1);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::engaged);
}

TEST(Offboard, DisarmsByForceAndStreamsAttitudeWithoutThrustMeanwhile) {
    Peer peer;
    peer.engage();
    peer.armed = true;
    peer.run(1.1);
    peer.forget();
    peer.setpoint.armed = false;
    peer.run(0.5);
    const auto commands = peer.commands(MavCmd::component_arm_disarm);
    ASSERT_FALSE(commands.empty());
    EXPECT_EQ(commands[0].param1, 0.0F);
    EXPECT_EQ(commands[0].param2, kForce) << "PX4 denies it off the ground otherwise";
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>(), IsEmpty()) << "it would pry";
    for (const auto& target : peer.wire.sent<SetAttitudeTarget>()) {
        EXPECT_EQ(target.thrust, 0.0F);
    }
    EXPECT_GE(peer.wire.sent<SetAttitudeTarget>().size(), 24U);
}

/// PX4's position controller keeps its integral through a rest unless it is used while disarmed.
TEST(Offboard, HasAPositionControllerForgetTheWindOnceItIsDisarmed) {
    Peer peer;
    peer.engage();
    EXPECT_GT(peer.wire.sent<SetPositionTargetLocalNed>().size(), 50U);
    peer.armed = true;
    peer.run(1.1);
    peer.setpoint.armed = false;
    peer.armed = false;
    peer.beat();
    peer.forget();
    peer.run(3.0);
    const auto still = peer.wire.sent<SetPositionTargetLocalNed>();
    EXPECT_NEAR(static_cast<double>(still.size()), 50.0, 2.0);
    for (const auto& target : still) {
        EXPECT_EQ(target.vx, 0.0F);
        EXPECT_EQ(target.vy, 0.0F);
        EXPECT_EQ(target.vz, 0.0F);
    }
    EXPECT_EQ(peer.wire.sent<SetAttitudeTarget>().size() + still.size(), 150U);
    peer.forget();
    peer.setpoint.armed = true;
    peer.setpoint.motion = AttitudeSetpoint{};
    peer.run(0.5);
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>(), IsEmpty());
}

TEST(Offboard, RepeatsArmingUntilItIsSo) {
    Peer peer;
    peer.engage();
    peer.forget();
    peer.run(1.0);
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), SizeIs(testing::Ge(3U)));
    CommandAck ack;
    ack.command = MavCmd::component_arm_disarm;
    ack.result = 1;
    peer.wire.say(ack);
    StatusText text;
    set_text(text.text, "Preflight Fail: pitched");
    peer.wire.say(text);
    peer.run(0.1);
    EXPECT_THAT(peer.offboard.obstacle(peer.time_s), HasSubstr("Preflight Fail: pitched"));
    EXPECT_THAT(peer.offboard.obstacle(peer.time_s), HasSubstr("refused arming"));
    peer.armed = true;
    peer.beat();
    peer.run(0.1);
    peer.forget();
    peer.run(1.0);
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), IsEmpty());
    EXPECT_THAT(peer.offboard.obstacle(peer.time_s), IsEmpty());
}

TEST(Offboard, AnotherModeTakesTheVehicleAwayForGood) {
    Peer peer;
    peer.engage();
    peer.mode = 4;
    peer.beat();
    peer.run(0.1);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::taken_away);
    peer.forget();
    peer.run(2.0);
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>(), IsEmpty());
    EXPECT_THAT(peer.wire.sent<CommandLong>(), IsEmpty()) << "nobody is overruled";
    EXPECT_FALSE(peer.wire.sent<Heartbeat>().empty());
}

TEST(Offboard, HandingBackStopsSetPointsAndAsksForHold) {
    Peer peer;
    peer.engage();
    peer.armed = true;
    peer.run(1.1);
    peer.forget();
    peer.offboard.hand_back(peer.wire.link, peer.time_s);
    peer.run(1.0);
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>(), IsEmpty());
    const auto modes = peer.commands(MavCmd::do_set_mode);
    ASSERT_FALSE(modes.empty());
    EXPECT_EQ(modes[0].param2, 4.0F);
    EXPECT_EQ(modes[0].param3, 3.0F);
}

TEST(Offboard, HandingBackDoesNotTakeTheModeFromAnOperatorAgain) {
    for (const bool by_answer : {true, false}) {  // which comes before the next heartbeat
        Peer peer;
        peer.engage();
        peer.armed = true;
        peer.run(1.1);
        peer.offboard.hand_back(peer.wire.link, peer.time_s);
        if (by_answer) {
            CommandAck ack;
            ack.command = MavCmd::do_set_mode;
            peer.wire.say(ack);
        } else {
            peer.mode = 3;
            peer.beat();
        }
        peer.hear_all();
        peer.forget();
        for (int k = 0; k < 100; ++k) {
            peer.time_s += 0.02;
            peer.offboard.hand_back(peer.wire.link, peer.time_s);
        }
        EXPECT_THAT(peer.commands(MavCmd::do_set_mode), IsEmpty()) << by_answer;
    }
}

TEST(Offboard, HandingBackAsksForHoldUntilItIsSo) {
    Peer peer;
    peer.engage();
    peer.armed = true;
    peer.run(1.1);
    peer.forget();
    for (int k = 0; k < 100; ++k) {
        peer.time_s += 0.02;
        peer.offboard.hand_back(peer.wire.link, peer.time_s);
    }
    EXPECT_THAT(peer.commands(MavCmd::do_set_mode),
                SizeIs(testing::AllOf(testing::Ge(6), testing::Le(8))));
}

TEST(Offboard, OneThatFliesUsAndFallsSilentIsFlownOn) {
    Peer peer;
    peer.engage();
    peer.armed = true;
    peer.run(1.1);
    peer.beats = peer.tells_pose = false;
    peer.run(3.5);
    ASSERT_EQ(peer.offboard.state(peer.time_s), OffboardState::silent);
    peer.forget();
    peer.run(1.0);
    EXPECT_GE(peer.wire.sent<SetPositionTargetLocalNed>().size(), 48U)
        << "it may still hear: after a second without set-points it would hold";
    EXPECT_THAT(peer.commands(MavCmd::do_set_mode), IsEmpty());
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), IsEmpty());
}

TEST(Offboard, OneThatWasTakenAwayAndFallsSilentIsLeftAlone) {
    Peer peer;
    peer.engage();
    peer.mode = 3;
    peer.beat();
    peer.run(0.1);
    peer.beats = false;
    peer.run(3.5);
    ASSERT_EQ(peer.offboard.state(peer.time_s), OffboardState::silent);
    peer.forget();
    peer.run(1.0);
    EXPECT_THAT(peer.wire.sent<SetPositionTargetLocalNed>(), IsEmpty());
}

TEST(Offboard, AModeThatStoodBeforeTheFirstSetPointCanBeTakenAwayAtTheNextHeartbeat) {
    Peer peer;
    peer.mode = kMainModeOffboard;
    peer.run(0.5);  // a single heartbeat, before the stream
    ASSERT_EQ(peer.offboard.state(peer.time_s), OffboardState::engaged);
    peer.mode = 3;
    peer.beat();
    peer.hear_all();
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::taken_away);
}

TEST(Offboard, APoseThatFailedByItsOwnAccountIsNone) {
    Peer peer;
    peer.engage();
    peer.tells_pose = false;
    peer.run(0.3);
    Estimate estimate;
    estimate.valid = false;
    peer.wire.say(odometry(estimate, 1));
    peer.hear_all();
    EXPECT_FALSE(peer.offboard.estimate(peer.time_s).valid);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::unready);
}

TEST(Offboard, AnswersToAGroundStationAreNotTakenForItsOwn) {
    Peer peer;
    peer.engage();
    peer.run(0.5);
    ASSERT_FALSE(peer.commands(MavCmd::component_arm_disarm).empty());
    peer.armed = true;
    peer.run(1.1);
    peer.armed = false;
    peer.beat();
    peer.hear_all();
    CommandAck ack;  // to the operator who has just disarmed
    ack.command = MavCmd::component_arm_disarm;
    ack.target_system = 255;
    ack.target_component = kGroundStationComponent;
    peer.wire.say(ack);
    peer.hear_all();
    EXPECT_FALSE(peer.offboard.report().armed);
    ack.target_component = kCompanionComponent;  // the script's own name
    peer.wire.say(ack);
    peer.hear_all();
    EXPECT_TRUE(peer.offboard.report().armed);
}

TEST(Offboard, AnOldPoseIsNotValidAndASilentAutopilotIsNoticed) {
    Peer peer;
    peer.engage();
    EXPECT_TRUE(peer.offboard.estimate(peer.time_s).valid);
    EXPECT_EQ(peer.offboard.estimate(peer.time_s).p_WB_m, Vector3(1.0, 2.0, -3.0));
    peer.tells_pose = false;
    peer.run(0.3);
    EXPECT_FALSE(peer.offboard.estimate(peer.time_s).valid);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::unready);
    peer.beats = false;
    peer.run(3.5);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::silent);
}

/// The cause is in the text before the last, and in the health of its parts.
TEST(Offboard, WhatKeepsItFromArmingIsNamedWithItsCause) {
    Peer peer;
    peer.engage();
    const auto say = [&peer](const char* words, std::uint8_t severity) {
        StatusText text{.severity = severity};
        set_text(text.text, words);
        peer.wire.say(text);
    };
    say("Preflight Fail: Baro Sensor 0 missing", MavSeverity::error);
    say("Arming denied: see the health report", MavSeverity::error);
    say("[logger] a file", MavSeverity::info);
    const std::uint32_t used =
        MavSysStatusSensor::absolute_pressure | MavSysStatusSensor::sensor_3d_gyro;
    peer.wire.say(SysStatus{.onboard_control_sensors_enabled = used,
                            .onboard_control_sensors_health = MavSysStatusSensor::sensor_3d_gyro});
    peer.run(0.1);
    EXPECT_EQ(peer.offboard.obstacle(peer.time_s),
              "not armed yet; not healthy: barometer; it reported \"Preflight Fail: Baro Sensor 0 "
              "missing\", \"Arming denied: see the health report\"");
}

TEST(Offboard, OneThatDoesNotSendThePoseOnRequestIsNamed) {
    Peer peer;
    peer.tells_pose = false;
    peer.run(0.5);
    EXPECT_EQ(peer.offboard.obstacle(peer.time_s), "the autopilot sends no fresh pose");
    CommandAck ack;
    ack.command = MavCmd::set_message_interval;
    ack.result = MavResult::unsupported;
    peer.wire.say(ack);
    peer.run(0.1);
    EXPECT_EQ(peer.offboard.obstacle(peer.time_s),
              "the autopilot does not send ODOMETRY on request");
}

TEST(Offboard, StreamsThatAreNotReadAreStoppedOnceThePoseComes) {
    const auto stopped = [](const Peer& peer) {
        std::size_t count = 0;
        for (const CommandLong& each : peer.commands(MavCmd::set_message_interval)) {
            const bool read = each.param1 == static_cast<float>(Heartbeat::kId) ||
                              each.param1 == static_cast<float>(SysStatus::kId) ||
                              each.param1 == static_cast<float>(ExtendedSysState::kId) ||
                              each.param1 == static_cast<float>(StatusText::kId) ||
                              each.param1 == static_cast<float>(Odometry::kId);
            EXPECT_TRUE(each.param2 > 0.0F || !read) << each.param1;
            count += each.param2 == -1.0F;
        }
        return count;
    };
    OffboardOptions options;
    options.estimate_alone = true;
    Peer peer(options);
    peer.tells_pose = false;
    peer.run(3.0);
    EXPECT_EQ(stopped(peer), 0U);
    peer.tells_pose = true;
    peer.run(10.0);
    EXPECT_EQ(stopped(peer), 28U) << "fourteen, twice, since one may be lost";
    Peer companion;
    companion.run(10.0);
    EXPECT_EQ(stopped(companion), 0U) << "on a vehicle others may use them";
}

TEST(Offboard, FramesOfOthersAreLeftAlone) {
    Peer peer;
    peer.wire.autopilot.system = 9;
    peer.run(2.0);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::silent);
    peer.wire.autopilot.system = 1;
    peer.wire.autopilot.component = kGroundStationComponent;
    peer.run(2.0);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::silent);
}

TEST(Offboard, AsksWhoItIsUntilItTellsAndNotForEver) {
    Peer silent;
    silent.run(60.0);
    EXPECT_THAT(silent.requests(AutopilotVersion::kId), SizeIs(40));
    EXPECT_FALSE(silent.offboard.report().version);
    Peer peer;
    peer.run(0.5);
    peer.wire.say(AutopilotVersion{.flight_sw_version = 0x010F01FF});
    ParamValue airframe{.param_type = MavParamType::int32};
    const std::int32_t number = 22001;
    std::memcpy(&airframe.param_value, &number, sizeof(number));
    set_text(airframe.param_id, "SYS_AUTOSTART");
    peer.wire.say(airframe);
    peer.run(20.0);
    EXPECT_THAT(peer.requests(AutopilotVersion::kId), SizeIs(1));
    ASSERT_TRUE(peer.offboard.report().version);
    EXPECT_EQ(peer.offboard.report().version->flight_sw_version, 0x010F01FFU);
    EXPECT_EQ(peer.offboard.report().airframe, 22001);
    peer.wire.say(CommandAck{.command = MavCmd::request_message, .result = MavResult::denied});
    peer.run(0.1);
    EXPECT_EQ(peer.offboard.report().refused_command, 0) << "is not in the way of a flight";
}

TEST(Offboard, AsksForThePoseAndGivesTheOriginAltitudeZero) {
    Peer peer;
    peer.run(3.0);
    ASSERT_FALSE(peer.commands(MavCmd::set_message_interval).empty());
    EXPECT_EQ(peer.commands(MavCmd::set_message_interval)[0].param1, 331.0F);
    EXPECT_EQ(peer.commands(MavCmd::set_message_interval)[0].param2, 10'000.0F);
    ASSERT_FALSE(peer.wire.sent<SetGpsGlobalOrigin>().empty());
    EXPECT_EQ(peer.wire.sent<SetGpsGlobalOrigin>()[0].altitude, 0);
}

}  // namespace
}  // namespace limpet::mavlink
