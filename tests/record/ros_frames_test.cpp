// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/ros_frames.hpp"

#include <gtest/gtest.h>

#include "limpet/core/random.hpp"

namespace limpet::record::ros {
namespace {

const double kHalf = std::sqrt(0.5);

void expect_same(const Quaternion& a, const Quaternion& b) {
    EXPECT_NEAR(std::abs(a.dot(b)), 1.0, 1e-15);
}

TEST(RosFrames, AxesAreThoseOfRep103) {
    const Vector3 north = Vector3::UnitX(), east = Vector3::UnitY(), down = Vector3::UnitZ();
    EXPECT_EQ(enu_from_ned(north), Vector3(0, 1, 0));
    EXPECT_EQ(enu_from_ned(east), Vector3(1, 0, 0));
    EXPECT_EQ(enu_from_ned(down), Vector3(0, 0, -1));
    EXPECT_EQ(flu_from_frd({1, 2, 3}), Vector3(1, -2, -3));
}

TEST(RosFrames, AttitudesByHand) {
    // Level, nose north: forward is ENU's y, a yaw of +90 deg about up.
    const Quaternion north = enu_flu_from_ned_frd(Quaternion::Identity());
    EXPECT_NEAR(north.w(), kHalf, 1e-15);
    EXPECT_NEAR(north.z(), kHalf, 1e-15);
    EXPECT_NEAR(north.x(), 0.0, 1e-15);
    EXPECT_NEAR(north.y(), 0.0, 1e-15);
    // Level, nose east (yaw +90 deg clockwise from above): ENU's own attitude.
    expect_same(enu_flu_from_ned_frd(quaternion_from_euler({0, 0, kPi / 2})),
                Quaternion::Identity());
    // Nose east and 66 deg up, as perched: in ROS nose up is a negative turn about left.
    expect_same(enu_flu_from_ned_frd(quaternion_from_euler({0, radians(66), kPi / 2})),
                Quaternion(Eigen::AngleAxisd(-radians(66), Vector3::UnitY())));
    // Nose east, right side down by 20 deg: the same turn about forward in both.
    expect_same(enu_flu_from_ned_frd(quaternion_from_euler({radians(20), 0, kPi / 2})),
                Quaternion(Eigen::AngleAxisd(radians(20), Vector3::UnitX())));
}

TEST(RosFrames, TurningAndRenamingCommute) {
    RandomStream random(1, 0, Stream::test);
    for (int i = 0; i < 100; ++i) {
        const Quaternion q_WB = quaternion_from_rotation_vector(random.normal3());
        const Vector3 v_B = random.normal3();
        const Vector3 there = enu_flu_from_ned_frd(q_WB) * flu_from_frd(v_B);
        EXPECT_LT((there - enu_from_ned(q_WB * v_B)).norm(), 1e-14);
    }
}

TEST(RosFrames, ThereAndBackIsTheSame) {
    RandomStream random(2, 0, Stream::test);
    for (int i = 0; i < 100; ++i) {
        const Vector3 v = random.normal3();
        EXPECT_EQ(enu_from_ned(enu_from_ned(v)), v);
        EXPECT_EQ(flu_from_frd(flu_from_frd(v)), v);
        const Quaternion q = quaternion_from_rotation_vector(3.0 * random.normal3());
        const Quaternion there = enu_flu_from_ned_frd(q);
        EXPECT_GE(there.w(), 0.0);
        expect_same(enu_flu_from_ned_frd(there), q);
    }
}

}  // namespace
}  // namespace limpet::record::ros
