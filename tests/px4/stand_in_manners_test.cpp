// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_manners.hpp"

#include <gtest/gtest.h>

#include "limpet/core/frames.hpp"

namespace limpet::px4 {
namespace {

class StandInManners : public testing::Test {
protected:
    /// Goes on by 4 ms until `done` or `limit_s` later.
    template <class Done>
    double time_until(Done done, double limit_s) {
        const double begin_s = now.time_s;
        while (!done() && now.time_s - begin_s < limit_s) {
            now.time_s += 0.004;
            if (streams) {
                now.set_point_s = now.time_s;
            }
            mind(parameters, manners, now);
        }
        return now.time_s - begin_s;
    }
    void pass(double duration_s) {
        (void)time_until([] { return false; }, duration_s);
    }

    StandInParameters parameters;
    Manners manners;
    Situation now{.time_s = 10.0, .set_point_s = 10.0, .estimate_valid = true};
    bool streams = true;
};

TEST_F(StandInManners, ArmsInOffboardWithAStreamAndAValidEstimate) {
    EXPECT_EQ(set_mode(parameters, manners, now, FlightMode::offboard), CommandResult::accepted);
    EXPECT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    EXPECT_EQ(manners.state, ArmingState::waiting);
}

TEST_F(StandInManners, DoesNotArmWithoutAnEstimateUnlessForced) {
    now.estimate_valid = false;
    EXPECT_EQ(arm(parameters, manners, now, false), CommandResult::temporarily_rejected);
    EXPECT_FALSE(manners.armed());
    EXPECT_EQ(arm(parameters, manners, now, true), CommandResult::accepted);
}

TEST_F(StandInManners, DoesNotArmTiltedEvenByForce) {
    for (double Situation::*angle : {&Situation::pitch_rad, &Situation::roll_rad}) {
        now.*angle = radians(61.0);
        EXPECT_EQ(arm(parameters, manners, now, false), CommandResult::temporarily_rejected);
        EXPECT_EQ(arm(parameters, manners, now, true), CommandResult::temporarily_rejected);
        now.*angle = radians(-59.0);
        EXPECT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
        EXPECT_EQ(disarm(manners, now, false), CommandResult::accepted);
        now.*angle = 0.0;
    }
    parameters.FD_FAIL_P = 0;
    now.pitch_rad = radians(85.0);
    EXPECT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
}

TEST_F(StandInManners, OffboardIsRefusedWithoutAStreamAndLostWhenItIsTooSlow) {
    now.set_point_s = now.time_s - 1.1;
    EXPECT_EQ(set_mode(parameters, manners, now, FlightMode::offboard),
              CommandResult::temporarily_rejected);
    EXPECT_EQ(manners.mode, FlightMode::hold);
    now.set_point_s = now.time_s;
    EXPECT_EQ(set_mode(parameters, manners, now, FlightMode::offboard), CommandResult::accepted);
    streams = false;
    const auto held = [&] { return manners.mode == FlightMode::hold; };
    EXPECT_NEAR(time_until(held, 5.0), 1.0, 0.005);
    // 1.05 Hz held, 0.8 Hz did not: px4.md "Offboard"
    for (const auto& [rate_Hz, lost] : {std::pair(1.05, false), std::pair(0.8, true)}) {
        now.set_point_s = now.time_s;
        ASSERT_EQ(set_mode(parameters, manners, now, FlightMode::offboard),
                  CommandResult::accepted);
        (void)time_until(held, 1.0 / rate_Hz);
        EXPECT_EQ(held(), lost) << rate_Hz;
    }
}

TEST_F(StandInManners, WithoutThrustItLandsAndDisarms) {
    ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    now.thrust = 0.3;
    pass(1.0);
    EXPECT_TRUE(manners.in_air());
    now.thrust = 0.0;
    EXPECT_NEAR(time_until([&] { return manners.state == ArmingState::landed; }, 9.0), 1.05, 0.01);
    EXPECT_NEAR(1.05 + time_until([&] { return !manners.armed(); }, 9.0), 3.5, 0.01);
}

TEST_F(StandInManners, AMomentWithoutThrustIsNoLandingAndThrustLiftsALandedOne) {
    ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    now.thrust = 0.3;
    pass(1.0);
    now.thrust = 0.0;
    pass(1.0);
    EXPECT_TRUE(manners.in_air());
    now.thrust = 0.3;
    pass(0.01);
    now.thrust = 0.0;
    pass(2.0);
    EXPECT_EQ(manners.state, ArmingState::landed);
    now.thrust = 0.3;
    pass(0.01);
    EXPECT_TRUE(manners.in_air());
}

TEST_F(StandInManners, ArmedAndNeverFlownItDisarmsAfterTenSeconds) {
    ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    EXPECT_NEAR(time_until([&] { return !manners.armed(); }, 20.0), 10.0, 0.01);
    parameters.COM_DISARM_PRFLT = -1.0;
    ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    pass(20.0);
    EXPECT_TRUE(manners.armed());
}

TEST_F(StandInManners, InFlightOnlyForceDisarms) {
    ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
    now.thrust = 0.3;
    pass(0.1);
    EXPECT_EQ(disarm(manners, now, false), CommandResult::temporarily_rejected);
    EXPECT_TRUE(manners.armed());
    EXPECT_EQ(disarm(manners, now, true), CommandResult::accepted);
    EXPECT_FALSE(manners.armed());
}

TEST_F(StandInManners, TextsFitAStatusTextAndDoNotPileUp) {
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(arm(parameters, manners, now, false), CommandResult::accepted);
        ASSERT_EQ(disarm(manners, now, false), CommandResult::accepted);
    }
    EXPECT_EQ(manners.texts.count, SpokenTexts::kMost);
    for (std::size_t i = 0; i < manners.texts.count; ++i) {
        EXPECT_LE(manners.texts.texts[i].text.size(), 50U);
    }
}

}  // namespace
}  // namespace limpet::px4
