// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/attitude_control.hpp"

#include <gtest/gtest.h>

#include "defaults.hpp"
#include "limpet/core/random.hpp"

namespace limpet::autopilot {
namespace {

Quaternion euler_deg(double roll, double pitch, double yaw) {
    return quaternion_from_euler({radians(roll), radians(pitch), radians(yaw)});
}

TEST(AttitudeControl, NoErrorNoRate) {
    const Quaternion q = euler_deg(20.0, -30.0, 140.0);
    EXPECT_LT(attitude_control(kDefaults, q, q).norm(), 1e-12);
    const Quaternion minus(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LT(attitude_control(kDefaults, q, minus).norm(), 1e-12);
}

TEST(AttitudeControl, SmallErrorsAreProportional) {
    const Quaternion q = euler_deg(5.0, 66.0, 30.0);
    const Vector3 error_rad(1e-3, -2e-3, 1.5e-3);
    const Vector3 rate =
        attitude_control(kDefaults, q, q * quaternion_from_rotation_vector(error_rad));
    EXPECT_NEAR(rate.x(), 6.5 * error_rad.x(), 1e-5);
    EXPECT_NEAR(rate.y(), 6.5 * error_rad.y(), 1e-5);
    EXPECT_NEAR(rate.z(), 2.8 * error_rad.z(), 1e-5);
}

/// 2 sin(15 deg) 6.5 = 3.36 rad/s of roll, below its 220 deg/s limit.
TEST(AttitudeControl, HandCalculatedRoll) {
    const Vector3 rate = attitude_control(kDefaults, euler_deg(30, 0, 0), euler_deg(0, 0, 0));
    EXPECT_NEAR(rate.x(), -2.0 * std::sin(radians(15.0)) * 6.5, 1e-9);
    EXPECT_NEAR(rate.y(), 0.0, 1e-12);
    EXPECT_NEAR(rate.z(), 0.0, 1e-12);
}

TEST(AttitudeControl, RatesStayWithinTheirLimits) {
    RandomStream random(5, 0, Stream::test);
    for (int i = 0; i < 1000; ++i) {
        const Quaternion q = quaternion_from_rotation_vector(2.0 * random.normal3());
        const Quaternion target = quaternion_from_rotation_vector(2.0 * random.normal3());
        const Vector3 rate = attitude_control(kDefaults, q, target);
        ASSERT_TRUE(rate.allFinite());
        EXPECT_LE(std::abs(rate.x()), radians(220.0) + 1e-12);
        EXPECT_LE(std::abs(rate.y()), radians(220.0) + 1e-12);
        EXPECT_LE(std::abs(rate.z()), radians(200.0) + 1e-12);
    }
}

/// 170 deg of heading and 30 deg of roll: the thrust axis must turn straight to its target.
TEST(AttitudeControl, TiltErrorGoesBeforeHeading) {
    AutopilotParameters unlimited;
    unlimited.MC_ROLLRATE_MAX = unlimited.MC_PITCHRATE_MAX = unlimited.MC_YAWRATE_MAX = 1800.0;
    const Quaternion q = euler_deg(30.0, 0.0, 0.0);
    const Vector3 rate = attitude_control(unlimited, q, euler_deg(0.0, 0.0, 170.0));
    const Vector3 down_B = q.conjugate() * Vector3::UnitZ();
    const Vector3 shortest = Vector3::UnitZ().cross(down_B).normalized();
    const Vector3 tilt_rate(rate.x(), rate.y(), 0.0);
    EXPECT_GT(tilt_rate.normalized().dot(shortest), 0.7);
    EXPECT_GT(rate.z(), 0.0);

    // without a weight of the heading the way is exactly the shortest
    unlimited.MC_YAW_WEIGHT = 0.0;
    const Vector3 pure = attitude_control(unlimited, q, euler_deg(0.0, 0.0, 170.0));
    EXPECT_NEAR(pure.normalized().dot(shortest), 1.0, 1e-9);
}

TEST(AttitudeControl, UpsideDownStillTurns) {
    const Vector3 rate = attitude_control(kDefaults, euler_deg(180, 0, 0), euler_deg(0, 0, 0));
    ASSERT_TRUE(rate.allFinite());
    EXPECT_NEAR(rate.norm(), radians(220.0), 1e-9);
}

}  // namespace
}  // namespace limpet::autopilot
