// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "plants.hpp"

namespace limpet::plant {
namespace {

using Ray = test::OfEveryEngine;
using Contact = test::OfEveryEngine;

TEST_P(Ray, MeasuresTheDistanceToASlantedWall) {
    models::Scene scene = test::wall_ahead();
    scene.wall.R_WT = quaternion_from_euler({.yaw_rad = radians(20.0)}).toRotationMatrix();
    const auto plant = make(vehicle::Airframe{}, scene);
    // The wall's plane through (1.5, 0) with normal (cos 20, sin 20): along x from y = +-0.2 it is
    // 1.5 -+ 0.2 tan 20 away. The vehicle, in the way, is transparent.
    const Vector3 north(1.0, 0.0, 0.0);
    const double slant = 0.2 * std::tan(radians(20.0));
    EXPECT_NEAR(plant->ray({0.0, 0.2, 0.0}, north).value(), 1.5 - slant, 1e-12);
    EXPECT_NEAR(plant->ray({0.0, -0.2, 0.0}, north).value(), 1.5 + slant, 1e-12);
    const Vector3 square_on = scene.wall.R_WT * north;
    EXPECT_NEAR(plant->ray(Vector3::Zero(), square_on).value(), 1.5 * std::cos(radians(20.0)),
                1e-12);
}

/// A shape's distances and the body that stands for it in the engine are one wall.
TEST_P(Ray, MeetsEveryShapeWhereItsTangentFrameIs) {
    for (const WallShape* shape : wall_shapes()) {
        models::Scene scene = test::wall_ahead();
        scene.wall.shape = shape;
        scene.wall.R_WT =
            quaternion_from_euler({.pitch_rad = radians(10.0), .yaw_rad = radians(20.0)})
                .toRotationMatrix();
        const auto plant = make(vehicle::Airframe{}, scene);
        for (const double y : {-0.8, 0.0, 1.1}) {
            for (const double z : {-0.7, 0.0, 0.9}) {
                const Vector3 p_W_m(0.1, y, z);
                const TangentFrame spot = tangent_frame(scene.wall, p_W_m);
                const auto distance_m = plant->ray(p_W_m, spot.into_W());
                ASSERT_TRUE(distance_m && spot.on_wall) << shape->name;
                EXPECT_NEAR(*distance_m, spot.gap_m, 1e-9) << shape->name;
            }
        }
        const Vector3 above_W_m = scene.wall.R_WT * Vector3(-1.0, 0.0, -2.1) + scene.wall.p_WT_m;
        EXPECT_FALSE(tangent_frame(scene.wall, above_W_m).on_wall) << shape->name;
        EXPECT_FALSE(plant->ray(above_W_m, scene.wall.R_WT.col(0))) << shape->name;
    }
}

TEST_P(Ray, MissesWhatIsNotThere) {
    const auto plant = make(vehicle::Airframe{});
    EXPECT_FALSE(plant->ray(Vector3::Zero(), -Vector3::UnitX()));
    EXPECT_FALSE(plant->ray({0.0, 2.01, 0.0}, Vector3::UnitX()));
    EXPECT_TRUE(plant->ray({0.0, 1.99, 0.0}, Vector3::UnitX()));
    EXPECT_FALSE(plant->ray({0.0, 0.0, -2.01}, Vector3::UnitX()));
    EXPECT_FALSE(plant->ray(Vector3::Zero(), -Vector3::UnitZ()));
}

TEST_P(Ray, FindsTheGroundBelow) {
    const auto plant = make(vehicle::Airframe{});
    EXPECT_NEAR(plant->ray({0.0, 0.0, 1.0}, Vector3::UnitZ()).value(), 9.0, 1e-12);
}

TEST_P(Ray, NeedsNoWall) {
    models::Scene scene = test::wall_ahead();
    scene.wall.present = false;
    const auto plant = make(vehicle::Airframe{}, scene);
    EXPECT_FALSE(plant->ray(Vector3::Zero(), Vector3::UnitX()));
}

/// Weightless in front of the wall, nose up by 60 deg, leg tips just off it; pushed towards it
/// through the middle of the tips.
struct LegsOnWall {
    vehicle::Airframe airframe;
    std::unique_ptr<Plant> plant;
    Vector3 tips_B{airframe.legs.tip_x_m, 0.0, airframe.legs.tip_z_m};

    explicit LegsOnWall(const Engine& engine, const models::Scene& scene = test::wall_ahead())
        : plant(engine.make(airframe, scene)->make()) {
        const Quaternion q_WB = quaternion_from_euler({.pitch_rad = radians(60.0)});
        const double reach_m = (q_WB * tips_B).x() + airframe.legs.tip_radius_m;
        plant->set_pose({1.5 - reach_m - 1e-4, 0.0, 0.0}, q_WB);
    }

    void step(double push_N, const StepMode& mode) {
        const Kinematics base = plant->kinematics(Body::base);
        plant->apply(Body::base,
                     {.force_N = {0.0, 0.0, -airframe.mass_kg * kGravity_m_s2},
                      .moment_N_m = Vector3::Zero()},
                     base.p_WF_m);
        plant->apply(Body::base, {.force_N = {push_N, 0.0, 0.0}, .moment_N_m = Vector3::Zero()},
                     {base.p_WF_m.x(), base.p_WF_m.y(), (base.p_WF_m + base.q_WF * tips_B).z()});
        plant->step(mode);
    }
};

TEST_P(Contact, LegsCarryThePush) {
    LegsOnWall legs(*GetParam());
    Vector3 impulse_N_s = Vector3::Zero();
    for (int i = 0; i < 400; ++i) {
        legs.step(20.0, {.step_s = 1e-3, .contacts = true});
        impulse_N_s += 1e-3 * legs.plant->contact_force_W();
    }
    EXPECT_NEAR(legs.plant->contact_force_W().x(), -20.0, 1.5);
    EXPECT_NEAR(impulse_N_s.x(), -20.0 * 0.4, 0.15);
    EXPECT_NEAR(impulse_N_s.y(), 0.0, 1e-9);
    const Kinematics base = legs.plant->kinematics(Body::base);
    const double tip_x = (base.p_WF_m + base.q_WF * legs.tips_B).x();
    EXPECT_NEAR(tip_x, 1.5 - legs.airframe.legs.tip_radius_m, 1e-3);
}

TEST_P(Contact, CanBeSwitchedOff) {
    LegsOnWall legs(*GetParam());
    for (int i = 0; i < 200; ++i) {
        legs.step(20.0, {.step_s = 1e-3, .contacts = false});
        ASSERT_EQ(legs.plant->contact_force_W(), Vector3::Zero());
    }
    const Kinematics base = legs.plant->kinematics(Body::base);
    EXPECT_GT((base.p_WF_m + base.q_WF * legs.tips_B).x(), 1.55);
}

TEST_P(Contact, SwitchedOnItIsFeltInTheVeryNextStep) {
    LegsOnWall legs(*GetParam());
    while ((legs.plant->kinematics(Body::base).p_WF_m +
            legs.plant->kinematics(Body::base).q_WF * legs.tips_B)
               .x() < 1.49) {
        legs.step(20.0, {.step_s = 1e-3, .contacts = false});
    }
    legs.step(20.0, {.step_s = 1e-3, .contacts = true});
    EXPECT_LT(legs.plant->contact_force_W().x(), 0.0);
}

/// Each tip goes into it by its share of the push; on such a wall the vehicle swings for long.
TEST(ReducedPlant, AWallThatYieldsGivesWayToTheLegs) {
    const auto mean_tip_m = [](LegsOnWall legs) {
        constexpr int kFrom = 1000, kSteps = 3000;
        double sum_m = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            legs.step(20.0, {.step_s = 1e-3, .contacts = true});
            const Kinematics base = legs.plant->kinematics(Body::base);
            sum_m += i >= kFrom ? (base.p_WF_m + base.q_WF * legs.tips_B).x() : 0.0;
        }
        return sum_m / (kSteps - kFrom);
    };
    models::Scene scene = test::wall_ahead();
    scene.wall.compliance_m_N = 2e-4;
    const double given_m =
        mean_tip_m(LegsOnWall(kReducedEngine, scene)) - mean_tip_m(LegsOnWall(kReducedEngine));
    EXPECT_NEAR(given_m, 10.0 / 5e3, 4e-5);
}

INSTANTIATE_TEST_SUITE_P(Of, Ray, test::each_engine(), test::engine_name);
INSTANTIATE_TEST_SUITE_P(Of, Contact, test::each_engine(), test::engine_name);

}  // namespace
}  // namespace limpet::plant
