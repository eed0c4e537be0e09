// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "limpet/guidance/guards.hpp"
#include "limpet/guidance/motion.hpp"
#include "puppet.hpp"

namespace limpet::guidance {
namespace {

using guards::joint_W;

std::string reason_of_abort(const Puppet& puppet) {
    for (const Event& event : puppet.events) {
        if (event.name == EventName::aborted) {
            return std::string(event.reason);
        }
    }
    return "";
}

TEST(Faults, NoWallInFrontEndsTheAttempt) {
    Puppet puppet;
    puppet.lidar_works = false;
    puppet.run(60.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    EXPECT_EQ(reason_of_abort(puppet),
              "no pre-position in time: the LiDARs never saw a wall within "
              "guidance.wall_near_limit_m");
}

TEST(Faults, LidarLostInTheDockingRunRetreats) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::approaching));
    puppet.lidar_works = false;
    puppet.run(puppet.parameters.sensor_limit_s + 0.1);
    EXPECT_EQ(puppet.memory.state, PerchingState::retreating);
    EXPECT_EQ(reason_of_abort(puppet), "LiDAR lost");
    puppet.lidar_works = true;
    puppet.run(120.0);
    EXPECT_EQ(puppet.memory.attempt, 2);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::released);
}

TEST(Faults, ForceSensorSilentInTheDockingRunRetreats) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::approaching));
    puppet.force_works = false;
    puppet.run(puppet.parameters.sensor_limit_s + 0.1);
    EXPECT_EQ(puppet.memory.state, PerchingState::retreating);
    EXPECT_EQ(reason_of_abort(puppet), "force sensor silent");
}

TEST(Faults, PressureStuckLowNeverStartsADockingRun) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pre_positioning));
    puppet.pressure_works = false;
    puppet.readings.cup_pressure = {0.0, {70000.0}};
    puppet.run(60.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    EXPECT_EQ(reason_of_abort(puppet), "pressure sensor stuck or silent");
}

TEST(Faults, SilentPressureIsNoSeal) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::holding));
    puppet.pressure_works = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::retreating, 1.0));
}

TEST(Faults, ARunThatMeetsNoWallIsBroken) {
    Puppet puppet;
    puppet.parameters.impact_force_N = 100.0;  // never felt
    ASSERT_TRUE(puppet.run_to(PerchingState::retreating));
    EXPECT_EQ(reason_of_abort(puppet), "no impact in time");
}

/// As an estimator does that has lost north: where it thinks forward is, there is no wall.
TEST(Faults, OneThatRestsDoesNotArmByAHeadingThatIsNotTheWalls) {
    for (const double misled_deg : {160.0, -40.0, 10.0}) {
        Puppet puppet;
        ASSERT_TRUE(puppet.run_to(PerchingState::resting));
        puppet.misled_rad = radians(misled_deg);
        puppet.run(puppet.parameters.rest_s + 2.0);
        const bool stays = misled_deg != 10.0;
        ASSERT_EQ(puppet.memory.ending.has_value(), stays) << misled_deg;
        if (stays) {
            EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
            EXPECT_EQ(puppet.memory.ending->reason.view(),
                      "heading is not the wall's: rests on the wall");
        }
    }
}

/// As an estimator does whose gyro has changed: its attitude goes off at rest, and comes back.
TEST(Faults, TheRestGoesOnWhileTheEstimateMoves) {
    for (const double finds_itself_s : {0.0, 10.0, 100.0}) {
        Puppet puppet;
        ASSERT_TRUE(puppet.run_to(PerchingState::resting));
        const double begin_s = puppet.time_s;
        const double rest_s = puppet.parameters.rest_s;
        while (puppet.memory.state == PerchingState::resting && puppet.time_s < begin_s + 60.0) {
            const double moves_s = std::min(puppet.time_s - begin_s, finds_itself_s);
            puppet.misled_rad = radians(0.5 * std::abs(std::remainder(moves_s, 20.0)));
            puppet.run(0.1);
        }
        EXPECT_EQ(puppet.memory.state, PerchingState::spinning_up);
        const double expected_s = finds_itself_s == 0.0    ? rest_s
                                  : finds_itself_s == 10.0 ? 10.0 + 3.0
                                                           : rest_s + 30.0;
        EXPECT_NEAR(puppet.time_s - begin_s, expected_s, 0.7) << finds_itself_s;
    }
}

TEST(Faults, VacuumLostWhileLandingRetreats) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_up));
    puppet.run(1.0);
    puppet.seals = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::retreating, 3.0));
    EXPECT_EQ(reason_of_abort(puppet), "vacuum lost");
}

TEST(Faults, WeakVacuumAtRestStartsTheMotors) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::resting));
    puppet.seals = false;
    puppet.leak_tau_s = 2.0;
    ASSERT_TRUE(puppet.run_to(PerchingState::spinning_up, puppet.parameters.rest_s));
    EXPECT_EQ(puppet.events.back().reason, "vacuum weak");
}

TEST(Faults, AReleaseThatTakesTooLongIsGivenUpAndItRestsAgain) {
    Puppet puppet;
    puppet.leak_tau_s = 16.0;
    puppet.vacuum_Pa = 27500.0;
    puppet.run(200.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
    EXPECT_EQ(reason_of_abort(puppet), "pressure not released in time");
    EXPECT_TRUE(puppet.memory.setpoint.pump_on);
    EXPECT_FALSE(puppet.memory.setpoint.armed);
}

TEST(Faults, AGrowingOscillationInterruptsTheRelease) {
    Puppet puppet;
    puppet.leak_tau_s = 16.0;
    puppet.vacuum_Pa = 27500.0;
    ASSERT_TRUE(puppet.run_to(PerchingState::releasing));
    puppet.run(1.0);
    puppet.swing_deg = puppet.parameters.oscillation_limit_deg + 1.0;
    puppet.run(0.1);
    EXPECT_EQ(reason_of_abort(puppet), "oscillation past its limit");
    EXPECT_TRUE(puppet.memory.setpoint.pump_on);
    puppet.run(100.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
}

TEST(Faults, LowBatteryStartsNoNewAttempt) {
    Puppet puppet;
    puppet.readings.battery = {0.0, {.voltage_V = 20.0, .current_A = 0.0, .remaining = 0.1}};
    puppet.run(60.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    EXPECT_EQ(reason_of_abort(puppet), "battery low");
}

TEST(Faults, ACupThatStaysStuckIsReportedAndReseals) {
    Puppet puppet;
    puppet.parameters.retreat_limit_s = 0.5;  // cannot be back by then
    ASSERT_TRUE(puppet.run_to(PerchingState::backing_off));
    puppet.pressure_works = false;  // nothing says that the vacuum is gone
    ASSERT_TRUE(puppet.run_to(PerchingState::resealing, 1.0));
    EXPECT_EQ(reason_of_abort(puppet), "the cup does not come off");
}

TEST(Faults, APumpThatMayHoldTheVehicleIsNotSwitchedOffBlind) {
    Puppet puppet;
    puppet.leak_tau_s = 16.0;
    puppet.vacuum_Pa = 27500.0;
    ASSERT_TRUE(puppet.run_to(PerchingState::releasing));
    puppet.run(2.0);
    puppet.pressure_works = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::resealing, 30.0));
    bool off = false;
    for (int k = 0; k < 3000; ++k) {
        puppet.tick();
        off = off || !puppet.memory.setpoint.pump_on;
    }
    EXPECT_FALSE(off) << "whoever hangs there would fall";
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
    EXPECT_FALSE(puppet.memory.setpoint.armed);
}

TEST(Faults, ACupThatComesOffWhileLandingOrTakingOffIsNoticed) {
    for (const PerchingState state : {PerchingState::pitching_up, PerchingState::pitching_down}) {
        Puppet puppet;
        ASSERT_TRUE(puppet.run_to(state));
        puppet.run(2.0);
        puppet.holds = false;  // the pitch turns about the centre of mass now
        puppet.pressure_works = false;
        puppet.run(3.0);
        EXPECT_EQ(reason_of_abort(puppet), "came off the wall");
    }
}

TEST(Faults, APoseAloneDoesNotSayThatTheCupCameOff) {
    for (const PerchingState state : {PerchingState::pitching_up, PerchingState::releasing}) {
        Puppet puppet;
        puppet.leak_tau_s = 16.0;
        puppet.readings.force = {0.0, {30.0}};
        ASSERT_TRUE(puppet.run_to(state));
        puppet.estimate.p_WB_m.x() -= 0.5;
        puppet.run(0.5);
        EXPECT_EQ(puppet.memory.state, state) << "the pressure says that it holds";
    }
}

TEST(Faults, PoseAndForceAreBelievedAgainstAStuckPressureButThePumpStaysOn) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_up));
    puppet.run(3.0);
    puppet.holds = false;  // pitched by now, and nothing pulls
    puppet.pressure_works = false;
    for (int k = 0; k < 100 && puppet.memory.state == PerchingState::pitching_up; ++k) {
        puppet.readings.cup_pressure = {puppet.time_s, {30000.0}};
        puppet.tick();
    }
    EXPECT_EQ(puppet.memory.state, PerchingState::retreating);
    EXPECT_EQ(reason_of_abort(puppet), "came off the wall");
    EXPECT_TRUE(puppet.memory.setpoint.pump_on);
}

TEST(Faults, ARetreatOpensTheValve) {
    Puppet puppet;
    puppet.parameters.valve_fitted = true;
    puppet.seals = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::retreating));
    puppet.tick();
    EXPECT_TRUE(puppet.memory.setpoint.valve_open);
    EXPECT_FALSE(puppet.memory.setpoint.pump_on);
}

TEST(Faults, ACupThatHoldsItBackIsLandedOnAgain) {
    Puppet puppet;
    puppet.parameters.retreat_limit_s = 0.5;
    ASSERT_TRUE(puppet.run_to(PerchingState::holding));
    puppet.pressure_works = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::resealing, 5.0));
    EXPECT_EQ(reason_of_abort(puppet), "the cup does not come off");
    EXPECT_TRUE(puppet.memory.setpoint.pump_on);
}

TEST(Faults, WhatComesOffUnaskedIsNotReleased) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_down));
    puppet.run(2.0);
    puppet.holds = false;
    puppet.pressure_works = false;
    puppet.run(60.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    EXPECT_EQ(puppet.memory.ending->reason.view(), "came off the wall, back at the pre-position");
}

TEST(Faults, WithoutAPositionItBrakesOnAttitudeAndSaysHowItEnds) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::approaching));
    puppet.run(1.0);
    puppet.knows_position = false;
    puppet.tick();
    EXPECT_EQ(puppet.memory.state, PerchingState::braking);
    EXPECT_TRUE(std::holds_alternative<AttitudeSetpoint>(puppet.memory.setpoint.motion));
    EXPECT_GT(euler_from_quaternion(std::get<AttitudeSetpoint>(puppet.memory.setpoint.motion).q_WB)
                  .pitch_rad,
              radians(5.0))
        << "nose up: away from the wall";
    puppet.run(1.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    EXPECT_EQ(puppet.memory.ending->reason.view(),
              "stands before the wall, position estimate lost");
}

TEST(Faults, WithoutAPositionItDocksNotAndLeavesNotTheWall) {
    for (const PerchingState state : {PerchingState::pre_positioning, PerchingState::aligning}) {
        Puppet puppet;
        ASSERT_TRUE(puppet.run_to(state));
        puppet.knows_position = false;
        puppet.run(0.1);
        ASSERT_TRUE(puppet.memory.ending);
        EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
    }
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::resting));
    puppet.knows_position = false;
    puppet.run(60.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
    EXPECT_FALSE(puppet.memory.setpoint.armed);
}

TEST(Wind, TooMuchOfItIsDeclined) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::aligning));
    puppet.memory.wind.trim_W_m_s2 = {0.0, 100.0, 0.0};
    puppet.run(puppet.parameters.settle_s + 0.1);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->reason.view(), "too much wind: leans too far");
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
}

TEST(Wind, AlongTheWallItTakesLessOfIt) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::aligning));
    const Vector3 right_W(-puppet.memory.wall.into_wall_W().y(),
                          puppet.memory.wall.into_wall_W().x(), 0.0);
    puppet.memory.wind.trim_W_m_s2 = kGravity_m_s2 * std::tan(radians(20.0)) * right_W;
    puppet.memory.since_s = puppet.time_s - puppet.parameters.settle_s - 0.1;
    puppet.tick();
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->reason.view(),
              "too much wind along the wall: at rest it would tip over a leg");
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::aborted);
}

TEST(Wind, BesideTheCupItLeansBackBeforeIt) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::releasing));
    puppet.memory.grip_W_m = joint_W(puppet.parameters, puppet.estimate) - Vector3(0.0, 0.1, 0.0);
    const Setpoint beside =
        motion(puppet.parameters, puppet.memory, puppet.estimate, puppet.time_s);
    const Euler to = euler_from_quaternion(std::get<AttitudeSetpoint>(beside.motion).q_WB);
    EXPECT_LT(to.roll_rad, -radians(3.0)) << "right of the cup: leans to the left";
}

TEST(Faults, APressureThatDoesNotMoveAfterPumpOffKeepsItOnTheWall) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_down));
    puppet.pressure_works = false;
    for (int k = 0; k < 5000 && !puppet.memory.ending; ++k) {
        puppet.readings.cup_pressure.time_s = puppet.time_s;  // fresh, and always the same
        puppet.tick();
    }
    EXPECT_EQ(reason_of_abort(puppet), "pressure sensor stuck");
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
}

/// A reading that comes back to what it was when the pump was switched off is no stuck sensor: a
/// pump that runs on ripples about it.
TEST(Faults, APumpThatRunsOnIsWaitedFor) {
    Puppet puppet;
    puppet.pump_runs_on_s = 6.0;
    puppet.ripple_Pa = 600.0;
    puppet.run(200.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(reason_of_abort(puppet), "");
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::released);
    EXPECT_GT(puppet.time_of(EventName::pressure_released) - puppet.time_of(EventName::pump_off),
              6.0);
}

/// Off the pressure it leaves, and the cup holds again: it goes back to waiting, not on pulling.
TEST(Faults, ACupThatSealsAgainWhileItLeavesIsWaitedForAgain) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::backing_off));
    puppet.clings = true;
    ASSERT_TRUE(puppet.run_to(PerchingState::releasing, 2.0));
    EXPECT_EQ(reason_of_abort(puppet), "the cup seals again while it leaves");
    EXPECT_FALSE(puppet.memory.setpoint.pump_on);
    puppet.clings = false;
    puppet.run(100.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::released);
}

TEST(Faults, ACupThatNeverStopsSealingAgainEndsTheWaiting) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::backing_off));
    puppet.clings = true;
    puppet.run(400.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::release_aborted);
    EXPECT_LE(puppet.memory.cup.sealed_again, puppet.parameters.attempts);
}

TEST(Faults, OneNoisySampleIsNoWeakVacuum) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::resting));
    puppet.run(1.0);
    puppet.pressure_works = false;
    puppet.readings.cup_pressure = {puppet.time_s, {90000.0}};
    puppet.tick();
    puppet.pressure_works = true;
    puppet.run(1.0);
    EXPECT_EQ(puppet.memory.state, PerchingState::resting);
}

}  // namespace
}  // namespace limpet::guidance
