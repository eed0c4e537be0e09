// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/lip_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::guidance {
namespace {

constexpr double kHeading_rad = 0.7;
const Vector3 kInto_W(std::cos(kHeading_rad), std::sin(kHeading_rad), 0.0);

/// The vehicle behind a lip that lies flat on the wall: the joint bends down, then aside.
Quaternion behind_lip(double turn_rad, double down_rad, double aside_rad) {
    const Quaternion q_WC = quaternion_from_euler({.roll_rad = turn_rad, .yaw_rad = kHeading_rad});
    const Quaternion q_BC = quaternion_from_euler({.pitch_rad = down_rad}) *
                            quaternion_from_euler({.yaw_rad = aside_rad});
    return q_WC * q_BC.conjugate();
}

TEST(LipTurn, IsFoundBehindEveryBendOfTheJoint) {
    for (const double turn_deg : {-25.0, -3.0, 0.0, 13.0, 30.0}) {
        for (const double down_deg : {-67.0, -30.0, 0.0, 8.0}) {
            for (const double aside_deg : {-22.0, 0.0, 16.0}) {
                const Quaternion q_WB =
                    behind_lip(radians(turn_deg), radians(down_deg), radians(aside_deg));
                EXPECT_NEAR(degrees(lip_turn_rad(kInto_W, q_WB)), turn_deg, 1e-9);
                EXPECT_NEAR(degrees(pitch_on_lip_rad(kInto_W, q_WB)), -down_deg, 1e-9);
            }
        }
    }
}

TEST(LipTurn, OfALevelVehicleItIsItsRoll) {
    const Quaternion q_WB =
        quaternion_from_euler({.roll_rad = radians(12.0), .yaw_rad = kHeading_rad});
    EXPECT_NEAR(degrees(lip_turn_rad(kInto_W, q_WB)), 12.0, 1e-9);
}

TEST(LipTurn, APitchInItsPlaneBendsTheJointNotAside) {
    const double turn_rad = radians(14.0), pitch_rad = radians(66.0);
    const Quaternion q_WB = attitude_on_lip(kHeading_rad, turn_rad, pitch_rad, 0.0);
    EXPECT_NEAR((q_WB.conjugate() * kInto_W).y(), 0.0, 1e-12);  // both legs meet the wall
    EXPECT_NEAR(lip_turn_rad(kInto_W, q_WB), turn_rad, 1e-12);
    EXPECT_NEAR(pitch_on_lip_rad(kInto_W, q_WB), pitch_rad, 1e-12);
    // the cup's arm stays across the lip's right: the vehicle hangs aside of the spot below
    const Vector3 right_W = right_of_lip_W(kInto_W, turn_rad);
    EXPECT_NEAR(right_W.dot(q_WB * Vector3::UnitX()), 0.0, 1e-12);
    EXPECT_NEAR(right_W.dot(q_WB * Vector3::UnitY()), 1.0, 1e-12);
    EXPECT_LT(Vector3(-kInto_W.y(), kInto_W.x(), 0.0).dot(q_WB * -Vector3::UnitX()), -0.15);
}

TEST(LipTurn, WithoutATurnTheAttitudeIsTheEulerAngles) {
    const Quaternion q_WB = attitude_on_lip(kHeading_rad, 0.0, radians(40.0), radians(5.0));
    const Euler angles = euler_from_quaternion(q_WB);
    EXPECT_NEAR(angles.roll_rad, radians(5.0), 1e-12);
    EXPECT_NEAR(angles.pitch_rad, radians(40.0), 1e-12);
    EXPECT_NEAR(angles.yaw_rad, kHeading_rad, 1e-12);
}

}  // namespace
}  // namespace limpet::guidance
