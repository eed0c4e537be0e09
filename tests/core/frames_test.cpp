// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet {
namespace {

TEST(Frames, EulerAnglesComeBack) {
    for (const double roll : {-2.0, 0.0, 0.7}) {
        for (const double pitch : {-1.4, 0.0, 1.16}) {
            for (const double yaw : {-3.0, 0.0, 2.0}) {
                const Euler back = euler_from_quaternion(
                    quaternion_from_euler({.roll_rad = roll, .pitch_rad = pitch, .yaw_rad = yaw}));
                EXPECT_NEAR(back.roll_rad, roll, 1e-12);
                EXPECT_NEAR(back.pitch_rad, pitch, 1e-12);
                EXPECT_NEAR(back.yaw_rad, yaw, 1e-12);
            }
        }
    }
}

TEST(Frames, NoseUpPointsForwardAxisUp) {
    // 90 deg nose up: x_B points up, which is -z of a north-east-down world
    const Quaternion q_WB = quaternion_from_euler({.pitch_rad = kPi / 2.0});
    EXPECT_LT((q_WB * Vector3::UnitX() - Vector3(0.0, 0.0, -1.0)).norm(), 1e-15);
}

TEST(Frames, YawTurnsNorthToEast) {
    const Quaternion q_WB = quaternion_from_euler({.yaw_rad = kPi / 2.0});
    EXPECT_LT((q_WB * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-15);
}

TEST(Frames, RotationVectorIsTheLogarithm) {
    for (const double angle : {0.0, 1e-12, 1e-7, 0.3, 3.0}) {
        const Vector3 rotation = angle * Vector3(1.0, -2.0, 2.0) / 3.0;
        const Vector3 back =
            rotation_vector_from_quaternion(quaternion_from_rotation_vector(rotation));
        EXPECT_LT((back - rotation).norm(), 1e-14 + 1e-12 * angle);
    }
}

TEST(Frames, SkewIsTheCrossProduct) {
    const Vector3 a(1.0, -2.0, 3.0);
    const Vector3 b(-0.5, 4.0, 2.0);
    EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(Frames, WrapsToTheHalfOpenInterval) {
    EXPECT_DOUBLE_EQ(wrap_pi(kPi), kPi);
    EXPECT_DOUBLE_EQ(wrap_pi(-kPi), kPi);
    EXPECT_NEAR(wrap_pi(3.0 * kPi + 0.1), -kPi + 0.1, 1e-12);
}

/// On both sides of where series take over, to the last bits of the closed forms.
TEST(RotationVector, GoesThereAndBackAtEverySize) {
    for (const double angle_rad : {0.0, 1e-12, 1e-6, 1e-3, 0.05, 0.199999, 0.200001, 1.0, 3.0}) {
        const Vector3 turn_rad = angle_rad * Vector3(0.6, -0.48, 0.64);
        const Quaternion q = quaternion_from_rotation_vector(turn_rad);
        EXPECT_NEAR(q.w(), std::cos(0.5 * angle_rad), 2e-16) << angle_rad;
        EXPECT_NEAR(q.x(), std::sin(0.5 * angle_rad) * 0.6, 2e-16 + 4e-16 * q.x()) << angle_rad;
        const double bound = 1e-15 * (1.0 + angle_rad);
        EXPECT_LT((rotation_vector_from_quaternion(q) - turn_rad).norm(), bound) << angle_rad;
        const Quaternion other_way(-q.w(), -q.x(), -q.y(), -q.z());
        EXPECT_LT((rotation_vector_from_quaternion(other_way) - turn_rad).norm(), bound)
            << angle_rad;
        const Vector3 of_matrix = rotation_vector_from_matrix(q.toRotationMatrix());
        EXPECT_LT((of_matrix - turn_rad).norm(), 4.0 * bound) << angle_rad;
    }
}

TEST(RotationVector, AsksForNoUnitQuaternion) {
    const Vector3 turn_rad(0.01, 0.02, -0.03);
    Quaternion q = quaternion_from_rotation_vector(turn_rad);
    q.coeffs() *= 1.1;
    EXPECT_LT((rotation_vector_from_quaternion(q) - turn_rad).norm(), 1e-16);
}

}  // namespace
}  // namespace limpet
