// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/reduced_plant.hpp"

#include <gtest/gtest.h>

#include "limpet/core/random.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

std::shared_ptr<const PlantModel> reduced(const vehicle::Airframe& airframe,
                                          const models::Scene& scene = test::wall_ahead()) {
    return kReducedEngine.make(airframe, scene);
}

/// Springs without dampers, so that nothing takes energy out.
vehicle::Airframe lossless() {
    vehicle::Airframe airframe;
    airframe.slider.damping_N_s_m = 0.0;
    airframe.slider.preload_N = 0.0;
    airframe.slider.stop_damping_N_s_m = 0.0;
    airframe.cup.centring_damping_N_m_s_rad = 0.0;
    return airframe;
}

struct Totals {
    double energy_J = 0.0;
    Vector3 momentum_N_s = Vector3::Zero();
    Vector3 angular_N_m_s = Vector3::Zero();  ///< about W's origin
};

/// Body by body from where each is and how it moves; knows nothing of generalised coordinates.
Totals totals(const Plant& plant, const vehicle::Airframe& airframe) {
    Totals all;
    const Vector3 joint_B_m(airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m);
    const auto add = [&](Body body, const vehicle::BodyInertia& of, const Vector3& origin_m) {
        const Kinematics at = plant.kinematics(body);
        const Vector3 arm_F_m = of.centre_B_m - origin_m;
        const Vector3 p_W_m = at.p_WF_m + at.q_WF * arm_F_m;
        const Vector3 v_W_m_s = at.v_WF_W_m_s + at.q_WF * at.w_WF_F_rad_s.cross(arm_F_m);
        const Vector3 spin_F = of.inertia_kg_m2 * at.w_WF_F_rad_s;
        all.energy_J += 0.5 * of.mass_kg * v_W_m_s.squaredNorm() +
                        0.5 * at.w_WF_F_rad_s.dot(spin_F) - of.mass_kg * kGravity_m_s2 * p_W_m.z();
        all.momentum_N_s += of.mass_kg * v_W_m_s;
        all.angular_N_m_s += p_W_m.cross(of.mass_kg * v_W_m_s) + at.q_WF * spin_F;
    };
    add(Body::base, base_inertia(airframe), Vector3::Zero());
    add(Body::carriage, carriage_inertia(airframe), joint_B_m);
    add(Body::cup, cup_inertia(airframe), joint_B_m + Vector3(airframe.cup.lip_offset_m, 0.0, 0.0));
    const SliderMotion slider = plant.slider();
    const Kinematics base = plant.kinematics(Body::base);
    const Vector3 mouth_B =
        base.q_WF.conjugate() * plant.kinematics(Body::cup).q_WF * Vector3::UnitX();
    const double pitch_rad = std::atan2(-mouth_B.z(), mouth_B.x());
    const double yaw_rad = std::asin(mouth_B.y());
    const double stretch_m = std::max(0.0, slider.position_m);
    all.energy_J +=
        0.5 * airframe.slider.stiffness_N_m * std::pow(slider.position_m, 2) +
        0.5 * airframe.slider.stop_stiffness_N_m * stretch_m * stretch_m +
        0.5 * airframe.cup.centring_stiffness_N_m_rad * (pitch_rad * pitch_rad + yaw_rad * yaw_rad);
    return all;
}

/// Tumbles in free fall with all joints in motion, and what it has gained or lost.
Totals drift(double step_s) {
    const vehicle::Airframe airframe = lossless();
    const auto plant = reduced(airframe)->make();
    plant->set_pose({0.0, 0.0, -20.0}, Quaternion::Identity(), {1.0, 2.0, -3.0}, {1.5, 1.0, 2.0});
    const Totals before = totals(*plant, airframe);
    const double duration_s = 1.0;
    const long steps = std::lround(duration_s / step_s);
    for (long k = 0; k < steps; ++k) {
        plant->step({.step_s = step_s, .contacts = false});
    }
    Totals after = totals(*plant, airframe);
    const Vector3 weight_N(0.0, 0.0, airframe.mass_kg * kGravity_m_s2);
    // The weight's moment about W's origin over the fall, of a parabola's centre of mass.
    Vector3 com_m = Vector3(0.0, 0.0, -20.0);
    const Vector3 v0_m_s = before.momentum_N_s / airframe.mass_kg;
    const Vector3 lever_m_s = com_m * duration_s + 0.5 * v0_m_s * duration_s * duration_s;
    after.angular_N_m_s -= before.angular_N_m_s + lever_m_s.cross(weight_N);
    after.momentum_N_s -= before.momentum_N_s + duration_s * weight_N;
    after.energy_J -= before.energy_J;
    return after;
}

/// Semi-implicit Euler errs in proportion to the step; what twice the finer step's drift leaves of
/// the coarser's is the bodies' own.
TEST(ReducedPlant, ATumbleWithItsJointsInMotionKeepsEnergyAndMomentum) {
    const Totals coarse = drift(1e-4);
    const Totals fine = drift(5e-5);
    const double angular_N_m_s =
        Vector3(0.05 * 1.5, 0.10 * 1.0, 0.14 * 2.0).norm();  // at the start
    const double momentum_N_s = 3.2 * Vector3(1.0, 2.0, 3.0).norm();
    EXPECT_NEAR(coarse.angular_N_m_s.norm() / fine.angular_N_m_s.norm(), 2.0, 0.02);
    EXPECT_LT((2.0 * fine.angular_N_m_s - coarse.angular_N_m_s).norm(), 1e-6 * angular_N_m_s);
    EXPECT_LT((2.0 * fine.momentum_N_s - coarse.momentum_N_s).norm(), 1e-6 * momentum_N_s);
    EXPECT_LT(std::abs(2.0 * fine.energy_J - coarse.energy_J), 1e-4);
}

/// Hangs from its lip by a stiff ball joint and swings as one body would whose joints are locked:
/// the period is that of a physical pendulum, 2 pi sqrt(I / (m g L)).
TEST(ReducedPlant, SwingsAsAPhysicalPendulum) {
    vehicle::Airframe airframe;
    airframe.slider.stiffness_N_m = 1e5;
    airframe.slider.preload_N = 0.0;
    airframe.cup.centring_stiffness_N_m_rad = 1e3;
    const auto plant = reduced(airframe)->make();
    const Vector3 pivot_W_m(-1.0, 0.0, -5.0);
    const double reach_m = airframe.cup.joint_x_m + airframe.cup.lip_offset_m;
    const double swing_rad = 0.02;
    const auto q_WB = quaternion_from_euler({.pitch_rad = kPi / 2.0 - swing_rad});
    plant->set_pose(pivot_W_m - q_WB * Vector3(reach_m, 0.0, 0.0), q_WB);
    const double step_s = 1e-4;
    std::vector<double> crossings_s;
    double last = -1.0;
    for (int k = 0; k < 60000; ++k) {
        const Kinematics lip = plant->kinematics(Body::cup);
        plant->apply(Body::cup,
                     {.force_N = -1e5 * (lip.p_WF_m - pivot_W_m) - 30.0 * lip.v_WF_W_m_s,
                      .moment_N_m = Vector3::Zero()},
                     lip.p_WF_m);
        plant->step({.step_s = step_s, .contacts = false});
        const double now = (plant->kinematics(Body::base).q_WF * Vector3::UnitX()).x();
        if (last > 0.0 && now <= 0.0) {
            crossings_s.push_back((k + now / (last - now)) * step_s);
        }
        last = now;
    }
    ASSERT_GE(crossings_s.size(), 3U);
    const double period_s =
        (crossings_s.back() - crossings_s.front()) / static_cast<double>(crossings_s.size() - 1);
    const double inertia = airframe.inertia_kg_m2.y() + airframe.mass_kg * reach_m * reach_m;
    const double expected_s =
        2.0 * kPi * std::sqrt(inertia / (airframe.mass_kg * kGravity_m_s2 * reach_m));
    EXPECT_NEAR(period_s, expected_s, 1e-3 * expected_s);
}

/// Its legs press on the wall while something pulls it down along it.
struct Dragged {
    vehicle::Airframe airframe;
    std::unique_ptr<Plant> plant = reduced(airframe)->make();
    double press_N = 20.0;
    const Quaternion q_WB = quaternion_from_euler({.pitch_rad = radians(60.0)});

    Dragged() {
        const Vector3 tips_B_m(airframe.legs.tip_x_m, 0.0, airframe.legs.tip_z_m);
        plant->set_pose({1.5 - (q_WB * tips_B_m).x() - airframe.legs.tip_radius_m, 0.0, 0.0}, q_WB);
        slide(0.0, 2.0);
    }
    /// Presses at the tips, holds the attitude, and drags.
    Vector3 slide(double drag_N, double duration_s) {
        const Vector3 tips_B_m(airframe.legs.tip_x_m, 0.0, airframe.legs.tip_z_m);
        const Vector3 from_m = plant->kinematics(Body::base).p_WF_m;
        for (int k = 0; k < std::lround(duration_s / 1e-3); ++k) {
            const Kinematics base = plant->kinematics(Body::base);
            const Vector3 tips_W_m = base.p_WF_m + base.q_WF * tips_B_m;
            const Vector3 turned_rad =
                rotation_vector_from_quaternion(base.q_WF.conjugate() * q_WB);
            plant->apply(Body::base,
                         {.force_N = {0.0, 0.0, -airframe.mass_kg * kGravity_m_s2},
                          .moment_N_m = base.q_WF * (50.0 * turned_rad - 4.0 * base.w_WF_F_rad_s)},
                         base.p_WF_m);
            plant->apply(Body::base,
                         {.force_N = {press_N, 0.0, drag_N}, .moment_N_m = Vector3::Zero()},
                         tips_W_m);
            plant->step({});
        }
        return plant->kinematics(Body::base).p_WF_m - from_m;
    }
};

TEST(ReducedPlant, LegsStickAndDoNotCreep) {
    Dragged legs;
    const double limit_N = legs.airframe.legs.friction * legs.press_N;
    legs.slide(0.5 * limit_N, 2.0);
    EXPECT_LT(std::abs(legs.slide(0.5 * limit_N, 7.0).z()), 1e-6);
    EXPECT_NEAR(legs.plant->contact_force_W().z(), -0.5 * limit_N, 0.02 * limit_N);
}

TEST(ReducedPlant, LegsSlideAtCoulombsLimit) {
    Dragged legs;
    const double limit_N = legs.airframe.legs.friction * legs.press_N;
    EXPECT_GT(legs.slide(1.3 * limit_N, 0.5).z(), 0.05);
    EXPECT_NEAR(legs.plant->contact_force_W().z(), -limit_N, 0.05 * limit_N);
}

TEST(ReducedPlant, LandsOnTheGround) {
    vehicle::Airframe airframe;
    const auto plant = reduced(airframe)->make();  // the floor is at z = 10 m
    const double stand_m = 10.0 - airframe.legs.tip_z_m - airframe.legs.tip_radius_m;
    plant->set_pose({-3.0, 0.0, stand_m - 0.02}, Quaternion::Identity());
    for (int k = 0; k < 2000; ++k) {
        const Kinematics base = plant->kinematics(Body::base);
        const Vector3 upright = rotation_vector_from_quaternion(base.q_WF.conjugate());
        plant->apply(Body::base,
                     {.force_N = Vector3::Zero(),
                      .moment_N_m = base.q_WF * (50.0 * upright - 4.0 * base.w_WF_F_rad_s)},
                     base.p_WF_m);
        plant->step({});
    }
    EXPECT_NEAR(plant->kinematics(Body::base).p_WF_m.z(), stand_m, 5e-3);
    EXPECT_NEAR(plant->contact_force_W().z(), -airframe.mass_kg * kGravity_m_s2, 0.1);
}

/// MuJoCo's rays are those of its shapes, ours of the wall's own formula.
TEST(ReducedPlant, RaysAreMujocos) {
    RandomStream random(3, 0, Stream::test);
    for (const WallShape* shape : wall_shapes()) {
        models::Scene scene = test::wall_ahead();
        scene.wall.shape = shape;
        scene.wall.R_WT =
            quaternion_from_euler({.pitch_rad = 0.2, .yaw_rad = 0.3}).toRotationMatrix();
        const auto ours = reduced({}, scene)->make();
        const auto theirs = kMujocoEngine.make({}, scene)->make();
        int hits = 0;
        for (int k = 0; k < 2000; ++k) {
            const Vector3 from_m(-random.uniform(), 3.0 * random.normal(), 3.0 * random.normal());
            const Vector3 along = (random.normal3() + Vector3(1.0, 0.0, 0.0)).normalized();
            const auto way_m = ours->ray(from_m, along);
            const auto expected_m = theirs->ray(from_m, along);
            ASSERT_EQ(way_m.has_value(), expected_m.has_value()) << shape->name << " " << k;
            if (way_m) {
                EXPECT_NEAR(*way_m, *expected_m, 1e-9) << shape->name;
                ++hits;
            }
        }
        EXPECT_GT(hits, 500);
    }
}

/// What it says the cup will do in a step is what it does.
TEST(ReducedPlant, TheCupAnswersAsItSaid) {
    for (const Engine* engine : engines()) {
        const auto plant = engine->make({}, test::wall_ahead())->make();
        plant->set_pose({0.0, 0.0, -2.0}, quaternion_from_euler({0.3, 0.5, -0.2}), {1.0, 0.2, 0.3},
                        {0.5, -1.0, 0.7});
        for (int k = 0; k < 50; ++k) {  // joints in motion
            plant->step({});
        }
        const StepMode mode{.step_s = 1e-5, .contacts = false};
        const Kinematics before = plant->kinematics(Body::cup);
        const Matrix3 R_WT = quaternion_from_euler({0.1, 0.2, 0.3}).toRotationMatrix();
        const CupBearer::Response response = plant->bear_cup(mode)->response(R_WT);
        Vector6 wrench_T;
        wrench_T << 3.0, -2.0, 1.0, 0.02, -0.03, 0.01;
        plant->apply(
            Body::cup,
            {.force_N = R_WT * wrench_T.head<3>(), .moment_N_m = R_WT * wrench_T.tail<3>()},
            before.p_WF_m);
        plant->step(mode);
        const Kinematics after = plant->kinematics(Body::cup);
        Vector6 change;
        change << R_WT.transpose() * (after.v_WF_W_m_s - before.v_WF_W_m_s),
            R_WT.transpose() *
                (after.q_WF * after.w_WF_F_rad_s - before.q_WF * before.w_WF_F_rad_s);
        const Vector6 said = response.drift + response.mobility * wrench_T;
        EXPECT_LT((change - said).norm(), 2e-3 * change.norm()) << engine->name;
        EXPECT_NEAR(plant->slider().force_N, response.press_with_N(wrench_T), 1e-9) << engine->name;
    }
}

/// Held by springs it moves as it said, too, and feels what they pulled.
TEST(ReducedPlant, TheCupMovesAsItSaidWhenHeld) {
    const auto plant = reduced({})->make();
    plant->set_pose({0.0, 0.0, -2.0}, quaternion_from_euler({0.3, 0.5, -0.2}), {1.0, 0.2, 0.3},
                    {0.5, -1.0, 0.7});
    for (int k = 0; k < 50; ++k) {  // joints in motion
        plant->step({});
    }
    const StepMode mode{.step_s = 1e-5, .contacts = false};
    const Kinematics before = plant->kinematics(Body::cup);
    const Matrix3 R_WT = quaternion_from_euler({0.1, 0.2, 0.3}).toRotationMatrix();
    std::array<StepForce<double>, 6> springs;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const double size = i < 3 ? 50.0 : 0.5;
        springs[i] = {.now = (i % 2 == 0 ? size : -size), .gain = 20.0 * size};
    }
    const auto held = plant->bear_cup(mode)->hold(R_WT, springs);
    plant->apply(Body::cup, {.force_N = {1e3, 0.0, 0.0}}, before.p_WF_m);  // said already: no more
    plant->step(mode);
    const Kinematics after = plant->kinematics(Body::cup);
    Vector6 change;
    change << R_WT.transpose() * (after.v_WF_W_m_s - before.v_WF_W_m_s),
        R_WT.transpose() * (after.q_WF * after.w_WF_F_rad_s - before.q_WF * before.w_WF_F_rad_s);
    EXPECT_LT((change - held.change).norm(), 2e-3 * change.norm());
    EXPECT_NEAR(plant->slider().force_N, held.press_N, 1e-9);

    // The same wrench without springs moves it the same, but for how stiff the step takes the
    // joints to be: behind a held lip they turn heavier bodies.
    const auto other = reduced({})->make();
    other->set_pose({0.0, 0.0, -2.0}, quaternion_from_euler({0.3, 0.5, -0.2}), {1.0, 0.2, 0.3},
                    {0.5, -1.0, 0.7});
    for (int k = 0; k < 50; ++k) {
        other->step({});
    }
    Vector6 wrench_T;
    for (int i = 0; i < 6; ++i) {
        const StepForce<double>& spring = springs[static_cast<std::size_t>(i)];
        wrench_T[i] = spring.now - spring.gain * held.change[i];
    }
    other->apply(Body::cup,
                 {.force_N = R_WT * wrench_T.head<3>(), .moment_N_m = R_WT * wrench_T.tail<3>()},
                 before.p_WF_m);
    other->step(mode);
    const Kinematics pushed = other->kinematics(Body::cup);
    EXPECT_LT((pushed.v_WF_W_m_s - after.v_WF_W_m_s).norm(), 1e-5 * change.head<3>().norm());
    EXPECT_LT((pushed.w_WF_F_rad_s - after.w_WF_F_rad_s).norm(), 1e-5 * change.tail<3>().norm());
}

TEST(ReducedPlant, DisplacementIsTheInverseOfDisplacing) {
    ReducedPlant plant(reduced({}));
    plant.set_pose({0.1, 0.2, 0.3}, quaternion_from_euler({0.3, 0.2, 0.1}));
    const PlantState origin = plant.save();
    std::array<double, 2 * kFreedoms> step{};
    for (std::size_t i = 0; i < step.size(); ++i) {
        step[i] = 1e-3 * static_cast<double>(i + 1);
    }
    plant.displace(step);
    std::array<double, 2 * kFreedoms> found{};
    plant.displacement_from(origin, found);
    for (std::size_t i = 0; i < step.size(); ++i) {
        EXPECT_NEAR(found[i], step[i], 1e-14) << i;
    }
}

}  // namespace
}  // namespace limpet::plant
