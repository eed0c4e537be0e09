// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/mocap_axes.hpp"

#include <gtest/gtest.h>

namespace limpet::devices {
namespace {

void expect_near(const Vector3& got, const Vector3& expected) {
    EXPECT_LT((got - expected).norm(), 1e-12)
        << "got " << got.transpose() << ", expected " << expected.transpose();
}

Quaternion turn_about(const Vector3& axis, double angle_deg) {
    return Quaternion(Eigen::AngleAxisd(radians(angle_deg), axis));
}

TEST(MocapAxes, ZUpWithXToTheNorthIsNorthWestUp) {
    const MocapAxes axes{.up = UpAxis::z};
    // one metre along x, two along y (to the west), three up
    const PoseReading pose = pose_in_world(axes, {.p_MP_m = {1.0, 2.0, 3.0}});
    expect_near(pose.p_WB_m, {1.0, -2.0, -3.0});
    EXPECT_LT(pose.q_WB.angularDistance(Quaternion::Identity()), 1e-12);
}

TEST(MocapAxes, YUpWithXToTheNorthIsNorthUpEast) {
    const MocapAxes axes{.up = UpAxis::y};
    const PoseReading pose = pose_in_world(axes, {.p_MP_m = {1.0, 2.0, 3.0}});
    expect_near(pose.p_WB_m, {1.0, 3.0, -2.0});
    EXPECT_LT(pose.q_WB.angularDistance(Quaternion::Identity()), 1e-12);
}

TEST(MocapAxes, XToTheEastTurnsPlaceAndNose) {
    const MocapAxes axes{.up = UpAxis::z, .x_axis_yaw_deg = 90.0};
    const PoseReading pose = pose_in_world(axes, {.p_MP_m = {1.0, 2.0, 3.0}});
    expect_near(pose.p_WB_m, {2.0, 1.0, -3.0});  // x is east, y is north
    EXPECT_NEAR(degrees(euler_from_quaternion(pose.q_WB).yaw_rad), 90.0, 1e-9);
}

TEST(MocapAxes, ATurnAboutTheUpwardAxisIsAYawToTheLeft) {
    const MocapPose z_up{.q_MP = turn_about(Vector3::UnitZ(), 30.0)};
    const MocapPose y_up{.q_MP = turn_about(Vector3::UnitY(), 30.0)};
    EXPECT_NEAR(degrees(euler_from_quaternion(pose_in_world({.up = UpAxis::z}, z_up).q_WB).yaw_rad),
                -30.0, 1e-9);
    EXPECT_NEAR(degrees(euler_from_quaternion(pose_in_world({.up = UpAxis::y}, y_up).q_WB).yaw_rad),
                -30.0, 1e-9);
}

TEST(MocapAxes, ANoseThatRisesIsPositivePitch) {
    // z up: y is left, so that a turn about it lowers the nose; y up: z is right and raises it
    const MocapPose z_up{.q_MP = turn_about(Vector3::UnitY(), -66.0)};
    const MocapPose y_up{.q_MP = turn_about(Vector3::UnitZ(), 66.0)};
    EXPECT_NEAR(
        degrees(euler_from_quaternion(pose_in_world({.up = UpAxis::z}, z_up).q_WB).pitch_rad), 66.0,
        1e-9);
    EXPECT_NEAR(
        degrees(euler_from_quaternion(pose_in_world({.up = UpAxis::y}, y_up).q_WB).pitch_rad), 66.0,
        1e-9);
}

TEST(MocapAxes, ARollToTheRightIsPositiveInBoth) {
    const MocapPose roll{.q_MP = turn_about(Vector3::UnitX(), 20.0)};
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        const Euler angles = euler_from_quaternion(pose_in_world({.up = up}, roll).q_WB);
        EXPECT_NEAR(degrees(angles.roll_rad), 20.0, 1e-9);
    }
}

TEST(MocapAxes, ThePivotIsNotTheCentreOfMass) {
    // The pivot is 0.1 m above the centre of mass and the vehicle pitched up by 90 degrees: above
    // has become behind, so the centre of mass is 0.1 m further north than the pivot.
    const MocapAxes axes{.up = UpAxis::z, .p_BP_m = {0.0, 0.0, -0.1}};
    const PoseReading pose = pose_in_world(
        axes, {.p_MP_m = {5.0, 0.0, 1.0}, .q_MP = turn_about(Vector3::UnitY(), -90.0)});
    expect_near(pose.p_WB_m, {5.1, 0.0, -1.0});
}

TEST(MocapAxes, ARigidBodyMadeWithTheNoseElsewhere) {
    // made while the nose pointed to the right of M's x by 90 degrees: P still has M's axes then
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        const PoseReading pose = pose_in_world({.up = up, .nose_yaw_deg = 90.0}, {});
        EXPECT_NEAR(degrees(euler_from_quaternion(pose.q_WB).yaw_rad), 90.0, 1e-9);
    }
}

TEST(MocapAxes, TheOriginIsMovedInWorldAxes) {
    const MocapAxes axes{.up = UpAxis::z, .x_axis_yaw_deg = 90.0, .p_WM_m = {10.0, 20.0, -1.0}};
    expect_near(pose_in_world(axes, {.p_MP_m = {1.0, 0.0, 0.0}}).p_WB_m, {10.0, 21.0, -1.0});
}

TEST(MocapAxes, ThereAndBackIsTheSame) {
    const PoseReading pose{.p_WB_m = {1.0, -2.0, -3.0},
                           .q_WB = quaternion_from_euler({0.3, -0.7, 2.0})};
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        const MocapAxes axes{.up = up,
                             .x_axis_yaw_deg = 37.0,
                             .p_WM_m = {0.5, 0.6, 0.7},
                             .nose_yaw_deg = -120.0,
                             .p_BP_m = {0.01, 0.02, -0.03}};
        const PoseReading back = pose_in_world(axes, pose_in_mocap(axes, pose));
        expect_near(back.p_WB_m, pose.p_WB_m);
        EXPECT_LT(back.q_WB.angularDistance(pose.q_WB), 1e-9);
    }
}

}  // namespace
}  // namespace limpet::devices
