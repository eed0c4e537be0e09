// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/companion/rehearsal.hpp"

// The table of watchdog.hpp, flown: what the wires carry after a loss in each place.

namespace limpet::companion {
namespace {

/// What was said to the autopilot since this was made.
class Since {
public:
    explicit Since(const Rehearsal& r) : r_(r), before_(r.stage.autopilot) {}
    [[nodiscard]] int set_points() const {
        return r_.stage.autopilot.set_points - before_.set_points;
    }
    [[nodiscard]] int holds() const { return r_.stage.autopilot.holds - before_.holds; }
    [[nodiscard]] int arms() const { return r_.stage.autopilot.arms - before_.arms; }
    [[nodiscard]] int offboards() const { return r_.stage.autopilot.offboards - before_.offboards; }

private:
    const Rehearsal& r_;
    HeardByAutopilot before_;
};

/// In the approach something goes wrong: set-points stop, hold is asked for, the pump goes off.
void expect_hold_in_the_approach(const std::function<void(Rehearsal&)>& wrong, double within_s,
                                 CompanionEnd end, const std::string& why) {
    Rehearsal r({"guidance.dock_speed_m_s=0.3"});  // long enough for a silent autopilot to show
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.tick();
    wrong(r);
    const double begin_s = r.stage.time_s();
    while (r.companion->phase() == SessionPhase::flying && r.stage.time_s() < begin_s + 10.0) {
        r.tick();
    }
    EXPECT_LT(r.stage.time_s() - begin_s, within_s) << why;
    ASSERT_EQ(r.companion->phase(), SessionPhase::handed_back) << why;
    r.stage.step();
    const Since since(r);
    ASSERT_TRUE(r.run_out(5.0)) << why;
    EXPECT_EQ(since.set_points(), 0) << why;
    EXPECT_EQ(since.arms(), 0) << why;
    EXPECT_EQ(r.stage.mode, Stage::kLoiter) << why;
    EXPECT_FALSE(r.stage.mechanism.pump_on) << why;
    EXPECT_EQ(r.result().end, end) << why;
    EXPECT_THAT(r.result().reason, testing::HasSubstr(why));
    EXPECT_TRUE(r.stage.sensors.over) << why;
    ASSERT_FALSE(r.result().events.empty());
    EXPECT_EQ(r.result().events.back().name, EventName::aborted) << why;
}

TEST(HandBack, InTheAirAsksForHold) {
    using enum CompanionEnd;
    expect_hold_in_the_approach([](Rehearsal& r) { r.stage.motion_capture_works = false; }, 0.35,
                                handed_back, "motion-capture pose stale");
    expect_hold_in_the_approach(  // another body
        [](Rehearsal& r) { r.stage.motion_capture_turned_rad = 1.0; }, 0.35, handed_back,
        "motion-capture pose stale");
    expect_hold_in_the_approach(
        [](Rehearsal& r) {
            r.stage.motion_capture_off_m = {5.0, 0.0, 0.0};
        },
        0.35, handed_back, "motion-capture pose stale: its pose jumped (5.00 m)");
    expect_hold_in_the_approach([](Rehearsal& r) { r.stage.tells_pose = false; }, 0.35, handed_back,
                                "autopilot's pose stale");
    expect_hold_in_the_approach([](Rehearsal& r) { r.stage.beats = false; }, 3.1, handed_back,
                                "autopilot silent");
    expect_hold_in_the_approach([](Rehearsal& r) { r.late_s = 0.31; }, 0.05, handed_back,
                                "guidance came too late");
    expect_hold_in_the_approach([](Rehearsal& r) { r.interrupted = true; }, 0.05, interrupted,
                                "interrupted");
}

TEST(HandBack, AJumpIsNotPassedOnFromItsFirstFrame) {
    for (const guidance::PerchingState state :
         {guidance::PerchingState::approaching, guidance::PerchingState::pitching_up,
          guidance::PerchingState::resting, guidance::PerchingState::releasing}) {
        Rehearsal r({"guidance.dock_speed_m_s=0.1"});
        ASSERT_TRUE(r.run_to(state)) << to_string(state);
        r.run(0.2);
        r.stage.step();
        const int before = r.stage.autopilot.poses;
        r.stage.motion_capture_off_m = {-5.0, 0.0, 0.0};
        r.run(0.2);
        r.stage.step();
        EXPECT_LE(r.stage.autopilot.poses - before, 1) << to_string(state) << ": one was under way";
        EXPECT_TRUE(r.said(state == guidance::PerchingState::resting ? "moves while" : "jumped"))
            << to_string(state);
    }
}

TEST(HandBack, AJumpThatIsOverAtOnceIsNoReason) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.stage.motion_capture_off_m = {5.0, 0.0, 0.0};
    r.tick();
    r.stage.motion_capture_off_m.setZero();
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().outcome, Outcome::released) << r.result().reason;
    EXPECT_TRUE(r.said("motion capture: its pose jumped (5.00 m)"));
}

/// The autopilot's estimate follows, so both agree all the time.
TEST(HandBack, APoseThatDriftsOnTheStandArmsNobody) {
    for (const double begins_s : {0.0, 3.0}) {
        Rehearsal r({"limits.wait_limit_s=10", "limits.operator_limit_s=10"});
        r.stage.obeys_mode = false;
        r.run(begins_s);
        r.stage.estimate_drift_m_s = {1.0, 0.0, 0.0};
        r.run(2.0);
        r.stage.obeys_mode = true;
        const int poses = r.stage.autopilot.poses;
        ASSERT_TRUE(r.run_out(30.0));
        EXPECT_EQ(r.stage.autopilot.poses, poses) << begins_s;
        EXPECT_EQ(r.stage.autopilot.arms, 0) << begins_s;
        EXPECT_EQ(r.result().end, CompanionEnd::absent) << begins_s;
        EXPECT_THAT(r.result().reason, testing::HasSubstr("its pose moves while motors are off"));
    }
}

TEST(HandBack, ALateTickOnTheWayToItsStartCountsToo) {
    Rehearsal r;
    while (!r.stage.armed && r.stage.time_s() < 20.0) {
        r.tick();
    }
    r.run(0.5);
    ASSERT_EQ(r.companion->phase(), SessionPhase::ready);
    r.late_s = 0.4;
    r.tick();
    EXPECT_EQ(r.companion->phase(), SessionPhase::handed_back);
    ASSERT_TRUE(r.run_out(5.0));
    EXPECT_EQ(r.stage.mode, Stage::kLoiter);
    EXPECT_EQ(r.result().end, CompanionEnd::handed_back);
}

TEST(HandBack, ATickThatIsALittleLateIsCountedAlone) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.late_s = 0.29;
    r.tick();
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
    EXPECT_EQ(r.result().late_ticks, 1U);
    EXPECT_DOUBLE_EQ(r.result().lateness.largest_s(), 0.29);
}

TEST(HandBack, WhereTheOperatorTakesTheModeNothingIsAskedForAnyMore) {
    for (const guidance::PerchingState state :
         {guidance::PerchingState::approaching, guidance::PerchingState::pitching_up,
          guidance::PerchingState::resting, guidance::PerchingState::backing_off}) {
        Rehearsal r;
        ASSERT_TRUE(r.run_to(state)) << to_string(state);
        r.tick();
        const bool on_wall = state == guidance::PerchingState::pitching_up ||
                             state == guidance::PerchingState::resting;
        r.stage.mode = Stage::kPosition;
        r.tick();
        r.stage.step();
        const Since since(r);
        ASSERT_TRUE(r.run_out(5.0)) << to_string(state);
        EXPECT_EQ(since.set_points(), 0) << to_string(state);
        EXPECT_EQ(since.holds() + since.offboards() + since.arms(), 0) << to_string(state);
        EXPECT_EQ(r.stage.mode, Stage::kPosition) << to_string(state);
        EXPECT_EQ(r.stage.mechanism.pump_on, on_wall) << to_string(state);
        EXPECT_EQ(r.result().end, CompanionEnd::handed_back) << to_string(state);
        EXPECT_THAT(r.result().reason, testing::HasSubstr("another mode was chosen"));
    }
}

TEST(HandBack, WhoIsDisarmedByOthersIsNotArmedAgain) {
    Rehearsal r({"guidance.dock_speed_m_s=0.1"});
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.tick();
    r.stage.armed = false;
    const Since since(r);
    ASSERT_TRUE(r.run_out(5.0));
    EXPECT_EQ(since.arms(), 0);
    EXPECT_EQ(since.holds(), 0);
    EXPECT_THAT(r.result().reason, testing::HasSubstr("disarmed by somebody else"));
}

TEST(HandBack, OnTheCupItLandsFirstAndNeverHolds) {
    const auto finishes = [](const std::function<void(Rehearsal&)>& wrong, CompanionEnd end,
                             const std::string& why) {
        Rehearsal r;
        ASSERT_TRUE(r.run_to(guidance::PerchingState::pitching_up)) << why;
        r.tick();
        wrong(r);
        const Since since(r);
        ASSERT_TRUE(r.run_out()) << why;
        EXPECT_GT(since.set_points(), 100) << why << ": guidance goes on until it rests";
        EXPECT_EQ(since.holds(), 0) << why;
        EXPECT_EQ(since.arms(), 0) << why << ": no take-off";
        EXPECT_FALSE(r.stage.armed) << why;
        EXPECT_TRUE(r.stage.mechanism.pump_on) << why;
        EXPECT_EQ(place_of(r.companion->memory()), Place::at_rest) << why;
        EXPECT_EQ(r.result().end, end) << why;
        EXPECT_THAT(r.result().reason, testing::HasSubstr(why));
    };
    using enum CompanionEnd;
    finishes([](Rehearsal& r) { r.interrupted = true; }, interrupted, "interrupted");
    finishes([](Rehearsal& r) { r.stage.motion_capture_works = false; }, handed_back,
             "motion-capture pose stale");
    finishes([](Rehearsal& r) { r.late_s = 0.4; }, handed_back, "guidance came too late");
}

TEST(HandBack, OnTheCupASilentAutopilotThatHearsIsLandedFirst) {
    Rehearsal r({"guidance.land_limit_s=20", "guidance.land_pitch_s=6"});
    ASSERT_TRUE(r.run_to(guidance::PerchingState::pitching_up));
    r.stage.beats = false;
    r.run(3.2);
    ASSERT_EQ(r.companion->phase(), SessionPhase::flying);
    ASSERT_TRUE(r.said("autopilot silent, on the cup, motors on"));
    const Since since(r);
    r.run(1.0);
    EXPECT_GE(since.set_points(), 45) << "without them it would hold, and pry at the cup";
    EXPECT_EQ(since.holds(), 0);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
}

TEST(HandBack, AnOperatorWhoAnswersHoldWithAModeOfHisOwnKeepsIt) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.stage.motion_capture_works = false;
    while (r.stage.mode == Stage::kOffboard && r.stage.time_s() < 100.0) {
        r.tick();
    }
    ASSERT_EQ(r.stage.mode, Stage::kLoiter);
    r.stage.mode = Stage::kPosition;
    ASSERT_TRUE(r.run_out(5.0));
    EXPECT_EQ(r.stage.mode, Stage::kPosition);
}

TEST(HandBack, AModeTakenAwayBeforeTheStartEndsIt) {
    Rehearsal r({"autopilot.asks_for_mode=false"});
    while (r.companion->phase() != SessionPhase::ready && r.stage.time_s() < 10.0) {
        r.tick();
    }
    ASSERT_EQ(r.companion->phase(), SessionPhase::ready);
    r.stage.mode = Stage::kOffboard;  // disarmed, on the ground
    r.run(1.0);
    ASSERT_EQ(r.companion->phase(), SessionPhase::ready);
    r.stage.mode = Stage::kPosition;
    const Since since(r);
    ASSERT_TRUE(r.run_out(5.0)) << "it would wait without set-points, and OFFBOARD be refused";
    EXPECT_EQ(r.result().end, CompanionEnd::handed_back);
    EXPECT_THAT(r.result().reason, testing::HasSubstr("another mode was chosen"));
    EXPECT_EQ(since.holds() + since.offboards() + since.arms(), 0);
}

TEST(HandBack, InterruptedWhilePressedItLeavesOrLandsFirst) {
    for (const bool seals : {true, false}) {
        Rehearsal r;
        r.stage.puppet.seals = seals;
        ASSERT_TRUE(r.run_to(guidance::PerchingState::holding));
        r.tick();
        r.interrupted = true;
        const Since since(r);
        ASSERT_TRUE(r.run_out());
        EXPECT_EQ(r.result().end, CompanionEnd::interrupted);
        EXPECT_EQ(since.holds() > 0, !seals) << "hold only away from the wall";
        EXPECT_EQ(r.stage.mechanism.pump_on, seals);
        if (!seals) {
            EXPECT_LT(r.stage.puppet.estimate.p_WB_m.x(), 0.8) << "back at the pre-position";
        }
    }
}

TEST(HandBack, AtRestCtrlCLetsGoAndThePumpStaysOn) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::resting));
    r.run(1.0);
    r.interrupted = true;
    const Since since(r);
    ASSERT_TRUE(r.run_out(5.0));
    EXPECT_EQ(r.result().end, CompanionEnd::interrupted);
    EXPECT_EQ(since.holds() + since.arms(), 0);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
    EXPECT_EQ(r.companion->memory().state, guidance::PerchingState::resting);
}

TEST(HandBack, AtRestItIsOnlyOnceTheMotorsAreKnownToBeOff) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::unloading));
    r.stage.obeys_arming = false;  // the first commands to disarm are lost
    ASSERT_TRUE(r.run_to(guidance::PerchingState::resting));
    r.interrupted = true;
    const Since since(r);
    r.run(1.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
    EXPECT_GE(since.set_points(), 45) << "without them it would hold, motors on, and pry";
    r.stage.obeys_arming = true;
    ASSERT_TRUE(r.run_out(5.0));
    EXPECT_FALSE(r.stage.armed);
    EXPECT_EQ(r.result().end, CompanionEnd::interrupted);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
    EXPECT_EQ(since.holds(), 0);
}

TEST(HandBack, AtRestWithoutAPoseItDoesNotTakeOff) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::resting));
    r.tick();
    r.stage.motion_capture_works = false;
    const Since since(r);
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().end, CompanionEnd::handed_back);
    EXPECT_EQ(r.result().outcome, Outcome::perched);
    EXPECT_EQ(since.arms() + since.holds(), 0);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
}

TEST(HandBack, AtRestAPoseThatComesBackLetsItTakeOff) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::resting));
    r.stage.motion_capture_works = false;
    r.run(3.0);
    EXPECT_TRUE(r.said("motion-capture pose stale, at rest on the wall"));
    r.stage.motion_capture_works = true;
    ASSERT_TRUE(r.run_out());
    EXPECT_TRUE(r.said("all is well again"));
    EXPECT_EQ(r.result().end, CompanionEnd::mission_over);
    EXPECT_EQ(r.result().outcome, Outcome::released);
}

TEST(HandBack, LidarAndForceAreGuidancesOwnBusiness) {
    Rehearsal r({"guidance.attempts=1"});
    ASSERT_TRUE(r.run_to(guidance::PerchingState::approaching));
    r.tick();
    r.stage.puppet.lidar_works = false;
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().end, CompanionEnd::mission_over);
    EXPECT_EQ(r.result().outcome, Outcome::failed_to_seal);
    EXPECT_GE(r.stage.autopilot.holds, 1);
}

}  // namespace
}  // namespace limpet::companion
