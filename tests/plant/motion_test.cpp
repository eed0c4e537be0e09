// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "plants.hpp"

namespace limpet::plant {
namespace {

constexpr StepMode kFree{.step_s = 1e-3, .contacts = false};

using FreeFall = test::OfEveryEngine;
using WrenchOn = test::OfEveryEngine;
using Slider = test::OfEveryEngine;

Vector3 angular_momentum_W(const Kinematics& base, const vehicle::Airframe& airframe) {
    const Vector3 momentum_B = airframe.inertia_kg_m2.asDiagonal() * base.w_WF_F_rad_s;
    return base.q_WF * momentum_B;
}

double energy_J(const Kinematics& base, const vehicle::Airframe& airframe) {
    const Vector3 w = base.w_WF_F_rad_s;
    const Vector3 momentum_B = airframe.inertia_kg_m2.asDiagonal() * w;
    return 0.5 * airframe.mass_kg * base.v_WF_W_m_s.squaredNorm() + 0.5 * w.dot(momentum_B) -
           airframe.mass_kg * kGravity_m_s2 * base.p_WF_m.z();
}

/// Two seconds of a tumbling fall.
Kinematics tumble(const Engine& engine, double step_s) {
    const auto plant = engine.make(test::plain_multirotor(), test::wall_ahead())->make();
    plant->set_pose({0.0, 0.0, -20.0}, Quaternion::Identity(), {1.0, 2.0, -3.0}, {2.0, 1.0, 3.0});
    const int steps = static_cast<int>(std::lround(2.0 / step_s));
    for (int i = 0; i < steps; ++i) {
        plant->step({.step_s = step_s, .contacts = false});
    }
    return plant->kinematics(Body::base);
}

TEST_P(FreeFall, FollowsTheSemiImplicitSumExactly) {
    const auto plant = make(test::plain_multirotor());
    for (int i = 0; i < 500; ++i) {
        plant->step(kFree);
    }
    const Kinematics base = plant->kinematics(Body::base);
    EXPECT_NEAR(base.v_WF_W_m_s.z(), kGravity_m_s2 * 0.5, 1e-10);
    EXPECT_NEAR(base.p_WF_m.z(), kGravity_m_s2 * 1e-6 * 0.5 * 500.0 * 501.0, 1e-10);
    EXPECT_LT(base.p_WF_m.head<2>().norm(), 1e-12);
}

TEST_P(FreeFall, KeepsEnergyMomentumAndTheQuaternionsNorm) {
    const vehicle::Airframe airframe = test::plain_multirotor();
    const auto plant = make(airframe);
    plant->set_pose({0.0, 0.0, -20.0}, Quaternion::Identity(), {1.0, 2.0, -3.0}, {2.0, 1.0, 3.0});
    const Kinematics start = plant->kinematics(Body::base);
    const double energy = energy_J(start, airframe);
    const Vector3 momentum = angular_momentum_W(start, airframe);
    for (int i = 0; i < 8000; ++i) {
        plant->step({.step_s = 0.25e-3, .contacts = false});
        ASSERT_NEAR(plant->kinematics(Body::base).q_WF.norm(), 1.0, 1e-14);
    }
    const Kinematics end = plant->kinematics(Body::base);
    EXPECT_NEAR(energy_J(end, airframe) / energy, 1.0, 2e-4);
    EXPECT_NEAR(angular_momentum_W(end, airframe).norm() / momentum.norm(), 1.0, 2e-3);
    EXPECT_LT((angular_momentum_W(end, airframe) - momentum).norm() / momentum.norm(), 4e-3);
}

/// Semi-implicit Euler keeps neither exactly. What docs/models.md says of steps of a flight: in
/// 2.8 s of a tumble at 0.6 turns/s the angular momentum is off by 8e-3 in strides of 4 ms, by 2e-3
/// in ticks of 1 ms.
TEST_P(FreeFall, InStridesATumblesMomentumIsOffByThousandths) {
    const vehicle::Airframe airframe = test::plain_multirotor();
    const auto off = [&](double step_s) {
        const auto plant = make(airframe);
        plant->set_pose({0.0, 0.0, -40.0}, Quaternion::Identity(), {}, {2.0, 1.0, 3.0});
        const Vector3 before = angular_momentum_W(plant->kinematics(Body::base), airframe);
        const int steps = static_cast<int>(std::lround(2.8 / step_s));
        for (int i = 0; i < steps; ++i) {
            plant->step({.step_s = step_s, .contacts = false});
        }
        return (angular_momentum_W(plant->kinematics(Body::base), airframe) - before).norm() /
               before.norm();
    };
    const double longest = off(4e-3), tick = off(1e-3);
    RecordProperty("longest", std::to_string(longest));
    RecordProperty("tick", std::to_string(tick));
    EXPECT_LT(longest, 0.01);
    EXPECT_LT(tick, 0.0025);
    EXPECT_NEAR(longest / tick, 4.0, 0.4);
}

TEST_P(FreeFall, HalvingTheStepHalvesTheErrors) {
    const Kinematics fine = tumble(*GetParam(), 2e-3 / 64.0);
    const auto error = [&fine](double step_s) {
        return rotation_vector_from_quaternion(fine.q_WF.conjugate() *
                                               tumble(*GetParam(), step_s).q_WF)
            .norm();
    };
    const double coarse = error(2e-3);
    EXPECT_GT(coarse, 1e-4);
    EXPECT_NEAR(coarse / error(1e-3), 2.0, 0.15);
}

TEST_P(WrenchOn, AtALeverArmTurnsAndPushes) {
    const vehicle::Airframe airframe = test::plain_multirotor();
    const auto plant = make(airframe);
    const Quaternion q_WB = quaternion_from_euler({0.4, -0.3, 1.1});
    const Vector3 p_WB(0.2, -0.1, -1.0);
    plant->set_pose(p_WB, q_WB);
    const Vector3 arm_B(0.3, -0.2, 0.1);
    const Vector3 force_B(1.0, 2.0, -3.0);
    const Vector3 moment_B(0.05, -0.02, 0.03);
    // In two halves, which must add up.
    for (int i = 0; i < 2; ++i) {
        plant->apply(Body::base,
                     {.force_N = q_WB * (0.5 * force_B), .moment_N_m = q_WB * (0.5 * moment_B)},
                     p_WB + q_WB * arm_B);
    }
    plant->step(kFree);
    const Kinematics base = plant->kinematics(Body::base);
    const Vector3 gravity(0.0, 0.0, kGravity_m_s2);
    EXPECT_LT((base.v_WF_W_m_s / 1e-3 - (q_WB * force_B / airframe.mass_kg + gravity)).norm(),
              1e-9);
    const Vector3 torque_B = arm_B.cross(force_B) + moment_B;
    const Vector3 expected = airframe.inertia_kg_m2.cwiseInverse().cwiseProduct(torque_B);
    EXPECT_LT((base.w_WF_F_rad_s / 1e-3 - expected).norm(), 1e-9);
}

TEST_P(WrenchOn, LastsForOneStep) {
    const auto plant = make(test::plain_multirotor());
    plant->apply(Body::base, {.force_N = {3.2, 0.0, 0.0}, .moment_N_m = Vector3::Zero()},
                 Vector3::Zero());
    plant->step(kFree);
    plant->step(kFree);
    EXPECT_NEAR(plant->kinematics(Body::base).v_WF_W_m_s.x(), 1e-3, 1e-12);
}

TEST_P(WrenchOn, OnTheCupMovesTheWholeVehiclesCentreOfMass) {
    const vehicle::Airframe airframe;
    const auto plant = make(airframe);
    const Vector3 force_W(4.0, -2.0, 1.0);
    for (int i = 0; i < 20; ++i) {
        plant->apply(Body::cup, {.force_N = force_W, .moment_N_m = Vector3::Zero()},
                     plant->kinematics(Body::cup).p_WF_m);
        plant->step(kFree);
    }
    // The momentum of all three bodies, each at its own centre of mass.
    Vector3 momentum = Vector3::Zero();
    const auto add = [&](Body body, double mass_kg, const Vector3& centre_F_m) {
        const Kinematics at = plant->kinematics(body);
        momentum += mass_kg * (at.v_WF_W_m_s + at.q_WF * at.w_WF_F_rad_s.cross(centre_F_m));
    };
    const Vector3 joint(airframe.cup.joint_x_m, 0.0, 0.0);
    add(Body::base, base_inertia(airframe).mass_kg, base_inertia(airframe).centre_B_m);
    add(Body::carriage, airframe.slider.mass_kg, carriage_inertia(airframe).centre_B_m - joint);
    add(Body::cup, airframe.cup.mass_kg, {airframe.cup.mass_offset_m - 0.04, 0.0, 0.0});
    const Vector3 expected = 0.02 * (force_W + airframe.mass_kg * kGravity_m_s2 * Vector3::UnitZ());
    // The engine's step keeps momentum to first order in its length once joints move.
    EXPECT_LT((momentum - expected).norm(), 1e-4 * expected.norm());
}

/// Falls freely with the stops at work and a push on both ends of the slider.
double settled_slider_m(Plant& plant, double push_N) {
    for (int i = 0; i < 3000; ++i) {
        const Vector3 push_W = plant.kinematics(Body::base).q_WF * Vector3(push_N, 0.0, 0.0);
        plant.apply(Body::base, {.force_N = push_W, .moment_N_m = Vector3::Zero()},
                    plant.kinematics(Body::base).p_WF_m);
        plant.apply(Body::carriage, {.force_N = -push_W, .moment_N_m = Vector3::Zero()},
                    plant.kinematics(Body::carriage).p_WF_m);
        plant.step(kFree);
    }
    return plant.slider().position_m;
}

TEST_P(Slider, RestsWherePreloadSpringAndStopBalance) {
    EXPECT_NEAR(settled_slider_m(*make(), 0.0), 5.0 / (500.0 + 2e4), 1e-9);
    EXPECT_NEAR(settled_slider_m(*make(), 30.0), (5.0 - 30.0) / 500.0, 1e-9);
    // 60 N: the spring takes 5 + 45 at the end of the travel, the inner stop shares the rest.
    EXPECT_NEAR(settled_slider_m(*make(), 60.0), -0.09 - 10.0 / (500.0 + 2e4), 1e-9);
}

TEST_P(Slider, IsAbsentWithoutACup) {
    const auto plant = make(test::plain_multirotor());
    EXPECT_EQ(plant->slider().position_m, 0.0);
    EXPECT_EQ(plant->slider().velocity_m_s, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Of, FreeFall, test::each_engine(), test::engine_name);
INSTANTIATE_TEST_SUITE_P(Of, WrenchOn, test::each_engine(), test::engine_name);
INSTANTIATE_TEST_SUITE_P(Of, Slider, test::each_engine(), test::engine_name);

}  // namespace
}  // namespace limpet::plant
