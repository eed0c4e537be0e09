// SPDX-License-Identifier: Apache-2.0
// What a cup holds, and what it does not.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "press_bench.hpp"

namespace limpet::gazebo11 {
namespace {

TEST(SuctionCup, HoldsOnlyItsTargets) {
    PressBench bench(cup_settings("compliant", "<target model='other'/>"), "0 0 0",
                     box_model("other", "5 0 0 0 0 0", "0.1 2 2"));
    bench.push_N.X(40.0);
    bench.run(1500);
    EXPECT_EQ(bench.phase(), CupPhase::free);
}

TEST(SuctionCup, ATargetHasItsOwnSurface) {
    PressBench bench(
        cup_settings("compliant", "<target model='wall' collision='face' surface='metal'/>"));
    ASSERT_TRUE(bench.attaches(100.0));
    bench.run(4000);
    // Table II: 265 hPa on metal; its pump rests within 2 kPa of it.
    EXPECT_NEAR(bench.pressure_Pa(), 26500.0, 2500.0);
}

TEST(SuctionCup, APlaneOfTheWorldHoldsWithoutAModel) {
    PressBench bench(cup_settings("fixed", "<target plane='0.98 0 0 0 0 0'/>"));
    ASSERT_TRUE(bench.attaches());
    EXPECT_NEAR(bench.body->WorldPose().Pos().X() + kLip_m, 0.98, 4e-3);
    bench.run(2000);
    bench.push_N.X(-100.0);
    bench.run(2000);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
}

TEST(SuctionCup, OverAnEdgeThereIsNoWall) {
    PressBench bench(cup_settings("compliant", "<target model='shelf'/>"), "0 0 0",
                     box_model("shelf", "1.03 0.5 1.02 0 0 0", "0.1 1 2"));
    bench.body->SetWorldPose({kBodyX_m, 0.5, 0.0, 0.0, 0.0, 0.0});  // the edge goes through the cup
    bench.push_N.X(20.0);
    bench.run(300);
    EXPECT_EQ(bench.phase(), CupPhase::free);
    bench.server.world()->Reset();
    bench.cup.Reset();
    bench.push_N.X(40.0);
    bench.body->SetWorldPose({kBodyX_m - 0.02, 0.5, 0.1, 0.0, 0.0, 0.0});
    EXPECT_GE(bench.run_until(CupPhase::attached, 2000), 0);
}

TEST(SuctionCup, WhatIsPutElsewhereIsLetGo) {
    PressBench bench(cup_settings("fixed"));
    ASSERT_TRUE(bench.attaches());
    bench.push_N.X(0.0);
    bench.run(100);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
    bench.server.world()->ModelByName("wall")->SetWorldPose({1.15, 0.0, 0.0, 0.0, 0.0, 0.0});
    bench.run(5);
    EXPECT_EQ(bench.phase(), CupPhase::free);
    EXPECT_EQ(bench.body->GetJointCount(), 0U);
}

/// A crate of 1 kg that lies loose before a wall.
std::string crate(const std::string& pose) {
    return "<model name='crate'><pose>" + pose +
           "</pose><link "
           "name='link'><inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy>"
           "<izz>0.01</izz></inertia></inertial><collision name='face'><geometry><box>"
           "<size>0.1 0.4 0.4</size></box></geometry></collision></link></model>";
}

class OfALooseCrate : public ::testing::TestWithParam<std::string> {
protected:
    PressBench bench{cup_settings(GetParam(), "<target model='crate'/>"), "0 0 0",
                     crate("1.05 0 0 0 0 0")};
    [[nodiscard]] ignition::math::Vector3d crate_m() const {
        return bench.server.world()->ModelByName("crate")->WorldPose().Pos();
    }
    OfALooseCrate() {  // the crate stands where the wall stood, the wall behind it
        bench.server.world()->ModelByName("wall")->SetWorldPose({1.15, 0.0, 0.0, 0.0, 0.0, 0.0});
    }
};

TEST_P(OfALooseCrate, DragsItAlong) {
    ASSERT_TRUE(bench.attaches());
    bench.run(500);
    const double x_m = crate_m().X();
    bench.push_N.X(-10.0);
    bench.run(4000);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
    EXPECT_GT(x_m - crate_m().X(), 0.04);
    EXPECT_NEAR(crate_m().X() - bench.body->WorldPose().Pos().X(), 0.05 + kLip_m, 0.004);
}

TEST_P(OfALooseCrate, PullsAsHardAsItIsHeavy) {
    ASSERT_TRUE(bench.attaches());
    bench.run(500);
    // Both are pulled by 1 m/s^2: what passes through the cup is the crate's 1 kg.
    bench.hand_N_s_m = 0.0;
    bench.push_N.X(-2.0);
    bench.run(300);
    EXPECT_EQ(bench.phase(), CupPhase::attached);
    const double before_m_s = bench.server.world()->ModelByName("crate")->WorldLinearVel().X();
    bench.run(200);
    const double after_m_s = bench.server.world()->ModelByName("crate")->WorldLinearVel().X();
    EXPECT_NEAR((after_m_s - before_m_s) / 0.2, -1.0, 0.05);
    EXPECT_NEAR(bench.cup.status().pull_N, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, OfALooseCrate, ::testing::Values("compliant", "fixed", "universal"),
                         [](const auto& info) { return info.param; });

TEST(SuctionCup, ATargetThatComesLaterIsHeld) {
    PressBench bench(cup_settings("compliant", "<target model='crate'/>"));
    bench.server.world()->ModelByName("wall")->SetWorldPose({1.15, 0.0, 0.0, 0.0, 0.0, 0.0});
    bench.run(50);
    bench.server.world()->InsertModelString("<sdf version='1.6'>" + crate("1.05 0 0 0 0 0") +
                                            "</sdf>");
    const auto has_come = [&] {  // a message, which takes wall time
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return bench.server.world()->ModelByName("crate") != nullptr;
    };
    ASSERT_GE(bench.run_until(has_come, 20'000), 0);
    EXPECT_TRUE(bench.attaches());
}

}  // namespace
}  // namespace limpet::gazebo11
