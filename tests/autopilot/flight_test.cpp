// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "flight_rig.hpp"

namespace limpet::autopilot {
namespace {

Setpoint armed(const decltype(Setpoint::motion)& motion) {
    return {.motion = motion, .armed = true};
}

Kinematics attitude(double roll_deg, double pitch_deg, double yaw_deg) {
    Kinematics initial;
    initial.q_WF = quaternion_from_euler({radians(roll_deg), radians(pitch_deg), radians(yaw_deg)});
    return initial;
}

double tilt_deg(const Quaternion& q_WB) {
    return degrees(std::acos(std::min(1.0, (q_WB * Vector3::UnitZ()).z())));
}

double yaw_deg(const FlightRig& rig) {
    return degrees(euler_from_quaternion(rig.truth.q_WF).yaw_rad);
}

TEST(Flight, HoversOnTheSpot) {
    FlightRig rig;
    rig.fly(armed(PositionSetpoint{}), 10.0);
    EXPECT_LT(rig.truth.p_WF_m.norm(), 1e-3);
    EXPECT_LT(rig.truth.v_WF_W_m_s.norm(), 1e-3);
    for (const double speed : rig.speed_rad_s) {
        EXPECT_NEAR(speed, 560.2, 0.5);  // sqrt(3.2 * 9.80665 / (4 * 2.5e-5))
    }
}

TEST(Flight, HoversWithNoisySensors) {
    FlightRig rig({}, 1.0);
    double worst_m = 0.0;
    for (int i = 0; i < 200; ++i) {
        rig.fly(armed(PositionSetpoint{}), 0.1);
        worst_m = std::max(worst_m, rig.truth.p_WF_m.norm());
    }
    EXPECT_LT(worst_m, 0.02);
    EXPECT_GT(worst_m, 1e-5);  // the noise is on
    EXPECT_TRUE(rig.autopilot.estimate.valid);
}

TEST(Flight, PositionStepSettlesWithoutLargeOvershoot) {
    FlightRig rig;
    const Vector3 target(1.0, -0.5, -0.8);
    double overshoot_m = 0.0;
    for (int i = 0; i < 100; ++i) {
        rig.fly(armed(PositionSetpoint{.p_W_m = target}), 0.1);
        overshoot_m = std::max(overshoot_m, rig.truth.p_WF_m.x() - target.x());
    }
    EXPECT_LT(overshoot_m, 0.25);
    rig.fly(armed(PositionSetpoint{.p_W_m = target}), 10.0);
    EXPECT_LT((rig.truth.p_WF_m - target).norm(), 0.01);
}

TEST(Flight, YawStepLeavesThePositionAlone) {
    FlightRig rig;
    rig.fly(armed(PositionSetpoint{.yaw_rad = radians(90.0)}), 1.5);
    EXPECT_GT(yaw_deg(rig), 75.0);
    rig.fly(armed(PositionSetpoint{.yaw_rad = radians(90.0)}), 8.5);
    EXPECT_NEAR(yaw_deg(rig), 90.0, 0.5);
    EXPECT_LT(rig.truth.p_WF_m.norm(), 0.05);
}

TEST(Flight, VelocityFollowsItsFeedForward) {
    FlightRig rig;
    rig.fly(armed(PositionSetpoint{}), 1.0);
    // a ramp of 1.5 m/s^2 to 1.1 m/s, as docking flies it
    for (int i = 0; i < 183; ++i) {
        const double t_s = 0.004 * i;
        rig.fly(armed(VelocitySetpoint{.v_W_m_s = {1.5 * t_s, 0.0, 0.0},
                                       .feedforward_a_W_m_s2 = {1.5, 0.0, 0.0}}),
                0.004);
    }
    rig.fly(armed(VelocitySetpoint{.v_W_m_s = {1.1, 0.0, 0.0}}), 1.0);
    EXPECT_NEAR(rig.truth.v_WF_W_m_s.x(), 1.1, 0.06);
    rig.fly(armed(VelocitySetpoint{.v_W_m_s = {1.1, 0.0, 0.0}}), 6.0);
    EXPECT_NEAR(rig.truth.v_WF_W_m_s.x(), 1.1, 0.01);
    EXPECT_NEAR(rig.truth.v_WF_W_m_s.z(), 0.0, 0.01);
}

TEST(Flight, AttitudeStepIsFlownInHalfASecond) {
    FlightRig rig;
    const Quaternion target = quaternion_from_euler({radians(10.0), radians(-15.0), 0.0});
    rig.fly(armed(AttitudeSetpoint{.q_WB = target, .thrust = 0.657}), 0.5);
    EXPECT_LT(degrees(rig.truth.q_WF.angularDistance(target)), 2.0);
    rig.fly(armed(AttitudeSetpoint{.q_WB = target, .thrust = 0.657}), 3.0);
    EXPECT_LT(degrees(rig.truth.q_WF.angularDistance(target)), 0.5);
}

/// Perched attitudes: the thrust axis is near the horizontal, Euler angles are of no use.
TEST(Flight, HoldsSteepPitch) {
    for (const double pitch_deg : {66.5, 85.0, 90.0}) {
        FlightRig rig({}, 1.0, attitude(0.0, pitch_deg, 30.0));
        const Quaternion target = rig.truth.q_WF;
        for (int i = 0; i < 30; ++i) {
            rig.fly(armed(AttitudeSetpoint{.q_WB = target, .thrust = 0.4}), 0.1);
            ASSERT_LT(degrees(rig.truth.q_WF.angularDistance(target)), 3.0) << pitch_deg;
        }
        EXPECT_LT(degrees(rig.autopilot.estimate.q_WB.angularDistance(rig.truth.q_WF)), 0.3);
    }
}

TEST(Flight, LevelsFromSteepPitch) {
    FlightRig rig({}, 0.0, attitude(0.0, 85.0, 0.0));
    rig.fly(armed(AttitudeSetpoint{.thrust = 0.657}), 2.0);
    EXPECT_LT(tilt_deg(rig.truth.q_WF), 1.0);
}

TEST(Flight, TiltGoesBeforeHeading) {
    FlightRig rig({}, 0.0, attitude(30.0, 0.0, 0.0));
    const Quaternion target = quaternion_from_euler({0.0, 0.0, radians(170.0)});
    rig.fly(armed(AttitudeSetpoint{.q_WB = target, .thrust = 0.657}), 0.6);
    EXPECT_LT(tilt_deg(rig.truth.q_WF), 5.0);
    EXPECT_LT(yaw_deg(rig), 120.0);  // still far away
    EXPECT_GT(yaw_deg(rig), 10.0);   // but on the way
    rig.fly(armed(AttitudeSetpoint{.q_WB = target, .thrust = 0.657}), 12.0);
    EXPECT_NEAR(yaw_deg(rig), 170.0, 1.0);
}

TEST(Flight, IntegratorTakesOutASteadyPush) {
    FlightRig rig;
    rig.push_W_N = {2.0, 0.0, 1.5};
    rig.fly(armed(PositionSetpoint{}), 40.0);
    EXPECT_LT(rig.truth.p_WF_m.norm(), 0.02);
    EXPECT_NEAR(rig.autopilot.position.integral_m_s2.x(), -2.0 / FlightRig::kMass_kg, 0.05);
}

/// A setpoint far away keeps velocity saturated for seconds; the integrator must not remember it.
TEST(Flight, LongSaturationDoesNotWindUp) {
    AutopilotParameters parameters;
    parameters.MPC_TILTMAX_AIR = 10.0;
    FlightRig rig(parameters);
    double furthest_m = 0.0;
    for (int i = 0; i < 300; ++i) {
        rig.fly(armed(PositionSetpoint{.p_W_m = {20.0, 0.0, 0.0}}), 0.1);
        furthest_m = std::max(furthest_m, rig.truth.p_WF_m.x());
    }
    EXPECT_LT(furthest_m, 24.0);
    EXPECT_NEAR(rig.truth.p_WF_m.x(), 20.0, 0.2);
}

TEST(Flight, HeldIntegratorsKeepTheirValue) {
    FlightRig rig;
    rig.push_W_N = {2.0, 0.0, 0.0};
    rig.fly(armed(PositionSetpoint{}), 5.0);
    const Vector3 velocity = rig.autopilot.position.integral_m_s2;
    const Vector3 rate = rig.autopilot.rate.integral;
    ASSERT_GT(velocity.norm(), 0.1);
    rig.push_W_N = {-10.0, 3.0, 5.0};
    Setpoint held = armed(PositionSetpoint{.p_W_m = {1.0, 0.0, 0.0}});
    held.hold_integrators = true;
    rig.fly(held, 0.5);
    EXPECT_EQ(rig.autopilot.position.integral_m_s2, velocity);
    EXPECT_EQ(rig.autopilot.rate.integral, rate);
    held.hold_integrators = false;
    rig.fly(held, 0.5);
    EXPECT_NE(rig.autopilot.position.integral_m_s2, velocity);
}

TEST(Flight, DisarmingStopsRotorsAndForgetsIntegrators) {
    FlightRig rig;
    rig.push_W_N = {2.0, 0.0, 0.0};
    rig.fly(armed(PositionSetpoint{}), 3.0);
    ASSERT_GT(rig.autopilot.position.integral_m_s2.norm(), 0.1);
    rig.fly(Setpoint{.motion = PositionSetpoint{}, .armed = false}, 0.3);
    EXPECT_FALSE(rig.command.armed);
    for (const double command : rig.command.command) {
        EXPECT_EQ(command, 0.0);
    }
    EXPECT_LT(rig.speed_rad_s[0], 1.0);
    EXPECT_EQ(rig.autopilot.position.integral_m_s2, Vector3::Zero());
    EXPECT_EQ(rig.autopilot.rate.integral, Vector3::Zero());
}

TEST(Flight, IdleIsArmedWithoutControl) {
    FlightRig rig({}, 0.0, attitude(10.0, 0.0, 0.0));
    rig.fly(armed(IdleSetpoint{}), 0.3);
    EXPECT_TRUE(rig.command.armed);
    for (const double speed : rig.speed_rad_s) {
        EXPECT_NEAR(speed, 100.0, 0.1);
    }
}

/// Every kind of setpoint after every other, in a steady push: no kind may throw the next one off.
TEST(Flight, EveryChangeOfSetpointIsSmooth) {
    const std::vector<Setpoint> kinds = {armed(PositionSetpoint{}), armed(VelocitySetpoint{}),
                                         armed(AttitudeSetpoint{.thrust = 0.657}),
                                         armed(IdleSetpoint{}), Setpoint{}};
    for (std::size_t from = 0; from < kinds.size(); ++from) {
        for (std::size_t to = 0; to < kinds.size(); ++to) {
            FlightRig rig({}, 1.0);
            rig.push_W_N = {0.5, 0.0, 0.0};
            rig.fly(armed(PositionSetpoint{}), 2.0);
            rig.fly(kinds[from], 0.2);
            rig.fly(kinds[to], 0.2);
            EXPECT_LT(rig.truth.w_WF_F_rad_s.norm(), 0.3) << from << " to " << to;
            rig.fly(armed(PositionSetpoint{}), 0.4);
            EXPECT_LT(rig.truth.w_WF_F_rad_s.norm(), 1.5) << from << " to " << to;
            rig.fly(armed(PositionSetpoint{}), 12.0);
            EXPECT_LT(rig.truth.p_WF_m.norm(), 0.1) << from << " to " << to;
        }
    }
}

TEST(Flight, PositionToVelocityIsBumpless) {
    FlightRig rig;
    rig.push_W_N = {3.0, 0.0, 0.0};
    rig.fly(armed(PositionSetpoint{}), 20.0);
    const double before_deg = tilt_deg(rig.autopilot.attitude_target.q_WB);
    ASSERT_GT(before_deg, 4.0);
    rig.fly(armed(VelocitySetpoint{}), 0.004);
    EXPECT_NEAR(tilt_deg(rig.autopilot.attitude_target.q_WB), before_deg, 0.1);
}

TEST(Flight, SavedStateGoesOnAlike) {
    FlightRig rig({}, 1.0);
    rig.fly(armed(PositionSetpoint{.p_W_m = {0.5, 0.0, 0.0}}), 1.0);
    FlightRig copy = rig;
    rig.fly(armed(PositionSetpoint{}), 1.0);
    copy.fly(armed(PositionSetpoint{}), 1.0);
    EXPECT_EQ(rig.truth.p_WF_m, copy.truth.p_WF_m);
    EXPECT_EQ(rig.command.command, copy.command.command);
    EXPECT_EQ(rig.autopilot.estimator.covariance, copy.autopilot.estimator.covariance);
}

}  // namespace
}  // namespace limpet::autopilot
