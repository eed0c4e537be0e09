// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/vehicle_mode.hpp"

#include <gtest/gtest.h>

namespace limpet::ros {
namespace {

class VehicleModes : public testing::Test {
protected:
    bool update(double time_s) { return mode_.update(estimate_, time_s, setpoint_); }
    [[nodiscard]] const PositionSetpoint* held() const {
        return std::get_if<PositionSetpoint>(&setpoint_.motion);
    }

    VehicleMode mode_{OffboardManners{}};
    Estimate estimate_;
    Setpoint setpoint_;
};

TEST_F(VehicleModes, BeginsArmedAndHoldsWhereItIs) {
    estimate_.p_WB_m = {1.0, 2.0, 3.0};
    EXPECT_FALSE(update(1.0));
    EXPECT_TRUE(setpoint_.armed);
    estimate_.p_WB_m = {1.1, 2.0, 3.0};  // pushed
    (void)update(1.1);
    ASSERT_NE(held(), nullptr);
    EXPECT_TRUE(held()->p_W_m.isApprox(Vector3(1.0, 2.0, 3.0)));
}

TEST_F(VehicleModes, OffboardIsTakenOnlyWhileSetPointsCome) {
    EXPECT_TRUE(mode_.choose("OFFBOARD", 1.0));
    EXPECT_EQ(mode_.mode(), kHold);
    mode_.set_point(VelocitySetpoint{.v_W_m_s = {1.0, 0.0, 0.0}}, 1.0);
    EXPECT_TRUE(mode_.choose("OFFBOARD", 1.2));
    EXPECT_EQ(mode_.mode(), kOffboard);
    (void)update(1.2);
    EXPECT_TRUE(std::holds_alternative<VelocitySetpoint>(setpoint_.motion));
    EXPECT_FALSE(mode_.choose("ACRO", 1.2));
    EXPECT_EQ(mode_.mode(), kOffboard);
}

TEST_F(VehicleModes, WithoutSetPointsItHoldsAfterHalfASecond) {
    mode_.set_point(VelocitySetpoint{.v_W_m_s = {1.0, 0.0, 0.0}}, 1.0);
    (void)mode_.choose("OFFBOARD", 1.0);
    EXPECT_FALSE(update(1.49));
    EXPECT_EQ(mode_.mode(), kOffboard);
    estimate_.p_WB_m = {0.5, 0.0, 0.0};
    EXPECT_TRUE(update(1.51));
    EXPECT_EQ(mode_.mode(), kHold);
    ASSERT_NE(held(), nullptr);
    EXPECT_TRUE(held()->p_W_m.isApprox(Vector3(0.5, 0.0, 0.0)));
    EXPECT_FALSE(update(1.52));                // reported once
    mode_.set_point(VelocitySetpoint{}, 1.6);  // after that the mode must be requested anew
    (void)update(1.6);
    EXPECT_EQ(mode_.mode(), kHold);
}

TEST_F(VehicleModes, BrakesBeforeItHolds) {
    mode_.set_point(VelocitySetpoint{.v_W_m_s = {1.0, 0.0, 0.0}}, 1.0);
    (void)mode_.choose("OFFBOARD", 1.0);
    estimate_.v_WB_m_s = {0.8, 0.0, 0.0};
    EXPECT_TRUE(update(1.51));
    const auto* brake = std::get_if<VelocitySetpoint>(&setpoint_.motion);
    ASSERT_NE(brake, nullptr);
    EXPECT_TRUE(brake->v_W_m_s.isZero(0.0));
    estimate_.p_WB_m = {0.4, 0.0, 0.0};
    estimate_.v_WB_m_s = {0.09, 0.0, 0.0};
    (void)update(2.0);
    ASSERT_NE(held(), nullptr);
    EXPECT_TRUE(held()->p_W_m.isApprox(Vector3(0.4, 0.0, 0.0)));
    estimate_.v_WB_m_s = {0.5, 0.0, 0.0};  // a gust
    (void)update(2.1);
    EXPECT_NE(held(), nullptr);
}

TEST_F(VehicleModes, DisarmedItStaysSo) {
    mode_.arm(false);
    (void)update(1.0);
    EXPECT_FALSE(setpoint_.armed);
    EXPECT_TRUE(std::holds_alternative<IdleSetpoint>(setpoint_.motion));
    estimate_.p_WB_m = {0.0, 0.0, -1.0};
    mode_.arm(true);
    (void)update(2.0);
    ASSERT_NE(held(), nullptr);
    EXPECT_TRUE(held()->p_W_m.isApprox(Vector3(0.0, 0.0, -1.0)));
}

}  // namespace
}  // namespace limpet::ros
