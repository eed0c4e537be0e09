// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstring>

#include "limpet/core/random.hpp"
#include "stand_in_driver.hpp"

namespace limpet::px4 {
namespace {

using namespace std::chrono_literals;
using mavlink::custom_mode;
using mavlink::Odometry;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint8_t kOnGround = 1;
constexpr std::uint8_t kInAir = 2;

const Quaternion kPerched = quaternion_from_euler({0.0, radians(66.0), 0.0});

/// In offboard, armed, with thrust.
void take_off(StandInDriver& driver) {
    driver.boot();
    driver.stream(0.3);
    driver.run(0.1);
    ASSERT_EQ(driver.offboard(), 0);
    ASSERT_EQ(driver.arm(), 0);
    driver.run(1.1);
    ASSERT_TRUE(driver.armed());
    ASSERT_EQ(driver.landed.landed_state, kInAir);
}

TEST(StandIn, SaysHelloAnswersLateAndThenOnceASensor) {
    StandInDriver driver;
    for (int i = 1; i <= 25; ++i) {
        driver.step();
        EXPECT_TRUE(driver.answers.empty()) << i;
    }
    EXPECT_TRUE(driver.said_hello);
    for (int i = 26; i <= 200; ++i) {
        driver.step();
        ASSERT_EQ(driver.answers.size(), 1U) << i;
        const mavlink::HilActuatorControls& answer = driver.answers.front();
        EXPECT_EQ(answer.time_usec, 4000U * static_cast<unsigned>(i));
        EXPECT_EQ(answer.flags, 1U);
        EXPECT_EQ(answer.mode, 1);
        EXPECT_THAT(answer.controls, Each(0.0F));
    }
}

TEST(StandIn, ASensorWhoseTimeDoesNotRiseIsNotAnswered) {
    StandInDriver driver;
    driver.boot();
    mavlink::HilSensor again;
    again.time_usec = 4000;
    ASSERT_EQ(driver.simulator.send(again), wire::TransferStatus::done);
    driver.step();
    EXPECT_EQ(driver.answers.size(), 1U);
    EXPECT_EQ(driver.stand_in.count().refused, 1U);
}

TEST(StandIn, ArmedItFliesTheSetPoint) {
    StandInDriver driver;
    take_off(driver);
    ASSERT_EQ(driver.answers.size(), 1U);
    EXPECT_EQ(driver.answers.front().mode, 129);
    EXPECT_EQ(driver.heartbeat.custom_mode, custom_mode(mavlink::kMainModeOffboard));
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        sum += driver.answers.front().controls[i];
    }
    EXPECT_NEAR(sum / 4.0, 0.3, 0.01);  // level, at rest: the collective as it was asked for
}

TEST(StandIn, TellsWhereItIsAtTheRateAskedFor) {
    StandInDriver driver;
    driver.boot();
    ASSERT_TRUE(driver.estimate);
    EXPECT_LT((driver.estimate->p_WB_m - driver.p_WB_m).norm(), 0.01);
    EXPECT_TRUE(driver.estimate->valid);
    const auto counted = [&](std::uint32_t id) {
        const int before = driver.heard[id];
        driver.run(2.0);
        return 0.5 * (driver.heard[id] - before);
    };
    EXPECT_NEAR(counted(mavlink::Odometry::kId), 30.0, 1.0);
    EXPECT_NEAR(counted(mavlink::Heartbeat::kId), 1.0, 0.5);
    EXPECT_EQ(driver.command(511, 331, 10000), 0);
    EXPECT_NEAR(counted(mavlink::Odometry::kId), 100.0, 1.0);
    EXPECT_EQ(driver.command(511, 331, -1), 0);
    EXPECT_EQ(counted(mavlink::Odometry::kId), 0.0);
    EXPECT_EQ(driver.command(511, 4711, 10000), 4);  // no such stream: failed
    EXPECT_EQ(driver.command(31000), 3);             // no such command: unsupported
}

TEST(StandIn, PosesOfOtherKindsAreNotUsedAndItDoesNotArm) {
    StandInDriver driver;
    driver.estimator_type = 6;
    driver.boot();
    EXPECT_FALSE(driver.estimate);
    EXPECT_EQ(driver.arm(), 1);
    EXPECT_THAT(driver.texts, Contains(HasSubstr("estimate not valid")));
}

TEST(StandIn, PosesMayComeOverUdp) {
    StandInDriver driver;
    driver.poses_over_tcp = false;
    driver.poses_over_udp = true;
    driver.boot();
    driver.run(0.5);
    ASSERT_TRUE(driver.estimate);
    EXPECT_LT((driver.estimate->p_WB_m - driver.p_WB_m).norm(), 0.01);
}

TEST(StandIn, PosesThatStopMakeItsEstimateInvalid) {
    StandInDriver driver;
    driver.boot();
    driver.poses_over_tcp = false;
    driver.run(1.0);
    EXPECT_FALSE(driver.estimate->valid);
    EXPECT_EQ(driver.arm(), 1);
}

TEST(StandIn, WithGpsAndMagnetometerItFindsItsHeading) {
    autopilot::AutopilotParameters parameters;
    parameters.EKF2_EV_CTRL = 0;
    parameters.EKF2_GPS_CTRL = 7;
    parameters.EKF2_MAG_TYPE = 0;
    StandInDriver driver({}, parameters);
    driver.poses_over_tcp = false;
    driver.gps = true;
    driver.q_WB = quaternion_from_euler({0.1, -0.2, 2.0});
    driver.boot();
    ASSERT_TRUE(driver.estimate);
    EXPECT_TRUE(driver.estimate->valid);
    EXPECT_LT(driver.estimate->q_WB.angularDistance(driver.q_WB), 0.01);
    EXPECT_LT((driver.estimate->p_WB_m - driver.p_WB_m).norm(), 0.1);
}

TEST(StandIn, TextsGoToGroundStationsAlone) {
    for (const std::uint8_t type : {std::uint8_t{6}, std::uint8_t{18}}) {
        StandInDriver driver;
        driver.heartbeat_type = type;
        driver.boot();
        driver.run(1.1);
        ASSERT_EQ(driver.arm(), 0);
        EXPECT_EQ(driver.texts.empty(), type != 6) << int{type};
    }
}

TEST(StandIn, OffboardIsRefusedWithoutSetPointsAndLostAfterASecond) {
    StandInDriver driver;
    driver.boot();
    EXPECT_EQ(driver.offboard(), 1);
    take_off(driver);
    driver.stream(std::nullopt);
    const auto holds = [&] {
        return driver.heartbeat.custom_mode ==
               custom_mode(mavlink::kMainModeAuto, mavlink::kSubModeLoiter);
    };
    EXPECT_GE(driver.time_until(holds, 5.0), 0.98);  // the last set-point is up to 20 ms old
    EXPECT_TRUE(holds());
    EXPECT_TRUE(driver.armed());
    EXPECT_THAT(driver.texts, Contains(HasSubstr("offboard signal lost")));
}

TEST(StandIn, HoldsWhereItIsOnlyWithAnOrigin) {
    for (const bool with_origin : {false, true}) {
        StandInDriver driver;
        driver.boot();
        if (with_origin) {
            mavlink::SetGpsGlobalOrigin origin;
            origin.target_system = 1;
            ASSERT_EQ(driver.companion.send(origin), wire::TransferStatus::done);
        }
        take_off(driver);
        ASSERT_EQ(driver.command(176, 1, 4, 3), 0);
        const Vector3 expected = with_origin ? driver.p_WB_m : Vector3(0.0, 0.0, driver.p_WB_m.z());
        EXPECT_LT((driver.stand_in.flight().hold.p_W_m - expected).norm(), 0.01);
    }
}

TEST(StandIn, PerchedItArmsOnlyWithoutTheAttitudeFailureCheck) {
    StandInDriver driver;
    driver.q_WB = kPerched;
    driver.boot();
    driver.stream(0.0);
    driver.run(0.1);
    ASSERT_EQ(driver.offboard(), 0);
    EXPECT_EQ(driver.arm(), 1);
    EXPECT_EQ(driver.command(400, 1, mavlink::kForce), 1);
    EXPECT_THAT(driver.texts, Contains(HasSubstr("FD_FAIL_P")));
    driver.set_parameter("FD_FAIL_P", 0);
    EXPECT_EQ(driver.arm(), 0);
    driver.run(1.1);
    EXPECT_TRUE(driver.armed());
}

TEST(StandIn, InFlightADisarmMustBeForced) {
    StandInDriver driver;
    take_off(driver);
    EXPECT_EQ(driver.disarm(), 1);
    EXPECT_THAT(driver.texts, Contains(HasSubstr("not landed")));
    EXPECT_EQ(driver.force_disarm(), 0);
    driver.step();
    EXPECT_EQ(driver.answers.front().mode, 1);
    EXPECT_THAT(driver.answers.front().controls, Each(0.0F));
}

TEST(StandIn, WithoutThrustItLandsAndDisarmsInPx4sTime) {
    StandInDriver driver;
    take_off(driver);
    ASSERT_EQ(driver.command(511, 245, 20000), 0);
    driver.stream(0.0);
    const double landed_s =
        driver.time_until([&] { return driver.landed.landed_state == kOnGround; }, 9.0);
    EXPECT_NEAR(landed_s, 1.05, 0.05);
    const auto disarmed = [&] { return driver.answers.front().mode == 1; };
    EXPECT_NEAR(landed_s + driver.time_until(disarmed, 9.0), 3.5, 0.05);
}

TEST(StandIn, ArmedWithoutThrustItDisarmsAfterTenSeconds) {
    StandInDriver driver;
    driver.boot();
    driver.stream(0.0);
    driver.run(0.1);
    ASSERT_EQ(driver.offboard(), 0);
    ASSERT_EQ(driver.arm(), 0);
    driver.step();
    EXPECT_EQ(driver.answers.front().mode, 129);
    EXPECT_NEAR(driver.time_until([&] { return driver.answers.front().mode == 1; }, 20.0), 10.0,
                0.05);
}

TEST(StandIn, AnothersSetPointsAndCommandsAreLeftAlone) {
    StandInDriver driver;
    driver.target_system = 2;
    driver.boot();
    driver.stream(0.3);
    driver.run(0.5);
    EXPECT_EQ(driver.offboard(), 255);  // no answer
    EXPECT_EQ(driver.arm(), 255);
    driver.target_system = 1;
    EXPECT_EQ(driver.offboard(), 1);  // those were no set-points for it
}

TEST(StandIn, TellsAndTakesParameters) {
    StandInDriver driver;
    driver.boot();
    mavlink::ParamRequestRead read;
    read.target_system = 1;
    read.param_index = -1;
    mavlink::set_text(read.param_id, "MPC_THR_HOVER");
    ASSERT_EQ(driver.companion.send(read), wire::TransferStatus::done);
    driver.step();
    EXPECT_EQ(mavlink::text_of(driver.parameter.param_id), "MPC_THR_HOVER");
    EXPECT_EQ(driver.parameter.param_type, 9);
    EXPECT_FLOAT_EQ(driver.parameter.param_value, 0.657F);

    const auto integer = [&] {
        std::int32_t value = 0;
        std::memcpy(&value, &driver.parameter.param_value, sizeof(value));
        return value;
    };
    driver.set_parameter("FD_FAIL_P", 75);
    EXPECT_EQ(integer(), 75);
    EXPECT_EQ(driver.parameter.param_type, 6);
    driver.set_parameter("FD_FAIL_P", 500);  // out of range
    EXPECT_EQ(integer(), 75);
    driver.set_parameter("COM_OF_LOSS_T", 5);  // of the wrong type
    EXPECT_EQ(driver.parameter.param_value, 1.0F);

    driver.heard.clear();
    mavlink::ParamRequestList list;
    list.target_system = 1;
    ASSERT_EQ(driver.companion.send(list), wire::TransferStatus::done);
    driver.run(0.02);  // 20 a step
    StandInParameters commander;
    const auto count = static_cast<int>(wire_parameters(commander, driver.model.parameters).size());
    EXPECT_EQ(driver.heard[mavlink::ParamValue::kId], count);
    EXPECT_EQ(driver.parameter.param_count, count);
}

TEST(StandIn, TellsItsTimeToWhoAsks) {
    StandInDriver driver;
    driver.boot();
    mavlink::TimeSync question;
    question.ts1 = 123456789;
    ASSERT_EQ(driver.companion.send(question), wire::TransferStatus::done);
    driver.step();
    EXPECT_EQ(driver.heard[mavlink::TimeSync::kId], 1);
}

TEST(StandIn, KeepsToTheFirstThatSpeaksToItsOnboardLink) {
    StandInDriver driver;
    driver.boot();
    mavlink::Link stranger(open_transport(*driver.stand_in.onboard_address(), wire::Role::connect),
                           {.system = 77, .component = 1});
    mavlink::CommandLong arm;
    arm.command = mavlink::MavCmd::component_arm_disarm;
    arm.param1 = 1.0F;
    ASSERT_EQ(stranger.send(arm), wire::TransferStatus::done);
    driver.run(1.1);
    EXPECT_FALSE(driver.armed());
    EXPECT_FALSE(stranger.receive(10ms));
}

TEST(StandIn, FindsTheNextFrameBehindAnything) {
    StandInDriver driver;
    driver.boot();
    mavlink::Sender other{.system = 9, .component = 9};
    mavlink::FrameBuffer buffer;
    mavlink::HilSensor sensor;
    sensor.time_usec = 1;
    sensor.id = 1;  // so that nothing of it is cut off
    RandomStream random(3, 0, Stream::test);
    for (int i = 0; i < 100; ++i) {
        const mavlink::ByteView frame = mavlink::encode(sensor, other, buffer);
        const mavlink::ByteView half = frame.first(frame.size() / 2);
        buffer[20] ^= 0x55U;  // a wrong checksum, and half of such a frame
        ASSERT_EQ(driver.wire->send(std::as_bytes(frame), 1s).status, wire::TransferStatus::done);
        ASSERT_EQ(driver.wire->send(std::as_bytes(half), 1s).status, wire::TransferStatus::done);
        std::array<std::byte, 600> noise{};  // half of it zeros, the end of any frame within
        for (std::size_t k = 0; k < 300; ++k) {
            noise[k] = static_cast<std::byte>(random.uniform() * 256.0);
        }
        ASSERT_EQ(driver.wire->send(noise, 1s).status, wire::TransferStatus::done);
        driver.step();
        ASSERT_EQ(driver.answers.size(), 1U) << i;
    }
    EXPECT_GE(driver.stand_in.hil().count().damaged, 100U);
    EXPECT_GE(driver.stand_in.hil().count().discarded_bytes, 60000U);
    EXPECT_TRUE(driver.estimate->valid);
}

TEST(StandIn, BootsAnewForANewSimulatorAndKeepsItsParameters) {
    StandInDriver driver;
    take_off(driver);
    driver.set_parameter("FD_FAIL_P", 75);
    const wire::TransportAddress address = driver.simulator.transport().address();
    const std::uint64_t answers = driver.stand_in.count().answers;
    driver.simulator = mavlink::Link(open_transport({.port = 0}, wire::Role::listen),
                                     driver.simulator.self());  // the old one goes
    EXPECT_FALSE(driver.stand_in.serve(50ms));
    EXPECT_FALSE(driver.stand_in.serve(50ms));  // it tries and tries
    driver.simulator =
        mavlink::Link(open_transport(address, wire::Role::listen), driver.simulator.self());
    driver.said_hello = false;
    driver.step();
    EXPECT_TRUE(driver.said_hello);
    EXPECT_TRUE(driver.answers.empty());
    EXPECT_EQ(driver.stand_in.count().boots, 2U);
    EXPECT_EQ(driver.stand_in.count().answers, answers);
    EXPECT_FALSE(driver.stand_in.flight().manners.armed());
    driver.run(0.2);
    EXPECT_EQ(driver.answers.size(), 1U);
    driver.run(1.0);
    driver.set_parameter("FD_FAIL_P", 500);
    std::int32_t value = 0;
    std::memcpy(&value, &driver.parameter.param_value, sizeof(value));
    EXPECT_EQ(value, 75);
}

}  // namespace
}  // namespace limpet::px4
