// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/perching.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "puppet.hpp"

namespace limpet::guidance {
namespace {

using enum EventName;
using testing::ElementsAre;

TEST(Perching, GoesThroughTheWholeManoeuvre) {
    Puppet puppet;
    puppet.run(120.0);
    EXPECT_THAT(puppet.names(), ElementsAre(pre_positioned, approach_started, impact, hold_over,
                                            landing_started, perched, motors_off, motors_on, level,
                                            pump_off, pressure_released, backed_off));
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::released);
    EXPECT_EQ(puppet.memory.attempt, 1);
}

TEST(Perching, WithAValveItOpensIt) {
    Puppet puppet;
    puppet.parameters.valve_fitted = true;
    puppet.leak_tau_s = 16.0;
    puppet.run(120.0);
    EXPECT_THAT(puppet.names(), testing::Contains(valve_open));
    EXPECT_LT(puppet.time_of(pressure_released) - puppet.time_of(valve_open), 0.3);
}

TEST(Perching, StaysWhenThatIsTheTask) {
    Puppet puppet;
    puppet.task.take_off = false;
    puppet.run(120.0);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::perched);
    EXPECT_FALSE(puppet.memory.setpoint.armed);
    EXPECT_TRUE(puppet.memory.setpoint.pump_on);
}

TEST(Perching, HoversWhenThatIsTheTask) {
    Puppet puppet;
    puppet.task.perch = false;
    puppet.restart();
    puppet.run(60.0);
    EXPECT_TRUE(puppet.events.empty());
    EXPECT_NEAR(puppet.time_s, puppet.task.hover_s, 0.05);
}

TEST(Perching, AlignsBeforeItApproaches) {
    Puppet puppet;
    puppet.yaw_rad = radians(8.0);
    puppet.estimate.q_WB = quaternion_from_euler({.yaw_rad = puppet.yaw_rad});
    puppet.restart();
    ASSERT_TRUE(puppet.run_to(PerchingState::approaching));
    EXPECT_LT(std::abs(degrees(puppet.yaw_rad)), puppet.parameters.align_limit_deg);
}

TEST(Perching, DocksAtConstantSpeed) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::approaching));
    ASSERT_TRUE(puppet.run_to(PerchingState::holding));
    EXPECT_NEAR(puppet.estimate.v_WB_m_s.x(), puppet.parameters.dock_speed_m_s, 0.02);
}

TEST(Perching, DecidesAtTheEndOfTheHoldNotBefore) {
    Puppet puppet;
    puppet.run(120.0);
    EXPECT_NEAR(puppet.time_of(hold_over) - puppet.time_of(impact), 0.5, Puppet::kDt_s);
    EXPECT_EQ(puppet.time_of(hold_over), puppet.time_of(landing_started));
}

TEST(Perching, WithoutASealItRetreatsAndTriesAgain) {
    Puppet puppet;
    puppet.seals = false;
    ASSERT_TRUE(puppet.run_to(PerchingState::retreating));
    EXPECT_NEAR(puppet.time_s - puppet.time_of(impact), 0.5, 2.0 * Puppet::kDt_s);
    EXPECT_FALSE(puppet.memory.setpoint.pump_on);
    puppet.seals = true;
    puppet.run(120.0);
    EXPECT_EQ(puppet.memory.attempt, 2);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::released);
}

TEST(Perching, GivesUpAfterItsAttempts) {
    Puppet puppet;
    puppet.seals = false;
    puppet.run(200.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::failed_to_seal);
    EXPECT_EQ(puppet.memory.attempt, puppet.parameters.attempts);
}

/// A seal that comes and goes again is another failure than one that never came.
TEST(Perching, TellsASealThatWasLostFromNone) {
    Puppet puppet;
    puppet.leak_tau_s = 0.03;
    for (int attempt = 1; attempt <= puppet.parameters.attempts; ++attempt) {
        puppet.seals = true;
        ASSERT_TRUE(puppet.run_to(PerchingState::holding));
        puppet.run(0.3);
        puppet.seals = false;  // it comes off before the decision
        ASSERT_TRUE(puppet.run_to(PerchingState::retreating));
        EXPECT_EQ(puppet.events.back().name, EventName::retreat_started);
        EXPECT_EQ(puppet.events.back().reason, "sealed, but does not hold");
        EXPECT_EQ(puppet.memory.cup.seals_lost, attempt);
    }
    puppet.run(60.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.ending->outcome, Outcome::failed_to_seal);
    EXPECT_EQ(puppet.memory.ending->reason.view(), "sealed and came off in every attempt");
}

TEST(Perching, OneAttemptWithoutASealIsNotOneThatCameOff) {
    Puppet puppet;
    puppet.leak_tau_s = 0.03;
    ASSERT_TRUE(puppet.run_to(PerchingState::holding));
    puppet.run(0.3);
    puppet.seals = false;
    puppet.run(200.0);
    ASSERT_TRUE(puppet.memory.ending);
    EXPECT_EQ(puppet.memory.cup.seals_lost, 1);
    EXPECT_EQ(puppet.memory.ending->reason.view(), "no landing in any attempt");
}

TEST(Perching, PumpGoesOffOnlyOnceLevelAndStable) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_down));
    while (puppet.memory.state == PerchingState::pitching_down) {
        EXPECT_TRUE(puppet.memory.setpoint.pump_on);
        puppet.tick();
    }
    EXPECT_LT(std::abs(degrees(puppet.pitch_rad)), puppet.parameters.level_limit_deg);
    puppet.tick();
    EXPECT_FALSE(puppet.memory.setpoint.pump_on);
}

TEST(Perching, NoPositionControlWhileAttached) {
    // A position loop winds up against the wall and pries at the cup.
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_up));
    for (int k = 0; k < 5000 && puppet.memory.state != PerchingState::backing_off; ++k) {
        puppet.tick();
        if (puppet.memory.state == PerchingState::backing_off) {
            break;
        }
        EXPECT_FALSE(std::holds_alternative<PositionSetpoint>(puppet.memory.setpoint.motion));
        EXPECT_FALSE(std::holds_alternative<VelocitySetpoint>(puppet.memory.setpoint.motion));
    }
}

TEST(Perching, ThrustFallsWhilePitchRises) {
    Puppet puppet;
    ASSERT_TRUE(puppet.run_to(PerchingState::pitching_up));
    double thrust = 1.0;
    double pitch_rad = -1.0;
    for (; puppet.memory.state != PerchingState::standing &&
           puppet.memory.state != PerchingState::resting;
         puppet.tick()) {
        if (const auto* attitude = std::get_if<AttitudeSetpoint>(&puppet.memory.setpoint.motion)) {
            EXPECT_LE(attitude->thrust, thrust + 1e-12);
            thrust = attitude->thrust;
            const double now_rad = euler_from_quaternion(attitude->q_WB).pitch_rad;
            EXPECT_GE(now_rad, pitch_rad - 1e-12);
            pitch_rad = now_rad;
        }
    }
    EXPECT_NEAR(thrust, 0.0, 0.05);
}

TEST(Perching, ACopyGoesOnAlike) {
    Puppet puppet;
    puppet.run(4.0);
    Puppet copy = puppet;
    puppet.run(100.0);
    copy.run(100.0);
    EXPECT_EQ(puppet.names(), copy.names());
    EXPECT_EQ(puppet.time_s, copy.time_s);
}

}  // namespace
}  // namespace limpet::guidance
