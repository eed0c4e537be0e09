// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/derived.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

class Derived : public ::testing::Test {
protected:
    Scenario load(const std::vector<std::string>& overrides) const {
        return data_.load("first", overrides);
    }
    TestData data_;
};

TEST_F(Derived, HoverFollowsFromTheVehicle) {
    // 3.2 kg on k_mot 2.5e-5: 560.2 rad/s a rotor (facts.md section 1), so u = 460.2 / 700.
    const Scenario s = load({"vehicle.mass_kg=3.2"});
    const double speed_rad_s = std::sqrt(3.2 * kGravity_m_s2 / 4.0 / 2.5e-5);
    EXPECT_NEAR(s.guidance.hover_thrust, (speed_rad_s - 100.0) / 700.0, 1e-12);
    EXPECT_NEAR(s.guidance.hover_thrust, 0.657, 1e-3);
    EXPECT_EQ(s.autopilot.MPC_THR_HOVER, s.guidance.hover_thrust);
    EXPECT_DOUBLE_EQ(s.guidance.zero_thrust, -1.0 / 7.0);
    // 4 * 8e-4 * 560 / 3.2: 0.56 per second.
    EXPECT_NEAR(s.guidance.drag_1_s, 0.56, 1e-3);
}

TEST_F(Derived, LidarAndCupAreTheVehicles) {
    const Scenario s = load(
        {"vehicle.lidar.separation_m=0.3", "vehicle.lidar.x_m=0.25", "vehicle.cup.radius_m=0.05"});
    EXPECT_EQ(s.guidance.lidar_separation_m, 0.3);
    EXPECT_EQ(s.guidance.lidar_x_m, 0.25);
    EXPECT_EQ(s.cup.lip.radius_m, 0.05);
}

TEST_F(Derived, TheEarthsFieldIsTheSensors) {
    const Scenario s = load({"sensors.mag_field_gauss=0.5", "sensors.mag_inclination_deg=60",
                             "sensors.mag_declination_deg=90"});
    EXPECT_NEAR(s.autopilot.mag_field_north_gauss, 0.0, 1e-15);
    EXPECT_NEAR(s.autopilot.mag_field_east_gauss, 0.25, 1e-15);
    EXPECT_NEAR(s.autopilot.mag_field_down_gauss, 0.5 * std::sqrt(3.0) / 2.0, 1e-15);
}

TEST_F(Derived, GuidanceKnowsOfTheValve) {
    EXPECT_EQ(load({}).guidance.valve_fitted, false);
    EXPECT_EQ(load({"suction.valve_fitted=true"}).guidance.valve_fitted, true);
}

/// What the legs stand does not depend on how far it may lean otherwise.
TEST_F(Derived, TheLeanAcrossIsTheVehiclesWhateverTheOtherLimitIs) {
    const auto across = [this](const char* limit_deg) {
        const auto guidance = load({std::string("guidance.lean_limit_deg=") + limit_deg}).guidance;
        return guidance.lean_across_share * std::tan(radians(guidance.lean_limit_deg));
    };
    const double usual = across("25");
    EXPECT_LT(usual, std::tan(radians(25.0)));
    EXPECT_NEAR(across("40"), usual, 1e-12);
    EXPECT_NEAR(across("20"), usual, 1e-12);
    EXPECT_NEAR(across("5"), std::tan(radians(5.0)), 1e-12);  // the other limit comes first
}

TEST_F(Derived, GivenKeysWin) {
    const Scenario s = load({"guidance.hover_thrust=0.5", "autopilot.MPC_THR_HOVER=0.6",
                             "suction.radius_m=0.03", "guidance.lidar_x_m=0.1"});
    EXPECT_EQ(s.guidance.hover_thrust, 0.5);
    EXPECT_EQ(s.autopilot.MPC_THR_HOVER, 0.6);
    EXPECT_EQ(s.cup.lip.radius_m, 0.03);
    EXPECT_EQ(s.guidance.lidar_x_m, 0.1);
}

TEST_F(Derived, TheWallStandsAhead) {
    const Scenario s = load({"simulation.start_distance_m=2", "simulation.start_offset_m=0.1",
                             "simulation.start_yaw_deg=6", "simulation.start_height_m=1.2",
                             "wall.width_m=3", "wall.height_m=2"});
    EXPECT_EQ(s.wall.geometry.p_WT_m, Vector3(2.0, 0.0, 0.0));
    EXPECT_EQ(s.wall.geometry.R_WT, Matrix3::Identity());
    EXPECT_EQ(s.wall.geometry.half_width_m, 1.5);
    EXPECT_EQ(s.wall.geometry.half_height_m, 1.0);
    EXPECT_EQ(s.start.p_WB_m, Vector3(0.0, 0.1, 0.0));
    EXPECT_DOUBLE_EQ(s.start.yaw_rad, radians(6.0));
    EXPECT_EQ(s.start.ground_z_W_m, 1.2);
}

TEST_F(Derived, TheHeadingTurnsWallAndStartAlike) {
    const Scenario s = load({"simulation.start_distance_m=2", "simulation.start_offset_m=0.1",
                             "simulation.start_yaw_deg=10", "wall.heading_deg=90"});
    EXPECT_TRUE(s.wall.geometry.p_WT_m.isApprox(Vector3(0.0, 2.0, 0.0), 1e-15));
    EXPECT_TRUE(
        s.wall.geometry.R_WT.col(0).isApprox(Vector3::UnitY(), 1e-15));  // into the wall: east
    EXPECT_TRUE(s.wall.geometry.R_WT.col(1).isApprox(-Vector3::UnitX(), 1e-15));  // right: south
    EXPECT_TRUE(s.start.p_WB_m.isApprox(Vector3(-0.1, 0.0, 0.0), 1e-15));
    EXPECT_NEAR(s.start.yaw_rad, radians(100.0), 1e-15);
}

TEST_F(Derived, ALeaningWallsNormalPointsUp) {
    const Scenario s = load({"wall.lean_deg=10", "wall.heading_deg=30"});
    const Matrix3& R_WT = s.wall.geometry.R_WT;
    const Vector3 normal_W = -R_WT.col(0);
    EXPECT_NEAR(normal_W.z(), -std::sin(radians(10.0)), 1e-15);
    const Vector3 heading_W(std::cos(radians(30.0)), std::sin(radians(30.0)), 0.0);
    EXPECT_GT((-R_WT.col(2)).dot(heading_W), 0.1);  // the top leans away
    EXPECT_NEAR(R_WT.col(1).z(), 0.0, 1e-15);
    EXPECT_TRUE((R_WT.transpose() * R_WT).isApprox(Matrix3::Identity(), 1e-14));
    EXPECT_NEAR(R_WT.determinant(), 1.0, 1e-14);
}

}  // namespace
}  // namespace limpet::scenario
