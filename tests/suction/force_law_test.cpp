// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/force_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::suction {
namespace {

constexpr double kMu = 0.8;
constexpr double kVacuum_N = 100.0;

LipMotion at_gap(double gap_m) {
    LipMotion motion;
    motion.gap_m = gap_m;
    motion.faces_wall = true;
    return motion;
}

/// Over 40 mm a wall of 0.2 m falls away by 4 mm: the lip's soft depth.
TEST(ForceLaw, ALipFollowsAWallAsRoundAsItsSoftDepthLets) {
    LipParameters lip;
    EXPECT_NEAR(least_radius_m(lip), 0.2, 1e-12);
    WallGeometry wall;
    EXPECT_TRUE(follows(lip, wall));  // a plane
    for (const WallShape* shape : wall_shapes()) {
        wall.shape = shape->name == "cylinder" ? shape : wall.shape;
    }
    wall.radius_m = 0.21;
    EXPECT_TRUE(follows(lip, wall));
    wall.radius_m = 0.19;
    EXPECT_FALSE(follows(lip, wall));
    lip.least_radius_m = 0.15;  // as its maker tells
    EXPECT_TRUE(follows(lip, wall));
}

TEST(ForceLaw, VacuumTimesArea) {
    // facts.md section 3: 80 mm cup, 183 N on concrete, 371 N on metal, 67 N at 880 hPa
    EXPECT_NEAR(vacuum_force_N(65000.0, 0.04), 183.0, 1.0);
    EXPECT_NEAR(vacuum_force_N(27500.0, 0.04), 371.0, 1.0);
    EXPECT_NEAR(vacuum_force_N(88000.0, 0.04), 67.0, 0.5);
    EXPECT_EQ(vacuum_force_N(kAtmosphere_Pa + 100.0, 0.04), 0.0);
}

TEST(ForceLaw, PushesSoftThenHard) {
    Anchor anchor;
    const LipParameters lip;
    EXPECT_NEAR(lip_load(lip, at_gap(-0.002), anchor, kMu, 0.0, false).pull_N, -40.0, 1e-9);
    EXPECT_NEAR(lip_load(lip, at_gap(-0.005), anchor, kMu, 0.0, false).pull_N, -180.0, 1e-9);
}

/// By hand: the lip's way by its law and the wall's by its own, for the same force.
TEST(ForceLaw, AWallThatYieldsIsASpringInSeries) {
    const LipParameters lip;
    WallGeometry wall;
    EXPECT_EQ(on_wall(lip, wall).stiffness_N_m, lip.stiffness_N_m);
    wall.compliance_m_N = 2e-4;
    const LipParameters both = on_wall(lip, wall);
    Anchor anchor;
    for (const double push_N : {40.0, 80.0, 180.0}) {
        const double soft_N = lip.stiffness_N_m * lip.hard_depth_m;
        const double lip_m = std::min(push_N, soft_N) / lip.stiffness_N_m +
                             std::max(0.0, push_N - soft_N) / lip.hard_stiffness_N_m;
        const double way_m = lip_m + push_N * wall.compliance_m_N;
        EXPECT_NEAR(lip_load(both, at_gap(-way_m), anchor, kMu, 0.0, false).pull_N, -push_N, 1e-9);
    }
    // What a lip follows does not depend on it.
    EXPECT_EQ(least_radius_m(both), least_radius_m(lip));
}

TEST(ForceLaw, AnOpenLipNeverPulls) {
    Anchor anchor;
    LipMotion leaving = at_gap(-0.001);
    leaving.gap_rate_m_s = 2.0;
    EXPECT_EQ(lip_load({}, leaving, anchor, kMu, 0.0, false).pull_N, 0.0);
    EXPECT_EQ(lip_load({}, at_gap(1e-6), anchor, kMu, 0.0, false).let_go, LetGo::lifted);
}

TEST(ForceLaw, ASealedLipPullsUpToTheVacuumThenLetsGo) {
    Anchor anchor;
    const LipLoad holding = lip_load({}, at_gap(0.0049), anchor, kMu, kVacuum_N, true);
    EXPECT_NEAR(holding.pull_N, 98.0, 1e-9);
    EXPECT_NEAR(holding.pull_margin_N, 2.0, 1e-9);
    EXPECT_EQ(holding.let_go, LetGo::no);
    const LipLoad torn = lip_load({}, at_gap(0.0051), anchor, kMu, kVacuum_N, true);
    EXPECT_EQ(torn.let_go, LetGo::pulled);
    EXPECT_NEAR(torn.pull_N, kVacuum_N, 1e-9);
}

TEST(ForceLaw, ShearsAtCoulombsLimit) {
    Anchor anchor;
    LipMotion motion = at_gap(0.0);
    motion.z_m = 79.0 / 2e4;
    EXPECT_EQ(lip_load({}, motion, anchor, kMu, kVacuum_N, true).let_go, LetGo::no);
    EXPECT_NEAR(lip_load({}, motion, anchor, kMu, kVacuum_N, true).shear_margin_N, 1.0, 1e-9);
    motion.z_m = 81.0 / 2e4;
    EXPECT_EQ(lip_load({}, motion, anchor, kMu, kVacuum_N, true).let_go, LetGo::sheared);
}

TEST(ForceLaw, PullTakesFromTheShearThatItHolds) {
    Anchor anchor;
    LipMotion motion = at_gap(0.0025);  // 50 N of pull leave 50 N on the lip
    motion.y_m = 41.0 / 2e4;
    EXPECT_EQ(lip_load({}, motion, anchor, kMu, kVacuum_N, true).let_go, LetGo::sheared);
}

TEST(ForceLaw, PeelsWhereARingLifts) {
    // A ring of radius R under N lifts at N R/2: 100 N, 40 mm -> 2 N m
    Anchor anchor;
    LipMotion motion = at_gap(0.0);
    motion.rotation_rad.y() = 1.99 / 20.0;
    EXPECT_EQ(lip_load({}, motion, anchor, kMu, kVacuum_N, true).let_go, LetGo::no);
    motion.rotation_rad.y() = 2.01 / 20.0;
    EXPECT_EQ(lip_load({}, motion, anchor, kMu, kVacuum_N, true).let_go, LetGo::peeled);
}

TEST(ForceLaw, AnOpenLipSlidesAndItsAnchorFollows) {
    Anchor anchor;
    LipMotion motion = at_gap(-0.001);  // 20 N
    motion.y_m = 0.01;
    const LipLoad load = lip_load({}, motion, anchor, kMu, 0.0, false);
    EXPECT_NEAR(load.shear_N, 16.0, 1e-9);
    EXPECT_EQ(load.let_go, LetGo::no);
    EXPECT_NEAR(lip_load({}, motion, anchor, kMu, 0.0, false).shear_N, 16.0, 1e-9);
    EXPECT_NEAR(anchor.y_m, 0.01 - 16.0 / 2e4, 1e-12);
}

TEST(ForceLaw, RestoringForcesOpposeTheDisplacement) {
    Anchor anchor;
    LipMotion motion = at_gap(0.0);
    motion.y_m = 1e-4;
    motion.z_m = -2e-4;
    motion.rotation_rad = {0.01, -0.02, 0.03};
    const Wrench wrench = lip_load({}, motion, anchor, kMu, kVacuum_N, true).wrench_T;
    EXPECT_NEAR(wrench.force_N.y(), -2.0, 1e-9);
    EXPECT_NEAR(wrench.force_N.z(), 4.0, 1e-9);
    EXPECT_NEAR(wrench.moment_N_m.x(), -0.2, 1e-9);
    EXPECT_NEAR(wrench.moment_N_m.y(), 0.4, 1e-9);
    EXPECT_NEAR(wrench.moment_N_m.z(), -0.6, 1e-9);
}

TEST(HeldLoad, HasTheLimitsOfTheLaw) {
    const LipParameters lip;  // R 40 mm
    const double vacuum_N = 100.0;
    const auto held = [&](const Vector3& force_N, const Vector3& moment_N_m) {
        return held_load(lip, {.force_N = force_N, .moment_N_m = moment_N_m}, 0.5, vacuum_N);
    };
    // Pulled with 60 N, 40 N press lip on wall: 20 N of shear, 0.8 N m of peel, 0.8 N m of twist.
    const LipLoad load = held({60.0, 9.0, 12.0}, {0.1, 0.3, 0.4});
    EXPECT_NEAR(load.pull_margin_N, 40.0, 1e-12);
    EXPECT_NEAR(load.shear_N, 15.0, 1e-12);
    EXPECT_NEAR(load.shear_margin_N, 5.0, 1e-12);
    EXPECT_NEAR(load.peel_margin_N, 40.0 - 0.5 / 0.02, 1e-12);
    EXPECT_EQ(load.let_go, LetGo::no);
    EXPECT_EQ(held({100.5, 0.0, 0.0}, Vector3::Zero()).let_go, LetGo::pulled);
    EXPECT_EQ(held({60.0, 0.0, 20.5}, Vector3::Zero()).let_go, LetGo::sheared);
    EXPECT_EQ(held({60.0, 0.0, 0.0}, {0.81, 0.0, 0.0}).let_go, LetGo::sheared);
    EXPECT_EQ(held({60.0, 0.0, 0.0}, {0.0, 0.81, 0.0}).let_go, LetGo::peeled);
    EXPECT_EQ(held({-20.0, 0.0, 59.0}, Vector3::Zero()).let_go, LetGo::no) << "pressed on";
}

TEST(LipMotion, IsRelativeToATurnedWall) {
    WallGeometry wall;
    wall.p_WT_m = {1.0, 2.0, 0.0};
    wall.R_WT = quaternion_from_euler({.yaw_rad = kPi / 2.0}).toRotationMatrix();  // faces west
    Kinematics cup;
    cup.p_WF_m = {1.3, 1.9, -0.5};
    cup.q_WF = quaternion_from_euler({.pitch_rad = 0.1, .yaw_rad = kPi / 2.0});
    cup.v_WF_W_m_s = {0.2, 1.1, 0.0};
    const LipMotion motion = lip_motion(wall, cup);
    EXPECT_NEAR(motion.gap_m, 0.1, 1e-12);
    EXPECT_NEAR(motion.gap_rate_m_s, -1.1, 1e-12);
    EXPECT_NEAR(motion.y_m, -0.3, 1e-12);  // y_T of a wall to the east points south
    EXPECT_NEAR(motion.z_m, -0.5, 1e-12);
    EXPECT_NEAR(motion.y_rate_m_s, -0.2, 1e-12);
    EXPECT_NEAR(motion.rotation_rad.y(), 0.1, 1e-12);
    EXPECT_TRUE(motion.faces_wall);
}

TEST(LipMotion, OverABulgeIsThatOfTheSpotBelow) {
    const WallGeometry wall{.radius_m = 2.0, .shape = wall_shapes()[1]};
    ASSERT_EQ(wall.shape->name, "cylinder");
    // 30 deg around the pillar to the right, 0.1 m off, going right and turning as it should.
    const double around_rad = radians(30.0), speed_m_s = 0.3;
    Kinematics cup;
    cup.q_WF = quaternion_from_euler({.yaw_rad = -around_rad});
    cup.p_WF_m = Vector3(2.0, 0.0, 0.0) + cup.q_WF * Vector3(-2.1, 0.0, 0.2);
    cup.v_WF_W_m_s = cup.q_WF * Vector3(0.0, speed_m_s, 0.0);
    cup.w_WF_F_rad_s = {0.0, 0.0, -speed_m_s / 2.1};
    const LipMotion motion = lip_motion(wall, cup);
    EXPECT_NEAR(motion.gap_m, 0.1, 1e-12);
    EXPECT_NEAR(motion.gap_rate_m_s, 0.0, 1e-12);
    EXPECT_NEAR(motion.y_m, 2.0 * around_rad, 1e-12);
    EXPECT_NEAR(motion.z_m, 0.2, 1e-12);
    EXPECT_NEAR(motion.y_rate_m_s, speed_m_s * 2.0 / 2.1, 1e-12);
    EXPECT_NEAR(motion.rotation_rad.norm(), 0.0, 1e-12);
    EXPECT_NEAR(motion.rate_rad_s.norm(), 0.0, 1e-12);
    EXPECT_TRUE(motion.faces_wall);
}

TEST(LipMotion, BesideTheWallItFacesNothing) {
    WallGeometry wall;
    wall.half_width_m = 0.5;
    Kinematics cup;
    cup.p_WF_m = {0.0, 0.6, 0.0};
    EXPECT_FALSE(lip_motion(wall, cup).faces_wall);
}

}  // namespace
}  // namespace limpet::suction
