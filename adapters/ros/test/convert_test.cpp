// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/convert.hpp"

#include <gtest/gtest.h>
#include <limpet_ros/CommandBool.h>
#include <limpet_ros/CommandLong.h>
#include <limpet_ros/SetMode.h>
#include <limpet_ros/State.h>

#include <cmath>
#include <limits>
#include <string>

#include "adapters/ros/src/topics.hpp"

namespace limpet::ros {
namespace {

constexpr double kTiny = 1e-9;

template <class Message>
Vector3 xyz(const Message& message) {
    return {message.x, message.y, message.z};
}
Eigen::Vector4d wxyz(const geometry_msgs::Quaternion& q) {
    return {q.w, q.x, q.y, q.z};
}

Estimate somewhere() {
    Estimate estimate;
    estimate.p_WB_m = {1.0, 2.0, -3.0};   // 1 m north, 2 m east, 3 m up
    estimate.v_WB_m_s = {0.1, 0.2, 0.3};  // falling
    estimate.w_WB_B_rad_s = {0.01, 0.02, 0.03};
    estimate.specific_force_B_m_s2 = {0.0, 0.0, -9.81};
    estimate.valid = true;
    return estimate;
}

TEST(RosConvert, NorthEastDownBecomesEastNorthUp) {
    const auto pose = pose_message(somewhere());
    EXPECT_EQ(pose.header.frame_id, "map");
    EXPECT_EQ(xyz(pose.pose.position), Vector3(2.0, 1.0, 3.0));
    // Level and looking north: 90 deg from east, counter-clockwise.
    const Eigen::Vector4d quarter(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
    EXPECT_TRUE(wxyz(pose.pose.orientation).isApprox(quarter, kTiny));
}

TEST(RosConvert, NoseUpIsANegativePitchThere) {
    Estimate estimate = somewhere();
    estimate.q_WB = quaternion_from_euler({.pitch_rad = radians(66.0), .yaw_rad = radians(90.0)});
    const auto pose = pose_message(estimate);
    // Looking east: no yaw there; about y, which points left, nose up is negative.
    const double half_rad = radians(33.0);
    const Eigen::Vector4d up(std::cos(half_rad), 0.0, -std::sin(half_rad), 0.0);
    EXPECT_TRUE(wxyz(pose.pose.orientation).isApprox(up, kTiny));
    const auto back = pose_reading(pose);
    ASSERT_TRUE(back);
    EXPECT_NEAR(euler_from_quaternion(back->q_WB).pitch_rad, radians(66.0), kTiny);
}

TEST(RosConvert, VelocityAndRatesTurnWithTheirFrames) {
    const auto velocity = velocity_message(somewhere());
    EXPECT_EQ(xyz(velocity.twist.linear), Vector3(0.2, 0.1, -0.3));
    // Level, north: B's axes are W's.
    EXPECT_TRUE(xyz(velocity.twist.angular).isApprox(Vector3(0.02, 0.01, -0.03), kTiny));
    const auto imu = imu_message(somewhere());
    EXPECT_EQ(xyz(imu.angular_velocity), Vector3(0.01, -0.02, -0.03));
    EXPECT_DOUBLE_EQ(imu.linear_acceleration.z, 9.81);  // at rest: upwards (REP 145)
    EXPECT_TRUE(velocity_W(velocity)->isApprox(somewhere().v_WB_m_s));
    EXPECT_TRUE(rate_B(imu)->isApprox(somewhere().w_WB_B_rad_s));
}

TEST(RosConvert, NoEchoIsInfinity) {
    const auto none = range_message({.distance_m = 0.0, .valid = false}, "lidar_left", 0.1, 12.0);
    EXPECT_EQ(none.header.frame_id, "lidar_left");
    EXPECT_TRUE(std::isinf(none.range));
    EXPECT_FALSE(range_reading(none)->valid);
    const auto echo = range_message({.distance_m = 1.5, .valid = true}, "lidar_left", 0.1, 12.0);
    EXPECT_TRUE(range_reading(echo)->valid);
    EXPECT_NEAR(range_reading(echo)->distance_m, 1.5, 1e-6);
    auto far = echo;
    far.range = 13.0F;
    EXPECT_FALSE(range_reading(far)->valid);
}

TEST(RosConvert, ABatteryThatGivesCurrentHasANegativeOne) {
    const auto message = battery_message({.voltage_V = 23.5, .current_A = 40.0, .remaining = 0.75});
    EXPECT_FLOAT_EQ(message.current, -40.0F);
    const auto back = battery_reading(message);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->current_A, 40.0, 1e-5);
    EXPECT_NEAR(back->remaining, 0.75, 1e-6);
}

/// @throws when it comes back as another kind of set-point, or as none
template <class Target>
Target there_and_back(const Target& target) {
    return std::get<Target>(motion_from(target_message(target)).value());
}

TEST(RosConvert, SetPointsKeepTheirMeaning) {
    const PositionSetpoint position{
        .p_W_m = {1.0, 2.0, -3.0}, .yaw_rad = radians(30.0), .feedforward_v_W_m_s = {0.5, 0, 0}};
    const auto message = target_message(position);
    EXPECT_DOUBLE_EQ(message.position.x, 2.0);
    EXPECT_DOUBLE_EQ(message.position.z, 3.0);
    EXPECT_NEAR(message.yaw, radians(60.0), 1e-6);
    EXPECT_DOUBLE_EQ(message.velocity.y, 0.5);
    const auto back = there_and_back(position);
    EXPECT_TRUE(back.p_W_m.isApprox(position.p_W_m));
    EXPECT_NEAR(back.yaw_rad, position.yaw_rad, 1e-6);
    EXPECT_TRUE(back.feedforward_v_W_m_s.isApprox(position.feedforward_v_W_m_s));

    const VelocitySetpoint velocity{
        .v_W_m_s = {1.1, 0.1, 0.2}, .yaw_rad = -3.0, .feedforward_a_W_m_s2 = {1.5, 0, 0}};
    const auto run = there_and_back(velocity);
    EXPECT_TRUE(run.v_W_m_s.isApprox(velocity.v_W_m_s));
    EXPECT_NEAR(run.yaw_rad, -3.0, 1e-6);
    EXPECT_TRUE(run.feedforward_a_W_m_s2.isApprox(velocity.feedforward_a_W_m_s2));

    const AttitudeSetpoint attitude{.q_WB = quaternion_from_euler({.pitch_rad = 1.1}),
                                    .thrust = 0.4};
    const auto lean = there_and_back(attitude);
    EXPECT_LT(lean.q_WB.angularDistance(attitude.q_WB), 1e-7);
    EXPECT_NEAR(lean.thrust, 0.4, 1e-6);
}

TEST(RosConvert, WhatIsNoSetPointIsNone) {
    limpet_ros::PositionTarget target = target_message(PositionSetpoint{});
    target.coordinate_frame = limpet_ros::PositionTarget::FRAME_BODY_NED;
    EXPECT_FALSE(motion_from(target));
    target = target_message(PositionSetpoint{});
    target.position.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(motion_from(target));
    target = target_message(PositionSetpoint{});
    target.type_mask = 0;  // a position, a velocity and a rate of yaw at once
    EXPECT_FALSE(motion_from(target));
    limpet_ros::AttitudeTarget attitude = target_message(AttitudeSetpoint{});
    attitude.orientation.w = 0.5;
    EXPECT_FALSE(motion_from(attitude));
}

TEST(RosConvert, AContactComesBackWhole) {
    const suction::LipContact contact{.touches = true,
                                      .gap_m = -0.001,
                                      .lies_still = false,
                                      .let_go = suction::LetGo::sheared,
                                      .peel_N_m = 0.3,
                                      .shear_margin_N = -2.0};
    const auto back = lip_contact(contact_message(contact));
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->touches);
    EXPECT_FALSE(back->lies_still);
    EXPECT_EQ(back->let_go, suction::LetGo::sheared);
    EXPECT_EQ(back->gap_m, contact.gap_m);
    EXPECT_EQ(back->peel_N_m, contact.peel_N_m);
    EXPECT_EQ(back->shear_margin_N, contact.shear_margin_N);
    auto broken = contact_message(contact);
    broken.let_go = 9;
    EXPECT_FALSE(lip_contact(broken));
    broken = contact_message(contact);
    broken.tilt_rad = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(lip_contact(broken));
}

// What roscpp compares when two ends meet. Source: genmsg's sums of mavros_msgs at the tags of
// MAVROS, 1.5.0 to 1.21.0, which are one; State's was another before, without constants.
TEST(RosConvert, MavrosAndWeMeanTheSame) {
    using ::ros::message_traits::MD5Sum;
    namespace services = ::ros::service_traits;
    EXPECT_STREQ(MD5Sum<limpet_ros::State>::value(), "65cd0a9fff993b062b91e354554ec7e9");
    EXPECT_STREQ(MD5Sum<limpet_ros::PositionTarget>::value(), "dedb0081aaf8cb20209737746bb49117");
    EXPECT_STREQ(MD5Sum<limpet_ros::AttitudeTarget>::value(), "456f3af666b22ccd0222ea053a86b548");
    EXPECT_STREQ(services::MD5Sum<limpet_ros::CommandBool>::value(),
                 "e09abbb4e5bae6b558e5010966eb6e9e");
    EXPECT_STREQ(services::MD5Sum<limpet_ros::CommandLong>::value(),
                 "eb9034afc87577c0a235d45b8f3437d2");
    EXPECT_STREQ(services::MD5Sum<limpet_ros::SetMode>::value(),
                 "e4f18fa93379f9ff1780d270ce110203");
}

TEST(RosConvert, AStateOfAnOlderMavrosIsUnderstood) {
    EXPECT_TRUE(understands<limpet_ros::State>("65cd0a9fff993b062b91e354554ec7e9"));
    EXPECT_TRUE(understands<limpet_ros::State>("ce783f756cab1193cb71ba9e90fece50"));
    EXPECT_FALSE(understands<limpet_ros::State>("63d9a29b6abd9e0beeba06109556d062"))
        << "of MAVROS 0.29, which has no system_status";
    EXPECT_FALSE(understands<limpet_ros::PositionTarget>("ce783f756cab1193cb71ba9e90fece50"));
}

}  // namespace
}  // namespace limpet::ros
