// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "adapters/gazebo/suction_cup_plugin.hpp"
#include "press_bench.hpp"

namespace limpet::gazebo11 {
namespace {

using ignition::math::Vector3d;

/// By hand, of plain_surface() and a lip of 40 mm.
constexpr double kVacuum_N = (101325.0 - 60000.0) * 3.14159265358979 * 0.04 * 0.04;

class ACompliantCup : public ::testing::Test {
protected:
    PressBench bench{cup_settings("compliant")};
};

class OfEachAttachment : public ::testing::TestWithParam<std::string> {
protected:
    PressBench bench{cup_settings(GetParam())};
};

TEST_F(ACompliantCup, PressureFollowsTheClosedFormWhileItSealsAndUnseals) {
    bench.push_N.X(40.0);
    ASSERT_GE(bench.run_until(CupPhase::sealing, 2000), 0);
    // The step that seals is the first of the pressure's fall.
    int steps = 1;
    for (const int until : {50, 100, 200, 400, 1000, 2000}) {
        bench.run(static_cast<unsigned int>(until - steps));
        steps = until;
        const double expected_Pa = 60000.0 + 41325.0 * std::exp(-1e-3 * steps / 0.2);
        EXPECT_NEAR(bench.pressure_Pa(), expected_Pa, 1.0) << steps << " ms";
    }
    EXPECT_EQ(bench.phase(), CupPhase::attached);
    bench.cup.command({.pump_on = false, .valve_open = false});
    const double from_Pa = bench.pressure_Pa();
    for (const int until : {2, 100, 500, 1500}) {
        bench.run(static_cast<unsigned int>(until - (steps > until ? 0 : steps)));
        steps = until;
        // Eq. (6) begins with the first step after the pump was switched off.
        const double expected_Pa = 101325.0 - (101325.0 - from_Pa) * std::exp(-1e-3 * steps / 0.5);
        EXPECT_NEAR(bench.pressure_Pa(), expected_Pa, 1.0) << steps << " ms";
    }
}

TEST_F(ACompliantCup, APressBelowTheThresholdNeverSeals) {
    bench.push_N.X(3.0);
    ASSERT_GE(bench.run_until(CupPhase::touching, 4000), 0);
    bench.run(3000);
    EXPECT_EQ(bench.phase(), CupPhase::touching);
    bench.push_N.X(30.0);
    EXPECT_GE(bench.run_until(CupPhase::attached, 1000), 0);
}

TEST_P(OfEachAttachment, HundredCyclesLeaveNothingBehind) {
    const unsigned int joints = bench.body->GetJointCount();
    std::vector<double> resident;  ///< [B], every ten cycles
    for (int cycle = 0; cycle < 100; ++cycle) {
        if (cycle % 10 == 0) {
            resident.push_back(resident_B());
        }
        bench.cup.command({.pump_on = true, .valve_open = false});
        ASSERT_TRUE(bench.attaches()) << "cycle " << cycle;
        bench.run(5);
        EXPECT_EQ(bench.body->GetJointCount(), joints + (GetParam() == "compliant" ? 0U : 1U));
        bench.cup.command({.pump_on = false, .valve_open = false});
        bench.push_N.X(-20.0);
        ASSERT_GE(bench.run_until(CupPhase::free, 5000), 0) << "cycle " << cycle;
        EXPECT_EQ(bench.body->GetJointCount(), joints);
        // It really leaves: nothing holds it any more.
        const double x_m = bench.body->WorldPose().Pos().X();
        bench.run(30);
        EXPECT_LT(bench.body->WorldPose().Pos().X(), x_m - 0.002);
        bench.push_N.X(0.0);
        bench.body->SetLinearVel({0.0, 0.0, 0.0});
    }
    // The allocator may take a block or two for good; a leak grows in every ten.
    int growing = 0;
    for (std::size_t i = 1; i < resident.size(); ++i) {
        growing += resident[i] > resident[i - 1] + 64e3 ? 1 : 0;
    }
    EXPECT_LE(growing, 3) << "times ten cycles, of nine";
}

TEST_P(OfEachAttachment, IsPulledOffAtTheVacuumsForce) {
    ASSERT_TRUE(bench.attaches());
    bench.push_N.X(0.0);  // else a body on a hinge buckles
    bench.run(3000);      // 15 time constants: P_vac
    // 1 N in 20 ms: slow against what the lip and the filter do.
    double pull_N = 0.0;
    const int steps = bench.run_until(
        [&] {
            pull_N += 0.05;
            bench.push_N.X(-pull_N);
            return bench.phase() == CupPhase::free || bench.phase() == CupPhase::touching;
        },
        10000);
    ASSERT_GT(steps, 0);
    EXPECT_NEAR(pull_N, kVacuum_N, 0.015 * kVacuum_N);
}

TEST_P(OfEachAttachment, HangsOnTheWallWithItsWeight) {
    if (GetParam() == "universal") {
        GTEST_SKIP() << "it swings: the next test";
    }
    bench.server.world()->SetGravity({0.0, 0.0, -9.81});
    bench.push_N.Z(9.81);
    ASSERT_TRUE(bench.attaches());
    bench.run(1000);
    const double z_m = bench.body->WorldPose().Pos().Z();
    bench.push_N = Vector3d::Zero;
    bench.run(3000);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
    const CupStatus& status = bench.cup.status();
    EXPECT_NEAR(status.shear_N, 9.81, 0.02 * 9.81);
    EXPECT_NEAR(status.pull_N, 0.0, 0.2);
    const double arm_m = kLip_m + kBehind_m;
    EXPECT_NEAR(status.peel_N_m, 9.81 * arm_m, 0.03 * 9.81 * arm_m) << "about the lip";
    // The law's springs give: shear 20 kN/m, tilt 20 N m/rad. A joint does not.
    const double gives_m =
        GetParam() == "compliant" ? 9.81 / 2e4 + 9.81 * arm_m / 20.0 * kLip_m : 0.0;
    EXPECT_NEAR(z_m - bench.body->WorldPose().Pos().Z(), gives_m, 2e-4);
    // By the wall on the cup, in the cup's axes: up is -z.
    EXPECT_LT(status.wrench_C.force_N.z(), -9.0);
}

TEST(SuctionCup, AUniversalJointLeavesPitchFree) {
    PressBench bench(cup_settings("universal"), "0 0 -9.81");
    bench.push_N.Z(9.81);
    ASSERT_TRUE(bench.attaches());
    bench.run(1000);
    bench.push_N = Vector3d::Zero;
    bench.run(50);
    // A pendulum that is let go level: half the angular acceleration m g d / (I + m d^2) times t^2.
    const double arm_m = kLip_m + kBehind_m;
    const double turn_rad_s2 = 9.81 * arm_m / (kInertia_kg_m2 + arm_m * arm_m);
    EXPECT_NEAR(std::abs(bench.body->WorldPose().Rot().Pitch()), 0.5 * turn_rad_s2 * 0.05 * 0.05,
                0.06 * 0.5 * turn_rad_s2 * 0.05 * 0.05);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
}

TEST_P(OfEachAttachment, AWorldResetLetsGoAndTheNextTouchHoldsAgain) {
    ASSERT_TRUE(bench.attaches());
    bench.run(100);
    bench.server.world()->Reset();
    bench.cup.Reset();  // the model does so for plugins that it has loaded itself
    EXPECT_EQ(bench.phase(), CupPhase::free);
    EXPECT_EQ(bench.body->GetJointCount(), 0U);
    bench.run(1);
    EXPECT_NEAR(bench.body->WorldPose().Pos().X(), kBodyX_m, 1e-3);
    EXPECT_NEAR(bench.pressure_Pa(), 101325.0, 1e-6);
    ASSERT_TRUE(bench.attaches());
}

TEST_P(OfEachAttachment, ADeletedTargetLetsGo) {
    ASSERT_TRUE(bench.attaches());
    bench.push_N = Vector3d::Zero;
    bench.run(10);
    bench.server.world()->RemoveModel("wall");
    bench.run(200);
    EXPECT_EQ(bench.phase(), CupPhase::free);
    EXPECT_EQ(bench.body->GetJointCount(), 0U);
    bench.push_N.X(10.0);
    bench.run(2000);
    EXPECT_GT(bench.body->WorldPose().Pos().X(), kWall_m) << "nothing there any more";
}

INSTANTIATE_TEST_SUITE_P(All, OfEachAttachment,
                         ::testing::Values("compliant", "fixed", "universal"),
                         [](const auto& info) { return info.param; });

TEST_F(ACompliantCup, APauseStopsTheAirAndALaterStepGoesOn) {
    bench.push_N.X(40.0);
    ASSERT_GE(bench.run_until(CupPhase::sealing), 0);
    bench.server.world()->SetPaused(true);
    const double before_Pa = bench.pressure_Pa();
    std::thread stepping([&] { bench.run(50); });
    while (bench.server.world()->PauseTime() < gazebo::common::Time(0.05)) {
        std::this_thread::yield();
    }
    EXPECT_EQ(bench.pressure_Pa(), before_Pa);
    bench.server.world()->SetPaused(false);
    stepping.join();
    EXPECT_NEAR(bench.pressure_Pa(), 60000.0 + (before_Pa - 60000.0) * std::exp(-0.05 / 0.2), 1.0);
}

TEST(SuctionCup, TwoOnOneLinkHoldEachWithItsOwnName) {
    PressBench bench(cup_settings("fixed"));
    SuctionCupPlugin other;
    const std::string inside = "<link>hull</link><lip_pose>0.06 0 0 0 0 0</lip_pose>";
    other.Load(bench.body, plugin_element(inside + cup_settings("fixed"), "second"));
    ASSERT_TRUE(bench.attaches(80.0));
    ASSERT_GE(bench.run_until([&] { return other.status().phase == CupPhase::attached; }, 3000), 0);
    EXPECT_EQ(bench.body->GetJointCount(), 2U);
    // A command is for one of them.
    EXPECT_EQ(gazebo::transport::request("bench", "body/second/pump", "off")->response(),
              "success");
    bench.run(1);
    EXPECT_EQ(other.status().phase, CupPhase::unsealing);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
}

TEST(SuctionCup, AnOverloadedJointIsPumpedOutBeforeItHoldsAgain) {
    PressBench bench(cup_settings("fixed"));
    ASSERT_TRUE(bench.attaches());
    bench.run(3000);
    int attached = 0;
    bool before = true;
    // Pressed on, and dragged along the wall by more than friction bears.
    bench.push_N = {40.0, 0.0, 400.0};
    bench.body->SetAngularVel({0.0, 0.0, 0.0});
    for (int step = 0; step < 180; ++step) {
        bench.run(1);
        const bool now = bench.phase() == CupPhase::attached;
        attached += now && !before ? 1 : 0;
        before = now;
    }
    EXPECT_LE(attached, 2);
}

TEST(SuctionCup, ASpawnedModelsTypoEndsNoServer) {
    PressBench bench(cup_settings("compliant"));
    bench.run(10);
    SuctionCupPlugin spawned;
    spawned.Load(bench.body, plugin_element("<link>hul</link>", "spawned"));
    SuctionCupPlugin again;  // a name that is another's
    again.Load(bench.body, plugin_element("<link>hull</link>"));
    bench.run(10);
    EXPECT_TRUE(bench.attaches()) << "the world runs on, and its own cup with it";
}

TEST_F(ACompliantCup, TopicsSwitchThePumpAndTellPressureAndState) {
    gazebo::transport::NodePtr node(new gazebo::transport::Node());
    node->Init("bench");
    const auto pump = node->Advertise<gazebo::msgs::Int>("~/body/suction_cup/pump");
    ASSERT_TRUE(bench.attaches());
    gazebo::msgs::Int off;
    off.set_data(0);
    // The transport has separate threads: the request is repeated until it has arrived.
    int tries = 0;
    for (; tries < 2000 && bench.phase() != CupPhase::unsealing; ++tries) {
        pump->Publish(off);
        bench.run(1);
    }
    EXPECT_EQ(bench.phase(), CupPhase::unsealing) << tries;
    const boost::shared_ptr<gazebo::msgs::Response> answer =
        gazebo::transport::request("bench", "body/suction_cup/state");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->response(), "success");
    gazebo::msgs::GzString state;
    ASSERT_TRUE(state.ParseFromString(answer->serialized_data()));
    EXPECT_EQ(state.data(), "unsealing");
    EXPECT_EQ(gazebo::transport::request("bench", "body/suction_cup/valve", "on")->response(),
              "error")
        << "none is fitted";
    EXPECT_EQ(gazebo::transport::request("bench", "body/suction_cup/pump", "on")->response(),
              "success");
    bench.run(1);
    EXPECT_TRUE(bench.phase() == CupPhase::sealing || bench.phase() == CupPhase::attached);
}

}  // namespace
}  // namespace limpet::gazebo11
