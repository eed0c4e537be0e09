// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asked_session.hpp"
#include "limpet/companion/wires.hpp"

namespace limpet::companion {
namespace {

using testing::HasSubstr;

TEST_F(Session, WaitsForItsInputsAndNamesThem) {
    alive_ = false;
    run(1.0);
    EXPECT_EQ(session_.phase(), SessionPhase::waiting);
    EXPECT_FALSE(session_.streams());
    EXPECT_THAT(session_.obstacle(), HasSubstr("no heartbeat of the autopilot"));
    const Answer answer = session_.perch(time_s_);
    EXPECT_FALSE(answer.done);
    EXPECT_THAT(answer.message, HasSubstr("no left LiDAR"));
    alive_ = true;
    run(0.1);
    EXPECT_EQ(session_.phase(), SessionPhase::ready);
    EXPECT_TRUE(session_.streams());
    EXPECT_EQ(session_.wanted_mode(), "");  // nobody has asked for anything yet
}

TEST_F(Session, PerchesWhenAskedRestsUntilAskedTakesOff) {
    perch_until_rest();
    EXPECT_EQ(session_.place(), Place::at_rest);
    EXPECT_FALSE(word_.armed);
    run(30.0);  // rest_s is 1: it stays all the same
    EXPECT_EQ(session_.phase(), SessionPhase::flying);
    EXPECT_EQ(session_.outcome(), Outcome::perched);
    EXPECT_TRUE(session_.setpoint().pump_on);
    EXPECT_FALSE(session_.perch(time_s_).done);
    EXPECT_TRUE(session_.take_off(time_s_).done);
    run(0.1);
    EXPECT_EQ(session_.memory().state, guidance::PerchingState::spinning_up);
    EXPECT_TRUE(word_.armed);
    EXPECT_FALSE(session_.take_off(time_s_).done);
    run_until(guidance::PerchingState::pitching_down, 3.0);
    pitch_rad_ = 0.0;
    run_until(guidance::PerchingState::releasing, 10.0);
    pressure_Pa_ = kAtmosphere_Pa;
    run_until(guidance::PerchingState::backing_off, 2.0);
    run(2.0);
    EXPECT_EQ(session_.outcome(), Outcome::released);
    EXPECT_EQ(session_.phase(), SessionPhase::ready);
    EXPECT_FALSE(session_.setpoint().pump_on);
    EXPECT_TRUE(session_.perch(time_s_).done);  // once more
}

TEST_F(Session, AtRestItGoesOnWatchingTheVacuum) {
    perch_until_rest();
    run(5.0);
    pressure_Pa_ = 95000.0;
    run(0.2);
    EXPECT_EQ(session_.memory().state, guidance::PerchingState::spinning_up);
}

TEST_F(Session, AbortedInTheAirItHandsBackAndThePumpGoesOff) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    EXPECT_TRUE(session_.setpoint().pump_on);
    EXPECT_TRUE(session_.abort().done);
    run(0.04);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_FALSE(session_.streams());
    EXPECT_FALSE(word_.offboard);
    EXPECT_FALSE(session_.setpoint().pump_on);
    EXPECT_FALSE(session_.abort().done);
    EXPECT_TRUE(session_.perch(time_s_).done);
    run(0.1);
    EXPECT_EQ(session_.phase(), SessionPhase::flying);
}

TEST_F(Session, AbortedOnTheCupItComesToRestAndSetPointsGoOn) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    force_N_ = -50.0;
    run_until(guidance::PerchingState::holding, 1.0);
    pressure_Pa_ = 70000.0;
    run_until(guidance::PerchingState::pitching_up, 2.0);
    EXPECT_TRUE(session_.abort().done);
    for (int k = 0; k < 500; ++k) {
        run(0.02);
        pitch_rad_ = radians(66.0);
        ASSERT_TRUE(session_.streams());
        ASSERT_TRUE(session_.setpoint().pump_on);
    }
    EXPECT_EQ(session_.place(), Place::at_rest);
    EXPECT_TRUE(session_.take_off(time_s_).done);  // an abort is done with once it rests
    run(0.1);
    EXPECT_EQ(session_.memory().state, guidance::PerchingState::spinning_up);
}

TEST_F(Session, WithoutAPoseItHoldsInTheAir) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    alive_ = false;
    run(0.2);
    EXPECT_EQ(session_.phase(), SessionPhase::flying);
    run(0.2);  // estimate_limit_s 0.25
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_THAT(session_.reason(), HasSubstr("pose stale"));
}

TEST_F(Session, WithoutAPoseOnTheCupSetPointsGoOn) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    force_N_ = -50.0;
    run_until(guidance::PerchingState::holding, 1.0);
    pressure_Pa_ = 70000.0;
    run_until(guidance::PerchingState::pitching_up, 2.0);
    alive_ = false;
    run(0.45);
    EXPECT_EQ(session_.phase(), SessionPhase::flying);
    EXPECT_TRUE(session_.streams());
    EXPECT_THAT(session_.obstacle(), HasSubstr("pose stale"));
}

TEST_F(Session, AnOperatorsModeIsNotTakenBack) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    word_.offboard = false;
    run(1.0);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_EQ(session_.wanted_mode(), "");
    EXPECT_FALSE(word_.offboard);
}

TEST_F(Session, DisarmedBySomebodyElseItIsNotArmedAgain) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run(0.1);
    word_.armed = false;
    feed();
    session_.tick(time_s_);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_FALSE(session_.wanted_armed().has_value());
}

TEST_F(Session, ACupThatMayHoldAVehicleIsLeftAsItIs) {
    pressure_Pa_ = 65000.0;
    run(1.0);
    EXPECT_EQ(session_.phase(), SessionPhase::waiting);
    EXPECT_FALSE(session_.drives_mechanism());
    EXPECT_THAT(session_.perch(time_s_).message, HasSubstr("the cup is not free"));
}

TEST_F(Session, TimeThatRunsBackBeginsAnew) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run_until(guidance::PerchingState::approaching, 5.0);
    time_s_ = 0.5;
    feed();
    session_.tick(time_s_);
    EXPECT_NE(session_.phase(), SessionPhase::flying);
}

TEST_F(Session, AnAutopilotThatBeganAnewIsNotDisarmed) {
    perch_until_rest();
    ASSERT_FALSE(word_.armed);
    run(2.0);
    // Its first word may come before /clock tells that time ran back.
    session_.inputs().autopilot = {0.0, {.connected = true, .armed = true, .offboard = false}};
    session_.tick(time_s_);
    EXPECT_EQ(session_.wanted_armed(), std::nullopt);
    word_ = {.connected = true, .armed = true, .offboard = false};
    time_s_ = 0.0;
    feed();
    session_.tick(time_s_);
    EXPECT_EQ(session_.wanted_armed(), std::nullopt);
    EXPECT_NE(session_.phase(), SessionPhase::flying);
    EXPECT_FALSE(session_.outcome().has_value());
}

TEST_F(Session, ATickThatComesTooLateHandsBack) {
    run(0.5);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run(0.5);
    time_s_ += 0.4;  // late_limit_s is 0.3
    run(0.02);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_THAT(session_.reason(), HasSubstr("too late"));
}

// --- ready, flown by its set-points, not begun yet ----------------------------------------------

class StandsReady : public Session {
protected:
    StandsReady() {
        run(0.5);
        word_.offboard = true;
        run(0.5);
        EXPECT_EQ(session_.phase(), SessionPhase::ready);
    }
};

TEST_F(StandsReady, AnOperatorsModeIsNotTakenBack) {
    word_.offboard = false;
    run(0.5);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_THAT(session_.reason(), HasSubstr("another mode was chosen"));
    EXPECT_FALSE(word_.offboard);
}

TEST_F(StandsReady, DoesNotBeginWithoutAnInput) {
    force_works_ = false;
    run(2.0);
    EXPECT_EQ(session_.phase(), SessionPhase::ready) << "set-points must not stop";
    EXPECT_THAT(session_.perch(time_s_).message, HasSubstr("not ready: no force"));
    force_works_ = true;
    run(0.1);
    EXPECT_EQ(session_.phase(), SessionPhase::ready);
    ASSERT_TRUE(session_.perch(time_s_).done);
    run(0.1);
    EXPECT_EQ(session_.phase(), SessionPhase::flying);
}

TEST_F(StandsReady, ALateTickHandsBack) {
    time_s_ += 0.4;  // late_limit_s is 0.3
    run(0.02);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_THAT(session_.reason(), HasSubstr("too late"));
}

TEST_F(StandsReady, WithoutAPoseItHolds) {
    alive_ = false;
    run(0.4);
    EXPECT_EQ(session_.phase(), SessionPhase::handed_back);
    EXPECT_EQ(session_.left_by(), Action::hold);
    EXPECT_THAT(session_.reason(), HasSubstr("pose stale"));
}

TEST(MechanismPace, SaysItAtOnceAndAgain) {
    MechanismPace pace;
    const mavlink::MechanismCommand off{};
    const mavlink::MechanismCommand on{.pump_on = true};
    EXPECT_TRUE(pace.due(off, 10.0, 5.0));
    EXPECT_FALSE(pace.due(off, 10.0, 5.05));
    EXPECT_TRUE(pace.due(off, 10.0, 5.1));
    EXPECT_EQ(pace.repeats(), 1);
    EXPECT_TRUE(pace.due(on, 10.0, 5.12));
    EXPECT_EQ(pace.repeats(), 0);
    EXPECT_EQ(pace.asked_s(), 5.12);
    EXPECT_TRUE(pace.due(on, 10.0, 0.0)) << "a simulation that began anew";
}

}  // namespace
}  // namespace limpet::companion
