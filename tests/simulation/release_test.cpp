// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

using enum EventName;

TEST(PerchMetal, ReachesTheVacuumOfTableTwo) {
    EXPECT_NEAR(flown("perch_metal").result.metrics.pressure_min_Pa, 27500.0, 300.0);
}

TEST(PerchMetal, AfterSixteenSecondsItIsStillHeld) {
    const Trace& trace = flown("perch_metal");
    EXPECT_NEAR(trace.result.metrics.pressure_at_release_end_Pa, 74200.0, 1000.0);
    EXPECT_NEAR(trace.first(aborted) - trace.first(pump_off), 16.0, 0.05);
}

TEST(PerchMetal, GivesTheReleaseUpAndRestsOnTheWallAgain) {
    const Trace& trace = flown("perch_metal");
    EXPECT_EQ(trace.result.outcome, Outcome::release_aborted);
    EXPECT_EQ(trace.times(perched).size(), 2U);
    EXPECT_TRUE(trace.times(detached).empty());
    const Truth& end = trace.truth.back();
    EXPECT_EQ(end.cup_status.phase, CupPhase::attached);
    EXPECT_LT(end.cup_status.pressure_Pa, 40000.0);
    EXPECT_LT(end.thrust_N, 1e-3);
    EXPECT_GT(pitch_deg(end), 60.0);
}

TEST(PerchMetal, ThePumpRestsWhileItHangs) {
    // Paper, section V.B: no ripple on metal, the pump can turn off.
    const Trace& trace = flown("perch_metal");
    const double share = trace.mean(guidance::PerchingState::resting, [](const Truth& truth) {
        return truth.cup_status.pump_running ? 1.0 : 0.0;
    });
    EXPECT_LT(share, 0.7);
    const double on_concrete =
        flown("perch_concrete").mean(guidance::PerchingState::resting, [](const Truth& truth) {
            return truth.cup_status.pump_running ? 1.0 : 0.0;
        });
    EXPECT_EQ(on_concrete, 1.0);
}

TEST(PerchMetal, WithThePapersMotorsThePitchStaysStill) {
    // Paper, section V.B: the simulation does not show the oscillation.
    EXPECT_LT(flown("perch_metal").result.metrics.pitch_oscillation_max_deg, 1.0);
}

TEST(PerchMetalValve, IsReleasedAtOnce) {
    const Trace& trace = flown("perch_metal_valve");
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    EXPECT_LT(trace.first(detached) - trace.first(valve_open), 0.3);
}

/// A pump that draws on for six seconds delays the release by them, and no more. In this flight a
/// reading comes back to the first of the release, as that of a stuck sensor would.
TEST(ReleaseRunsOn, IsWaitedFor) {
    const auto release_s = [](const Trace& trace) {
        return trace.first(detached) - trace.first(pump_off);
    };
    const Trace trace = simulation::trace(model_of("release_runs_on", {}, 5));
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    EXPECT_TRUE(trace.times(aborted).empty());
    EXPECT_NEAR(release_s(trace) - release_s(flown("perch_concrete")), 6.0, 0.3);
}

/// A soft cup clings with the pump off when it is pulled at: pulled on it is not off in the time
/// that guidance has, waited for it is.
TEST(ReleaseSoftCup, SealsAgainWhileItLeavesAndComesOff) {
    const Trace& trace = flown("release_soft_cup");
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    const auto again = trace.times(aborted);
    ASSERT_FALSE(again.empty());
    EXPECT_GT(again.front(), trace.first(pressure_released));
    EXPECT_LT(trace.first(detached) - again.front(), 5.0);
    EXPECT_GT(trace.times(pressure_released).size(), 1U);
    // The same cup without stretch is off at once.
    const Trace rigid =
        simulation::trace(model_of("release_soft_cup", {"suction.cup_stretch_cm3_N=0"}));
    EXPECT_EQ(rigid.result.outcome, Outcome::released);
    EXPECT_TRUE(rigid.times(aborted).empty());
}

TEST(OscillationLimit, InterruptsTheRelease) {
    // A limit below what the take-off leaves behind stands for a swing that grew.
    const Trace trace =
        simulation::trace(model_of("perch_metal", {"guidance.oscillation_limit_deg=0.5"}));
    EXPECT_EQ(trace.result.outcome, Outcome::release_aborted);
    EXPECT_LT(trace.first(aborted) - trace.first(pump_off), 16.0);
}

}  // namespace
}  // namespace limpet::simulation
