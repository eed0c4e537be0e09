// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/mount.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::vehicle {
namespace {

const double kWeight_N = Airframe{}.mass_kg * kGravity_m_s2;

Kinematics at(const Vector3& p_W_m, const Quaternion& q_WB = Quaternion::Identity()) {
    Kinematics base;
    base.p_WF_m = p_W_m;
    base.q_WF = q_WB;
    return base;
}

TEST(Mounts, HaveNames) {
    for (const Mount mount : {Mount::free, Mount::pendulum, Mount::press_rig}) {
        EXPECT_EQ(enumerator_of<Mount>(to_string(mount)), mount);
    }
    EXPECT_EQ(enumerator_of<Mount>("crane"), std::nullopt);
}

/// facts.md section 4: on 5 m, 3.3 deg give 0.4 m/s and 9.0 deg (6.2 cm) give 1.1 m/s.
TEST(Pendulum, IsPulledBackAsTheSpeedAsks) {
    EXPECT_NEAR(degrees(swing_angle_rad(0.4, 5.0)), 3.3, 0.05);
    EXPECT_NEAR(degrees(swing_angle_rad(1.1, 5.0)), 9.0, 0.05);
    EXPECT_NEAR(5.0 * (1.0 - std::cos(swing_angle_rad(1.1, 5.0))), 0.062, 5e-4);
}

class Hanging : public testing::TestWithParam<Euler> {};

TEST_P(Hanging, AtItsLowestPointTheRopesCarryTheWeightWithoutAMoment) {
    const Quaternion q_WB = quaternion_from_euler(GetParam());
    const Vector3 lowest(1.0, 2.0, -0.5);
    const Pendulum pendulum = hang({}, Airframe{}, lowest, q_WB);
    const Wrench wrench = rope_wrench_W(pendulum, at(lowest, q_WB));
    EXPECT_NEAR((wrench.force_N - Vector3(0.0, 0.0, -kWeight_N)).norm(), 0.0, 1e-6);
    EXPECT_NEAR(wrench.moment_N_m.norm(), 0.0, 1e-6);
}

TEST_P(Hanging, OnTheArcItFeelsAForceAlongTheRopesAndNoMoment) {
    const Quaternion q_WB = quaternion_from_euler(GetParam());
    const Pendulum pendulum = hang({}, Airframe{}, Vector3::Zero(), q_WB);
    const double angle_rad = radians(8.0);
    const Vector3 on_arc = 5.0 * Vector3(-std::sin(angle_rad), 0.0, std::cos(angle_rad) - 1.0);
    const Wrench wrench = rope_wrench_W(pendulum, at(on_arc, q_WB));
    const Vector3 up(std::sin(angle_rad), 0.0, -std::cos(angle_rad));
    EXPECT_NEAR((wrench.force_N - kWeight_N * up).norm(), 0.0, 1e-6);
    EXPECT_NEAR(wrench.moment_N_m.norm(), 0.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Askew, Hanging,
    testing::Values(Euler{}, Euler{.pitch_rad = radians(6.0)}, Euler{.yaw_rad = radians(-12.0)},
                    Euler{.pitch_rad = radians(-9.0), .yaw_rad = radians(15.0)}));

TEST(Pendulum, RopesNeverPush) {
    const Pendulum pendulum = hang({}, Airframe{}, Vector3::Zero(), Quaternion::Identity());
    EXPECT_EQ(rope_wrench_W(pendulum, at({0.0, 0.0, -0.01})).force_N, Vector3::Zero());
    Kinematics rising = at({0.0, 0.0, 0.0});
    rising.v_WF_W_m_s = {0.0, 0.0, -10.0};  // the dampers alone would push it down
    EXPECT_EQ(rope_wrench_W(pendulum, rising).force_N, Vector3::Zero());
}

TEST(Pendulum, RopesRightAPitchedVehicle) {
    const Pendulum pendulum = hang({}, Airframe{}, Vector3::Zero(), Quaternion::Identity());
    const double pitch_rad = 1e-4;
    const Wrench wrench = rope_wrench_W(
        pendulum, at(Vector3::Zero(), quaternion_from_euler({.pitch_rad = pitch_rad})));
    // four ropes of k at x = 0.205 m: -4 k x^2, small angle; the weight adds no lever
    const double k_N_m = kWeight_N / 4.0 / 1e-3;
    EXPECT_NEAR(wrench.moment_N_m.y(), -4.0 * k_N_m * 0.205 * 0.205 * pitch_rad, 2e-4);
}

TEST(PressRig, ClampCarriesTheWeightAndPullsBackByHand) {
    const Clamp held = clamp({}, Airframe{});
    const Kinematics target = at({1.0, 0.0, 0.0});
    const Vector3 up(0.0, 0.0, -kWeight_N);
    EXPECT_NEAR((clamp_wrench_W(held, target, target).force_N - up).norm(), 0.0, 1e-12);
    const Wrench off = clamp_wrench_W(
        held, target, at({0.996, 0.0, 0.0}, quaternion_from_euler({.yaw_rad = 0.01})));
    EXPECT_NEAR((off.force_N - up - Vector3(80.0, 0.0, 0.0)).norm(), 0.0, 1e-9);  // 2e4 x 4 mm
    EXPECT_NEAR((off.moment_N_m - Vector3(0.0, 0.0, -5.0)).norm(), 0.0, 1e-9);    // 500 x 0.01
    Kinematics moving = target;
    moving.v_WF_W_m_s = {0.1, 0.0, 0.0};
    EXPECT_NEAR(clamp_wrench_W(held, target, moving).force_N.x(), -0.1 * 2.0 * std::sqrt(2e4 * 3.2),
                1e-9);
}

}  // namespace
}  // namespace limpet::vehicle
