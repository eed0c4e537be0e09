// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/manoeuvre_goal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/companion/asked_session.hpp"

namespace limpet::ros {
namespace {

using guidance::PerchingState;
using testing::HasSubstr;

/// A goal, looked at after each tick, until its end.
class AGoal : public companion::Session {
protected:
    AGoal() {
        after_tick_ = [this] {
            if (goal_ && !end_) {
                end_ = goal_->look(session_);
            }
        };
    }
    void set(Manoeuvre manoeuvre) {
        ASSERT_TRUE(request(session_, manoeuvre, time_s_).done);
        goal_.emplace(manoeuvre);
        end_.reset();
    }
    /// As perch_until_rest(), to where the cup holds.
    void perch_until_on_cup() {
        run_until(PerchingState::approaching, 5.0);
        force_N_ = -50.0;
        run_until(PerchingState::holding, 1.0);
        pressure_Pa_ = 70000.0;
        run_until(PerchingState::pitching_up, 2.0);
    }
    void come_to_rest() {
        pitch_rad_ = radians(66.0);
        run_until(PerchingState::resting, 10.0);
    }

    std::optional<ManoeuvreGoal> goal_;
    std::optional<GoalEnd> end_;
};

TEST_F(AGoal, ToPerchIsReachedAtRestAndOneToTakeOffInTheAir) {
    run(0.5);
    set(Manoeuvre::perch);
    perch_until_on_cup();
    come_to_rest();
    EXPECT_FALSE(end_) << "the mission has a rest to make";
    run(2.0);
    ASSERT_TRUE(end_);
    EXPECT_TRUE(end_->success);
    EXPECT_EQ(end_->outcome, "perched");
    run(1.0);
    set(Manoeuvre::take_off);
    run_until(PerchingState::pitching_down, 3.0);
    pitch_rad_ = 0.0;
    run_until(PerchingState::releasing, 10.0);
    EXPECT_FALSE(end_);
    pressure_Pa_ = kAtmosphere_Pa;
    run(4.0);
    ASSERT_TRUE(end_);
    EXPECT_TRUE(end_->success);
    EXPECT_EQ(end_->outcome, "released");
}

TEST_F(AGoal, ThatIsCanceledInTheAirHandsBack) {
    run(0.5);
    set(Manoeuvre::perch);
    run_until(PerchingState::approaching, 5.0);
    EXPECT_TRUE(session_.abort().done);
    goal_->cancel();
    run(0.1);
    ASSERT_TRUE(end_);
    EXPECT_TRUE(end_->canceled);
    EXPECT_FALSE(end_->success);
    EXPECT_THAT(end_->reason, HasSubstr("interrupted"));
    EXPECT_EQ(session_.phase(), companion::SessionPhase::handed_back);
}

TEST_F(AGoal, ThatIsCanceledOnTheCupComesToRest) {
    run(0.5);
    set(Manoeuvre::perch);
    perch_until_on_cup();
    EXPECT_TRUE(session_.abort().done);
    goal_->cancel();
    run(0.2);
    EXPECT_FALSE(end_) << "its motors still turn";
    come_to_rest();
    run(0.1);
    ASSERT_TRUE(end_);
    EXPECT_TRUE(end_->canceled);
    EXPECT_EQ(session_.place(), companion::Place::at_rest);
}

TEST_F(AGoal, ThatHadNotBegunIsOverWhenNobodyWantsItAnyMore) {
    run(0.5);
    set(Manoeuvre::perch);
    EXPECT_FALSE(goal_->look(session_)) << "OFFBOARD is to come";
    EXPECT_TRUE(session_.abort().done);
    end_ = goal_->look(session_);
    ASSERT_TRUE(end_);
    EXPECT_FALSE(end_->success);
    EXPECT_EQ(end_->reason, "not begun any more");
}

TEST_F(AGoal, ThatIsTakenAwayFails) {
    run(0.5);
    set(Manoeuvre::perch);
    run_until(PerchingState::approaching, 5.0);
    word_.offboard = false;  // another mode, by hand
    run(0.1);
    ASSERT_TRUE(end_);
    EXPECT_FALSE(end_->success);
    EXPECT_FALSE(end_->canceled);
    EXPECT_NE(end_->reason, "");
}

TEST_F(AGoal, OfASimulationThatBeginsAnewFails) {
    run(0.5);
    set(Manoeuvre::perch);
    run_until(PerchingState::approaching, 5.0);
    time_s_ = 0.5;
    run(0.1);
    ASSERT_TRUE(end_);
    EXPECT_FALSE(end_->success);
    EXPECT_EQ(end_->reason, "the simulation began anew");
}

TEST_F(AGoal, ToAbortIsReachedWhereControlIsHandedBack) {
    run(0.5);
    EXPECT_FALSE(request(session_, Manoeuvre::abort, time_s_).done);
    set(Manoeuvre::perch);
    run_until(PerchingState::approaching, 5.0);
    set(Manoeuvre::abort);
    run(0.1);
    ASSERT_TRUE(end_);
    EXPECT_TRUE(end_->success);
    EXPECT_EQ(session_.phase(), companion::SessionPhase::handed_back);
}

}  // namespace
}  // namespace limpet::ros
