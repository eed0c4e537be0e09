// SPDX-License-Identifier: Apache-2.0
#include "limpet/guidance/wall_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::guidance {
namespace {

TEST(WallAngle, IsEquationSeven) {
    EXPECT_EQ(wall_angle(1.5, 1.5, 0.41), 0.0);
    EXPECT_NEAR(wall_angle(1.91, 1.50, 0.41), kPi / 4.0, 1e-12);
    // facts.md section 2: 2 deg is 14.3 mm on 0.41 m
    EXPECT_NEAR(degrees(wall_angle(1.5143, 1.5, 0.41)), 2.0, 0.01);
}

/// Echoes of a wall to the north at x_m, for a level vehicle.
Readings echoes(double time_s, double x_m, const Estimate& estimate, const PerchingParameters& p) {
    const double yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad;
    Readings readings;
    const auto echo = [&](double side) {
        const Vector3 p_BS_m(p.lidar_x_m, side * 0.5 * p.lidar_separation_m, 0.0);
        const Vector3 p_WS_m = estimate.p_WB_m + estimate.q_WB * p_BS_m;
        return RangeReading{(x_m - p_WS_m.x()) / std::cos(yaw_rad), true};
    };
    readings.lidar_left = {time_s, echo(-1.0)};
    readings.lidar_right = {time_s, echo(+1.0)};
    return readings;
}

TEST(WallSeen, FindsHeadingAndOffsetFromAnyYaw) {
    const PerchingParameters parameters;
    for (const double yaw_deg : {-12.0, 0.0, 5.0}) {
        Estimate estimate;
        estimate.p_WB_m = {0.3, -0.2, 0.0};
        estimate.q_WB = quaternion_from_euler({.yaw_rad = radians(yaw_deg)});
        WallSeen wall;
        see_wall(parameters, wall, echoes(1.0, 2.2, estimate, parameters), estimate);
        EXPECT_NEAR(degrees(wall.heading_rad), 0.0, 1e-9);
        EXPECT_NEAR(degrees(wall.alpha_rad), -yaw_deg, 1e-9);
        EXPECT_NEAR(wall.offset_m, 2.2, 1e-9);
        EXPECT_NEAR(wall.distance_m(parameters, estimate.p_WB_m), 2.2 - 0.3 - 0.205, 1e-9);
    }
}

TEST(WallSeen, EchoesAndPosesOfOtherTimesArePaired) {
    const PerchingParameters parameters;
    const auto flown = [](double time_s) {
        Estimate truth;
        truth.v_WB_m_s = {0.6, 0.2, 0.0};
        truth.w_WB_B_rad_s = {0.0, 0.0, 0.5};
        truth.p_WB_m = time_s * truth.v_WB_m_s;
        truth.q_WB = quaternion_from_rotation_vector(time_s * truth.w_WB_B_rad_s);
        return truth;
    };
    for (const double age_s : {0.0, 0.035}) {         // of the pose
        for (const double latency_s : {0.0, 0.02}) {  // of the echoes
            Estimate estimate = flown(0.1 - age_s);
            estimate.time_s = 0.1;
            estimate.age_s = age_s;
            WallSeen wall;
            const double time_s = 0.1 - latency_s;
            see_wall(parameters, wall, echoes(time_s, 2.2, flown(time_s), parameters), estimate);
            EXPECT_NEAR(wall.offset_m, 2.2, 1e-9) << age_s << ", " << latency_s;
            EXPECT_NEAR(wall.heading_rad, 0.0, 1e-9);
        }
    }
}

TEST(WallSeen, FilterSettlesWithItsTimeConstant) {
    PerchingParameters parameters;
    parameters.wall_filter_s = 0.3;
    Estimate estimate;
    WallSeen wall;
    see_wall(parameters, wall, echoes(0.0, 2.0, estimate, parameters), estimate);
    for (int k = 1; k <= 30; ++k) {
        see_wall(parameters, wall, echoes(0.01 * k, 3.0, estimate, parameters), estimate);
    }
    EXPECT_NEAR(wall.offset_m, 3.0 - std::exp(-1.0), 1e-9);
}

TEST(WallSeen, OneMissingEchoIsNoWall) {
    const PerchingParameters parameters;
    const Estimate estimate;
    Readings readings = echoes(1.0, 2.2, estimate, parameters);
    readings.lidar_right.value.valid = false;
    WallSeen wall;
    see_wall(parameters, wall, readings, estimate);
    EXPECT_FALSE(wall.ever);
}

TEST(WallSeen, AFarWallIsNotTheOne) {
    const PerchingParameters parameters;
    const Estimate estimate;
    WallSeen wall;
    see_wall(parameters, wall, echoes(1.0, 8.0, estimate, parameters), estimate);
    EXPECT_FALSE(wall.ever);
}

}  // namespace
}  // namespace limpet::guidance
