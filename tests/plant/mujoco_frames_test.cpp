// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_frames.hpp"

#include <gtest/gtest.h>

#include "plants.hpp"

namespace limpet::plant {
namespace {

TEST(MujocoFrames, NorthStaysEastAndDownChangeSign) {
    EXPECT_EQ(mujoco_frames::turn(Vector3(1.0, 2.0, 3.0)), Vector3(1.0, -2.0, -3.0));
}

TEST(MujocoFrames, VectorsAndAttitudesSurviveTheRoundTrip) {
    const Vector3 v(0.1, -2.0, 30.0);
    EXPECT_EQ(mujoco_frames::turn(mujoco_frames::turn(v)), v);
    const Quaternion q = quaternion_from_euler({0.3, -0.9, 2.0});
    double engine[4];
    mujoco_frames::write_attitude(q, engine);
    EXPECT_EQ(mujoco_frames::turn_attitude(engine).coeffs(), q.coeffs());
}

TEST(MujocoFrames, AnAttitudeTurnsTheSameVectorOnBothSides) {
    const Quaternion q_WB = quaternion_from_euler({0.3, -0.9, 2.0});
    double engine[4];
    mujoco_frames::write_attitude(q_WB, engine);
    const Quaternion q_engine(engine[0], engine[1], engine[2], engine[3]);
    const Vector3 v_B(0.5, -1.0, 2.0);
    const Vector3 through_engine =
        mujoco_frames::turn(Vector3(q_engine * mujoco_frames::turn(v_B)));
    EXPECT_TRUE(through_engine.isApprox(q_WB * v_B, 1e-14));
}

TEST(MujocoFrames, YawRightIsTurningClockwiseSeenFromAbove) {
    double engine[4];
    mujoco_frames::write_attitude(quaternion_from_euler({.yaw_rad = radians(90.0)}), engine);
    EXPECT_NEAR(engine[0], std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(engine[3], -std::sqrt(0.5), 1e-15);
}

TEST(MujocoKinematics, PutsTheLipWhereGeometrySays) {
    MujocoPlant plant(test::compile(vehicle::Airframe{}));
    // Nose east and 30 deg up, moving north, yawing right at 2 rad/s about its own z.
    const Quaternion q_WB =
        quaternion_from_euler({.pitch_rad = radians(30.0), .yaw_rad = radians(90.0)});
    const Vector3 p_WB(0.1, 0.2, -0.3);
    const Vector3 v_WB(1.0, 0.0, 0.0);
    const Vector3 w_B(0.0, 0.0, 2.0);
    plant.set_pose(p_WB, q_WB, v_WB, w_B);

    const Kinematics base = plant.kinematics(Body::base);
    EXPECT_TRUE(base.p_WF_m.isApprox(p_WB, 1e-12));
    EXPECT_TRUE(base.q_WF.isApprox(q_WB, 1e-12));
    EXPECT_TRUE(base.v_WF_W_m_s.isApprox(v_WB, 1e-12));
    EXPECT_TRUE(base.w_WF_F_rad_s.isApprox(w_B, 1e-12));

    // Half a metre ahead along the nose: cos 30 east, sin 30 up. Its own z points down and, nose
    // up, forward: (0, sin 30, cos 30) here; w x r = 2 * 0.5 along the body's right, which is
    // south.
    const Kinematics cup = plant.kinematics(Body::cup);
    const Vector3 lip = p_WB + 0.5 * Vector3(0.0, std::cos(radians(30.0)), -0.5);
    EXPECT_TRUE(cup.p_WF_m.isApprox(lip, 1e-12));
    EXPECT_TRUE(cup.q_WF.isApprox(q_WB, 1e-12));
    EXPECT_LT((cup.v_WF_W_m_s - (v_WB + Vector3(-1.0, 0.0, 0.0))).norm(), 1e-12);
    EXPECT_TRUE(cup.w_WF_F_rad_s.isApprox(w_B, 1e-12));
    const Kinematics carriage = plant.kinematics(Body::carriage);
    EXPECT_TRUE(
        carriage.p_WF_m.isApprox(p_WB + 0.46 * Vector3(0.0, std::cos(radians(30.0)), -0.5), 1e-12));
}

TEST(MujocoKinematics, OffersTheEnginesCoordinatesForPictures) {
    MujocoPlant plant(test::compile(vehicle::Airframe{}));
    plant.set_pose({1.0, 2.0, 3.0}, Quaternion::Identity());
    const auto q = plant.positions();
    ASSERT_EQ(q.size(), 10U);
    EXPECT_EQ(q[0], 1.0);
    EXPECT_EQ(q[1], -2.0);
    EXPECT_EQ(q[2], -3.0);
    EXPECT_EQ(q[3], 1.0);
}

}  // namespace
}  // namespace limpet::plant
