// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::guidance {
namespace {

struct Run {
    double speed_m_s, acceleration_m_s2, ramp_s;
};
class RunReferenceTest : public testing::TestWithParam<Run> {};

TEST_P(RunReferenceTest, SpeedIsTheIntegralOfTheAcceleration) {
    const auto [speed, acceleration, ramp] = GetParam();
    constexpr double kDt_s = 1e-4;
    double integral_m_s = 0.0;
    for (double t_s = 0.0; t_s < 4.0; t_s += kDt_s) {
        const RunReference now = run_reference(t_s, speed, acceleration, ramp);
        ASSERT_NEAR(now.speed_m_s, integral_m_s, 1e-3);
        ASSERT_LE(now.acceleration_m_s2, acceleration + 1e-9);
        integral_m_s +=
            kDt_s * run_reference(t_s + 0.5 * kDt_s, speed, acceleration, ramp).acceleration_m_s2;
    }
    EXPECT_NEAR(integral_m_s, speed, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Ramps, RunReferenceTest,
                         testing::Values(Run{1.1, 1.5, 0.2}, Run{0.6, 1.0, 0.2},
                                         Run{0.1, 1.5, 0.2},  // over within the ramps
                                         Run{1.1, 1.5, 0.0}));

TEST(ThrustCommand, HoverIsHoverAndThrustGoesWithTheSquareOfTheSpeed) {
    const PerchingParameters parameters;
    EXPECT_NEAR(thrust_command(parameters, 1.0), 0.657, 1e-12);
    // rotor speed 700 u + 100 rad/s; a quarter of the thrust at half the speed
    const double speed = 700.0 * thrust_command(parameters, 0.25) + 100.0;
    EXPECT_NEAR(speed / (700.0 * 0.657 + 100.0), 0.5, 1e-9);
    EXPECT_EQ(thrust_command(parameters, 0.0), 0.0);
}

TEST(Smoothstep, StartsAndEndsAtRest) {
    EXPECT_EQ(smoothstep(-1.0), 0.0);
    EXPECT_EQ(smoothstep(0.5), 0.5);
    EXPECT_EQ(smoothstep(2.0), 1.0);
    EXPECT_NEAR(smoothstep(1e-4), 0.0, 1e-7);
    EXPECT_NEAR(smoothstep(1.0 - 1e-4), 1.0, 1e-7);
}

TEST(PrePosition, LiesOnTheDockingLineBeforeATurnedWall) {
    PerchingParameters parameters;
    PerchingMemory memory;
    memory.wall = {.time_s = 0.0, .heading_rad = radians(30.0), .offset_m = 3.0, .ever = true};
    memory.line_W_m = {0.2, 0.4, -0.1};
    const Vector3 p_W_m = pre_position_W(parameters, memory);
    const Vector3 n_W = memory.wall.into_wall_W();
    EXPECT_NEAR(memory.wall.distance_m(parameters, p_W_m), 1.5, 1e-12);
    EXPECT_LT((p_W_m - memory.line_W_m).cross(n_W).norm(), 1e-12);  // moved along n only
}

}  // namespace
}  // namespace limpet::guidance
