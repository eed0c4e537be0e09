// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hosted.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::gazebo11 {
namespace {

using ::testing::HasSubstr;

/// perch_concrete's vehicle in Gazebo, without its plugin: the test is the loop.
class GazeboPlantTest : public ::testing::Test {
protected:
    explicit GazeboPlantTest(std::vector<std::string> overrides = {})
        : scenario(scenario::load_scenario("perch_concrete", {.overrides = std::move(overrides)})) {
    }

    void open() { open(bare_world(scenario)); }
    void open(const std::string& sdf) {
        server.emplace(sdf);
        world = server->world();
        vehicle = world->ModelByName(scenario.airframe.name);
        ASSERT_NE(vehicle, nullptr);
        model = std::make_shared<const GazeboModel>(vehicle, scenario, [this] {
            gazebo::runWorld(world, 1);
            return true;
        });
        plant = model->make();
    }

    /// As the loop does in each step.
    /// @param pushes  what is added
    template <class Push>
    void run(double duration_s, Push pushes, double step_s = 1e-3) {
        const int steps = static_cast<int>(std::lround(duration_s / step_s));
        for (int k = 0; k < steps; ++k) {
            pushes();
            plant->step({.step_s = step_s, .contacts = true});
        }
    }
    /// On the origin of a body.
    void push(plant::Body body, const Vector3& force_W_N,
              const Vector3& moment_W_N_m = Vector3::Zero()) {
        plant->apply(body, {.force_N = force_W_N, .moment_N_m = moment_W_N_m},
                     plant->kinematics(body).p_WF_m);
    }
    void carry() {
        push(plant::Body::base, {0.0, 0.0, -scenario.airframe.mass_kg * kGravity_m_s2});
    }

    scenario::Scenario scenario;
    std::optional<GazeboServer> server;
    gazebo::physics::WorldPtr world;
    gazebo::physics::ModelPtr vehicle;
    std::shared_ptr<const GazeboModel> model;
    std::unique_ptr<plant::Plant> plant;
};

TEST_F(GazeboPlantTest, StandsWhereTheScenarioStarts) {
    open();
    const Kinematics base = plant->kinematics(plant::Body::base);
    EXPECT_NEAR((base.p_WF_m - scenario.start.p_WB_m).norm(), 0.0, 1e-6);
    EXPECT_NEAR(base.q_WF.angularDistance(attitude(scenario.start)), 0.0, 1e-6);
    const Vector3 lip_B_m(scenario.airframe.cup.joint_x_m + scenario.airframe.cup.lip_offset_m, 0.0,
                          scenario.airframe.cup.joint_z_m);
    const Vector3 lip_W_m = scenario.start.p_WB_m + attitude(scenario.start) * lip_B_m;
    EXPECT_NEAR((plant->kinematics(plant::Body::cup).p_WF_m - lip_W_m).norm(), 0.0, 1e-6);
}

TEST_F(GazeboPlantTest, ItsWeightOnTheRotorsHoldsItStill) {
    open();
    run(0.5, [this] { carry(); });
    const Kinematics base = plant->kinematics(plant::Body::base);
    EXPECT_LT(base.v_WF_W_m_s.norm(), 2e-3);
    // the cup's own weight bends its soft hinges, and the centre of mass with it
    EXPECT_LT(base.w_WF_F_rad_s.norm(), 5e-3);
    EXPECT_LT((base.p_WF_m - scenario.start.p_WB_m).norm(), 2e-3);
}

TEST_F(GazeboPlantTest, AForceAcceleratesTheWholeMass) {
    open();
    run(0.2, [this] {
        carry();
        push(plant::Body::base, scenario.airframe.mass_kg * Vector3(1.0, 2.0, -0.5));
    });
    const Vector3 v_W_m_s = plant->kinematics(plant::Body::base).v_WF_W_m_s;
    EXPECT_NEAR(v_W_m_s.x(), 0.2, 0.004);
    EXPECT_NEAR(v_W_m_s.y(), 0.4, 0.008);
    EXPECT_NEAR(v_W_m_s.z(), -0.1, 0.004);
}

TEST_F(GazeboPlantTest, AMomentTurnsTheWholeInertia) {
    open();
    const Vector3 inertia = scenario.airframe.inertia_kg_m2;
    run(0.1, [&] {
        carry();
        const Quaternion q_WB = plant->kinematics(plant::Body::base).q_WF;
        push(plant::Body::base, Vector3::Zero(), q_WB * Vector3(0.0, 0.0, inertia.z()));
    });
    // the cup hangs in soft hinges and comes along a little later
    EXPECT_NEAR(plant->kinematics(plant::Body::base).w_WF_F_rad_s.z(), 0.1, 0.002);
}

TEST_F(GazeboPlantTest, APushOnTheLipCompressesTheSliderAsTheSpringSays) {
    open();
    constexpr double kPush_N = 10.0;
    const vehicle::Airframe& airframe = scenario.airframe;
    run(0.3, [&] {
        carry();
        const Quaternion q_WC = plant->kinematics(plant::Body::cup).q_WF;
        push(plant::Body::cup, q_WC * Vector3(-kPush_N, 0.0, 0.0));
    });
    const double moving_kg = airframe.slider.mass_kg + airframe.cup.mass_kg;
    const double through_spring_N = kPush_N * (1.0 - moving_kg / airframe.mass_kg);
    const double expected_m =
        -(through_spring_N - airframe.slider.preload_N) / airframe.slider.stiffness_N_m;
    EXPECT_NEAR(plant->slider().position_m, expected_m, 0.02 * std::abs(expected_m));
}

TEST_F(GazeboPlantTest, SpeedsOfTheLipAreThoseOfARigidBody) {
    open();
    const Vector3 v_W_m_s(0.3, -0.2, 0.1);
    const Vector3 w_B_rad_s(0.5, -0.7, 0.9);
    const Quaternion q_WB =
        quaternion_from_euler({.roll_rad = 0.1, .pitch_rad = 0.2, .yaw_rad = 0.3});
    plant->set_pose({0.1, 0.2, -0.3}, q_WB, v_W_m_s, w_B_rad_s);
    const Kinematics base = plant->kinematics(plant::Body::base);
    const Kinematics cup = plant->kinematics(plant::Body::cup);
    EXPECT_NEAR((base.p_WF_m - Vector3(0.1, 0.2, -0.3)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(base.q_WF.angularDistance(q_WB), 0.0, 1e-9);
    EXPECT_NEAR((base.v_WF_W_m_s - v_W_m_s).norm(), 0.0, 1e-9);
    EXPECT_NEAR((base.w_WF_F_rad_s - w_B_rad_s).norm(), 0.0, 1e-9);
    const Vector3 expected = v_W_m_s + (q_WB * w_B_rad_s).cross(cup.p_WF_m - base.p_WF_m);
    EXPECT_NEAR((cup.v_WF_W_m_s - expected).norm(), 0.0, 1e-9);
    EXPECT_NEAR(plant->slider().velocity_m_s, 0.0, 1e-9);
}

TEST_F(GazeboPlantTest, ARestoredStateGoesOnAsTheFirstTime) {
    open();
    run(0.05, [this] { carry(); });
    const plant::PlantState saved = plant->save();
    const auto go_on = [this] {
        run(0.05, [this] { push(plant::Body::base, {1.0, 0.0, -30.0}, {0.1, 0.1, 0.1}); });
        return plant->kinematics(plant::Body::base);
    };
    const Kinematics first = go_on();
    plant->restore(saved);
    const Kinematics again = go_on();
    EXPECT_NEAR((first.p_WF_m - again.p_WF_m).norm(), 0.0, 1e-7);
    EXPECT_NEAR((first.v_WF_W_m_s - again.v_WF_W_m_s).norm(), 0.0, 1e-5);
}

TEST_F(GazeboPlantTest, RaysFindTheWallBeyondTheVehicleItself) {
    open();
    const double before_m = scenario.simulation.start_distance_m;
    const auto ahead = plant->ray(Vector3::Zero(), Vector3::UnitX());
    ASSERT_TRUE(ahead);
    EXPECT_NEAR(*ahead, before_m, 1e-6);
    // from above one of its legs, through it, to the floor
    const Vector3 leg_W_m = plant->kinematics(plant::Body::base).p_WF_m +
                            attitude(scenario.start) * Vector3(scenario.airframe.legs.tip_x_m,
                                                               scenario.airframe.legs.tip_y_m, 0.0);
    const auto down = plant->ray(leg_W_m, Vector3::UnitZ());
    ASSERT_TRUE(down);
    EXPECT_NEAR(*down, scenario.start.ground_z_W_m - leg_W_m.z(), 1e-6);
    EXPECT_FALSE(plant->ray(Vector3::Zero(), -Vector3::UnitX()));
}

TEST_F(GazeboPlantTest, TheWorldsClockFollowsChangingSteps) {
    open();
    const auto carried = [this] { carry(); };
    run(0.1, carried, 1e-3);
    run(0.05, carried, 2.5e-4);
    run(0.05, carried, 1e-3);
    EXPECT_NEAR(world->SimTime().Double(), 0.2, 1e-9);
}

/// Refused input, with a part of the error.
class WorldsThatDiffer : public GazeboPlantTest {
protected:
    void expect_refused(const std::string& sdf, const std::string& why) {
        try {
            open(sdf);
            FAIL() << "not refused";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(why));
        }
    }
    void expect_refused(const std::string& from, const std::string& to, const std::string& why) {
        std::string sdf = bare_world(scenario);
        const std::size_t at = sdf.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        expect_refused(sdf.replace(at, from.size(), to), why);
    }
};

TEST_F(WorldsThatDiffer, InGravityAreRefused) {
    expect_refused("0 0 -9.80665", "0 0 -9.8", "gravity is 9.8 m/s^2 downwards in the world");
}

TEST_F(WorldsThatDiffer, InTheSlidersNameAreRefused) {
    expect_refused("joint name=\"slider\"", "joint name=\"rail\"", "has no joint \"slider\"");
}

TEST_F(WorldsThatDiffer, InTheEngineAreRefused) {
    expect_refused("type=\"ode\"", "type=\"bullet\"", "only \"ode\"");
}

TEST_F(WorldsThatDiffer, InTheWallsPlaceAreRefused) {
    const std::string sdf = bare_world(scenario);
    scenario.wall.geometry.p_WT_m.x() += 0.01;
    expect_refused(sdf, "the wall of the world is not where the scenario's is");
}

TEST_F(WorldsThatDiffer, InMassAreRefused) {
    expect_refused("<mass>0.1</mass>", "<mass>0.2</mass>", "the vehicle's mass is 3.3 kg");
}

}  // namespace
}  // namespace limpet::gazebo11
