// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/position_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "defaults.hpp"
#include "limpet/core/random.hpp"

namespace limpet::autopilot {
namespace {

AttitudeSetpoint once(const VelocitySetpoint& target, const AutopilotParameters& parameters = {}) {
    PositionControlState state;
    return velocity_control(parameters, state, target, Vector3::Zero(), false, kDt_s);
}

Vector3 thrust_vector(const AttitudeSetpoint& setpoint) {
    return setpoint.q_WB * Vector3(0.0, 0.0, -setpoint.thrust);
}

TEST(PositionControl, VelocityIsProportional) {
    const VelocitySetpoint out =
        position_control(kDefaults, {.p_W_m = {1.0, -2.0, 0.5}, .yaw_rad = 0.3}, Vector3::Zero());
    EXPECT_TRUE(out.v_W_m_s.isApprox(Vector3(0.95, -1.9, 0.5), 1e-12));
    EXPECT_EQ(out.yaw_rad, 0.3);
}

TEST(PositionControl, VelocityIsLimited) {
    const VelocitySetpoint far =
        position_control(kDefaults, {.p_W_m = {300.0, 400.0, -50.0}}, Vector3::Zero());
    EXPECT_TRUE(far.v_W_m_s.isApprox(Vector3(7.2, 9.6, -3.0), 1e-12));
    const VelocitySetpoint down =
        position_control(kDefaults, {.p_W_m = {0.0, 0.0, 50.0}}, Vector3::Zero());
    EXPECT_NEAR(down.v_W_m_s.z(), 1.5, 1e-12);
}

/// The share that leads to the position stays whole, the feed-forward gives way.
TEST(PositionControl, FeedForwardYieldsToThePosition) {
    const VelocitySetpoint out = position_control(
        kDefaults, {.p_W_m = {0.0, 10.0, 0.0}, .feedforward_v_W_m_s = {20.0, 0.0, 0.0}},
        Vector3::Zero());
    EXPECT_NEAR(out.v_W_m_s.y(), 9.5, 1e-12);
    EXPECT_NEAR(out.v_W_m_s.norm(), 12.0, 1e-12);
}

TEST(VelocityControl, HoverIsLevelAtHoverThrust) {
    const AttitudeSetpoint out = once({.yaw_rad = 0.7});
    EXPECT_NEAR(out.thrust, 0.657, 1e-12);
    EXPECT_NEAR(euler_from_quaternion(out.q_WB).yaw_rad, 0.7, 1e-12);
    EXPECT_NEAR(euler_from_quaternion(out.q_WB).pitch_rad, 0.0, 1e-12);
}

TEST(VelocityControl, AccelerationTiltsByItsShareOfGravity) {
    // north: nose down by atan(a / g), the vertical share of thrust unchanged
    const AttitudeSetpoint out = once({.feedforward_a_W_m_s2 = {1.5, 0.0, 0.0}});
    EXPECT_NEAR(euler_from_quaternion(out.q_WB).pitch_rad, -std::atan(1.5 / kGravity_m_s2), 1e-12);
    EXPECT_NEAR(thrust_vector(out).z(), -0.657, 1e-12);
    // climb: T = hover (1 + a / g)
    EXPECT_NEAR(once({.feedforward_a_W_m_s2 = {0.0, 0.0, -2.0}}).thrust,
                0.657 * (1.0 + 2.0 / kGravity_m_s2), 1e-12);
}

TEST(VelocityControl, PidTermsByHand) {
    PositionControlState state;
    state.integral_m_s2 = {0.1, 0.0, 0.0};
    state.acceleration_m_s2 = {0.5, 0.0, 0.0};
    const AttitudeSetpoint out = velocity_control(kDefaults, state, {.v_W_m_s = {0.4, 0.0, 0.0}},
                                                  {0.1, 0.0, 0.0}, false, kDt_s);
    const double a_m_s2 = 1.8 * 0.3 + 0.1 - 0.2 * 0.5;
    EXPECT_NEAR(euler_from_quaternion(out.q_WB).pitch_rad, -std::atan(a_m_s2 / kGravity_m_s2),
                1e-12);
    EXPECT_NEAR(state.integral_m_s2.x(), 0.1 + 0.4 * 0.3 * kDt_s, 1e-12);
}

TEST(VelocityControl, TiltIsLimited) {
    const AttitudeSetpoint out = once({.feedforward_a_W_m_s2 = {0.0, 40.0, 0.0}});
    EXPECT_NEAR(degrees(euler_from_quaternion(out.q_WB).roll_rad), 45.0, 1e-9);
}

TEST(VelocityControl, VerticalGoesBeforeHorizontalButForAMargin) {
    const AttitudeSetpoint out = once({.feedforward_a_W_m_s2 = {8.0, 0.0, -30.0}});
    EXPECT_NEAR(out.thrust, 1.0, 1e-12);
    EXPECT_NEAR(thrust_vector(out).x(), 0.3, 1e-12);
}

TEST(VelocityControl, ThrustHasALeast) {
    const AttitudeSetpoint out = once({.feedforward_a_W_m_s2 = {0.0, 0.0, 30.0}});
    EXPECT_NEAR(out.thrust, 0.12, 1e-12);
}

TEST(VelocityControl, SaturatedHorizontalUnwinds) {
    AutopilotParameters parameters;
    parameters.MPC_TILTMAX_AIR = 10.0;
    PositionControlState state;
    for (int i = 0; i < 10000; ++i) {
        static_cast<void>(velocity_control(parameters, state, {.v_W_m_s = {8.0, 0.0, 0.0}},
                                           Vector3::Zero(), false, kDt_s));
    }
    // settles where error = 2 / P (asked - given): asked = P e + i, given = g tan(10 deg)
    const double given_m_s2 = kGravity_m_s2 * std::tan(radians(10.0));
    EXPECT_NEAR(state.integral_m_s2.x(), given_m_s2 - 0.5 * 1.8 * 8.0, 1e-6);
}

TEST(VelocityControl, SaturatedVerticalDoesNotIntegrate) {
    PositionControlState state;
    for (int i = 0; i < 5000; ++i) {
        static_cast<void>(velocity_control(kDefaults, state, {.v_W_m_s = {0.0, 0.0, -3.0}},
                                           Vector3::Zero(), false, kDt_s));
    }
    EXPECT_EQ(state.integral_m_s2.z(), 0.0);  // 4 * 3 m/s^2 alone is over the top
}

TEST(VelocityControl, VerticalIntegralStopsAtOneG) {
    PositionControlState state;
    for (int i = 0; i < 50000; ++i) {
        static_cast<void>(velocity_control(kDefaults, state, {.v_W_m_s = {0.0, 0.0, -0.1}},
                                           Vector3::Zero(), false, kDt_s));
    }
    EXPECT_GE(state.integral_m_s2.z(), -kGravity_m_s2);
    EXPECT_LT(state.integral_m_s2.z(), -1.0);
}

/// Whatever is asked, the outcome is an attitude and a thrust within the limits.
TEST(VelocityControl, NothingAskedBreaksTheLimits) {
    RandomStream random(11, 0, Stream::test);
    PositionControlState state;
    for (int i = 0; i < 2000; ++i) {
        const AttitudeSetpoint out =
            velocity_control(kDefaults, state,
                             {.v_W_m_s = 10.0 * random.normal3(),
                              .yaw_rad = 10.0 * random.normal(),
                              .feedforward_a_W_m_s2 = 10.0 * random.normal3()},
                             5.0 * random.normal3(), false, kDt_s);
        ASSERT_TRUE(out.q_WB.coeffs().allFinite());
        EXPECT_NEAR(out.q_WB.norm(), 1.0, 1e-9);
        EXPECT_LE(out.thrust, 1.0 + 1e-12);
        EXPECT_GE(out.thrust, 0.12 - 1e-12);
        EXPECT_GE((out.q_WB * Vector3::UnitZ()).z(), std::cos(radians(45.0)) - 1e-9);
    }
}

TEST(AccelerationFilter, FirstOrderAtItsCutoff) {
    PositionControlState state;
    Estimate estimate;
    estimate.specific_force_B_m_s2 = {0.0, 0.0, -kGravity_m_s2};
    filter_acceleration(kDefaults, state, estimate, kDt_s);
    EXPECT_NEAR(state.acceleration_m_s2.norm(), 0.0, 1e-12);
    estimate.specific_force_B_m_s2.x() = 1.0;
    const double tau_s = 1.0 / (2.0 * kPi * 5.0);
    constexpr int kSteps = 3000;
    for (int i = 0; i < kSteps; ++i) {
        filter_acceleration(kDefaults, state, estimate, tau_s / kSteps);
    }
    EXPECT_NEAR(state.acceleration_m_s2.x(), 1.0 - std::exp(-1.0), 1e-3);
}

}  // namespace
}  // namespace limpet::autopilot
