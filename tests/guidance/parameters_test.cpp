// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "puppet.hpp"

namespace limpet::guidance {
namespace {

/// How long it rests while its attitude moves by so much, to and fro.
double rest_of(Puppet puppet, double moves_deg) {
    EXPECT_TRUE(puppet.run_to(PerchingState::resting));
    const double begin_s = puppet.time_s;
    for (bool there = false; puppet.memory.state == PerchingState::resting; there = !there) {
        puppet.misled_rad = there ? 0.0 : radians(moves_deg);
        puppet.run(0.5);
        if (puppet.time_s - begin_s > 100.0 || puppet.memory.ending) {
            break;
        }
    }
    return puppet.time_s - begin_s;
}

/// Numbers that a user may set act: each changes what the puppet does.
TEST(GuidanceParameters, SayWhatHasMovedAndHowLongItIsWaitedFor) {
    Puppet puppet;
    const double rest_s = puppet.parameters.rest_s;
    EXPECT_NEAR(rest_of(puppet, 0.2), rest_s, 0.6) << "below moved_limit_deg";
    EXPECT_NEAR(rest_of(puppet, 0.4), rest_s + 30.0, 0.6);
    puppet.parameters.still_limit_s = 5.0;
    EXPECT_NEAR(rest_of(puppet, 0.4), rest_s + 5.0, 0.6);
    puppet.parameters.moved_limit_deg = 0.5;
    EXPECT_NEAR(rest_of(puppet, 0.4), rest_s, 0.6);
    puppet.parameters.moved_limit_deg = 0.3;
    puppet.parameters.still_s = 0.0;
    EXPECT_NEAR(rest_of(puppet, 0.4), rest_s, 0.6);
}

TEST(GuidanceParameters, SayWhichHeadingIsTheWallsStill) {
    for (const double limit_deg : {25.0, 45.0}) {
        Puppet puppet;
        puppet.parameters.turned_limit_deg = limit_deg;
        ASSERT_TRUE(puppet.run_to(PerchingState::resting));
        puppet.misled_rad = radians(35.0);
        puppet.run(puppet.parameters.rest_s + 2.0);
        EXPECT_EQ(puppet.memory.ending.has_value(), limit_deg < 35.0) << limit_deg;
    }
}

TEST(GuidanceParameters, SayHowHardItBrakesWithoutAPosition) {
    const auto pitch_deg = [](double most_m_s2) {
        Puppet puppet;
        puppet.parameters.brake_acceleration_m_s2 = most_m_s2;
        puppet.parameters.drag_1_s = 0.0;  // what the air takes is added to it
        EXPECT_TRUE(puppet.run_to(PerchingState::approaching));
        puppet.run(1.0);
        puppet.knows_position = false;
        puppet.tick();
        EXPECT_EQ(puppet.memory.state, PerchingState::braking);
        return degrees(
            euler_from_quaternion(std::get<AttitudeSetpoint>(puppet.memory.setpoint.motion).q_WB)
                .pitch_rad);
    };
    EXPECT_GT(pitch_deg(4.0), pitch_deg(1.0) + 2.0);
    EXPECT_NEAR(pitch_deg(1.0), degrees(std::atan(1.0 / kGravity_m_s2)), 1.0);
}

/// A table's row for each number, with the default that the struct has.
TEST(GuidanceParameters, HaveTheirRanges) {
    PerchingParameters parameters;
    for (const auto& row : perching_table()) {
        const double value = row.get(parameters);
        EXPECT_GE(value, row.minimum) << row.name;
        EXPECT_LE(value, row.maximum) << row.name;
    }
}

}  // namespace
}  // namespace limpet::guidance
