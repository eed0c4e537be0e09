// SPDX-License-Identifier: Apache-2.0
// A session by request, as the ROS node has it: a puppet's inputs, an autopilot that does as it is
// asked.
#include "limpet/companion/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/companion/mechanism_out.hpp"

namespace limpet::companion {
namespace {

using testing::HasSubstr;

class Session : public testing::Test {
protected:
    Session() : session_(setup(), watch()) {}

    static SessionSetup setup() {
        SessionSetup setup;
        setup.task.take_off = false;
        setup.by_request = setup.asks_for_mode = true;
        setup.watches_motion_capture = false;
        setup.guidance.land_pitch_s = 0.5;
        setup.guidance.rest_s = 1.0;
        setup.guidance.slip_limit_m = 10.0;  // the puppet pitches about itself, not about its cup
        return setup;
    }

    CompanionWatch watch() {
        return {.on_event = [this](const Event& event) { events_.push_back(event.name); },
                .on_line = {}};
    }

    /// What the vehicle is like now, as all sensors tell it.
    void feed() {
        SessionInputs& in = session_.inputs();
        in.pose = {time_s_,
                   {.p_WB_m = p_WB_m_, .q_WB = quaternion_from_euler({.pitch_rad = pitch_rad_})}};
        in.velocity_W_m_s = {time_s_, Vector3::Zero()};
        in.rate_B_rad_s = {time_s_, Vector3::Zero()};
        const RangeReading range{.distance_m = 1.5 - p_WB_m_.x(), .valid = true};
        in.readings.lidar_left = in.readings.lidar_right = {time_s_, range};
        if (force_works_) {
            in.readings.force = {time_s_, {force_N_}};
        }
        in.readings.cup_pressure = {time_s_, {pressure_Pa_}};
        in.readings.battery = {time_s_, {.remaining = 1.0}};
        in.autopilot = {time_s_, word_};
    }
    void run(double duration_s) {
        for (const double end_s = time_s_ + duration_s; time_s_ < end_s - 1e-9; time_s_ += 0.02) {
            if (alive_) {
                feed();
            }
            session_.tick(time_s_);
            if (session_.wanted_mode() == "OFFBOARD") {
                word_.offboard = true;
            } else if (session_.wanted_mode() == "AUTO.LOITER") {
                word_.offboard = false;
            }
            word_.armed = session_.wanted_armed().value_or(word_.armed);
        }
    }
    /// Through the manoeuvre, by its signs, to a state.
    void run_until(guidance::PerchingState state, double limit_s) {
        const double end_s = time_s_ + limit_s;
        while (session_.memory().state != state && time_s_ < end_s) {
            run(0.02);
        }
        ASSERT_EQ(session_.memory().state, state);
    }
    void perch_until_rest() {
        run(0.5);
        ASSERT_TRUE(session_.perch(time_s_).done);
        run_until(guidance::PerchingState::approaching, 5.0);
        force_N_ = -50.0;
        run_until(guidance::PerchingState::holding, 1.0);
        pressure_Pa_ = 70000.0;
        run_until(guidance::PerchingState::pitching_up, 2.0);
        pitch_rad_ = radians(66.0);
        run_until(guidance::PerchingState::resting, 10.0);
        run(0.1);
    }

    std::vector<EventName> events_;
    PerchingSession session_;
    double time_s_ = 1.0;
    Vector3 p_WB_m_ = Vector3::Zero();
    double pitch_rad_ = 0.0;
    double force_N_ = 0.0;
    double pressure_Pa_ = kAtmosphere_Pa;
    AutopilotWord word_{.connected = true, .armed = true, .offboard = false};
    bool alive_ = true;
    bool force_works_ = true;
};

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
