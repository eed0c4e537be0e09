// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/translate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limpet::mavlink {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const Quaternion kQuarterTurn = quaternion_from_euler({0.0, 0.0, 0.5 * kPi});

Readings all_readings() {
    Readings readings;
    readings.imu = {.time_s = 2.0,
                    .value = {.specific_force_B_m_s2 = {0.5, -0.25, -9.75},
                              .rate_B_rad_s = {0.125, -0.5, 0.75}}};
    readings.magnetometer = {.time_s = 1.5, .value = {.field_B_gauss = {0.25, -0.125, 0.5}}};
    readings.barometer = {.time_s = 1.0, .value = {.pressure_Pa = 101300.0, .altitude_m = 2.0}};
    return readings;
}

TEST(HilSensorMessage, CarriesSiInTheUnitsOfTheWire) {
    const HilSensor message = hil_sensor(all_readings(), {}, 4000);
    EXPECT_EQ(message.time_usec, 4000U);
    EXPECT_EQ(message.zacc, -9.75F);
    EXPECT_EQ(message.ygyro, -0.5F);
    EXPECT_EQ(message.xmag, 0.25F);
    EXPECT_EQ(message.abs_pressure, 1013.0F);
    EXPECT_EQ(message.pressure_alt, 2.0F);
    EXPECT_EQ(message.id, 0);
    EXPECT_EQ(message.fields_updated, 0x7U | 0x38U | 0x1C0U | 0x1A00U);
}

TEST(HilSensorMessage, MarksOnlyWhatIsNew) {
    Readings last = all_readings();
    EXPECT_EQ(hil_sensor(last, last, 1).fields_updated, 0U);
    Readings now = last;
    now.imu.time_s += 0.004;
    EXPECT_EQ(hil_sensor(now, last, 1).fields_updated, 0x3FU);
    now.magnetometer.time_s += 0.01;
    EXPECT_EQ(hil_sensor(now, last, 1).fields_updated, 0x1FFU);
}

TEST(HilSensorMessage, ComesBackAsReadings) {
    Readings heard;
    take(hil_sensor(all_readings(), {}, 4000), 0.004, heard);
    EXPECT_EQ(heard.imu.time_s, 0.004);
    EXPECT_EQ(heard.imu.value.specific_force_B_m_s2, Vector3(0.5, -0.25, -9.75));
    EXPECT_EQ(heard.imu.value.rate_B_rad_s, Vector3(0.125, -0.5, 0.75));
    EXPECT_EQ(heard.magnetometer.value.field_B_gauss, Vector3(0.25, -0.125, 0.5));
    EXPECT_EQ(heard.barometer.value.pressure_Pa, 101300.0);
    HilSensor nothing_new = hil_sensor(all_readings(), all_readings(), 8000);
    take(nothing_new, 0.008, heard);
    EXPECT_EQ(heard.imu.time_s, 0.004);
    EXPECT_EQ(heard.barometer.time_s, 0.004);
}

TEST(HilGpsMessage, IsWhereTheHandSays) {
    // a degree is pi / 180 x 6371 km = 111194.927 m; east it shrinks by the cosine of the latitude
    const GeographicOrigin origin{.latitude_deg = 60.0, .longitude_deg = 10.0, .altitude_m = 5.0};
    const HilGps message = hil_gps(
        {.p_WB_m = {11.1194927, 5.55974635, -2.0}, .v_WB_m_s = {3.0, -4.0, 0.5}}, origin, 7);
    EXPECT_NEAR(message.lat, 600001000, 1);
    EXPECT_NEAR(message.lon, 100001000, 1);
    EXPECT_EQ(message.alt, 7000);
    EXPECT_EQ(message.vel, 500);
    EXPECT_EQ(message.vn, 300);
    EXPECT_EQ(message.ve, -400);
    EXPECT_EQ(message.vd, 50);
    EXPECT_EQ(message.cog, 30687);  // 360 - atan(4/3) = 306.87 deg
    EXPECT_EQ(message.fix_type, 3);
    EXPECT_LT(message.eph, 300);  // [cm]; PX4 wants less than 3 m and 5 m
    EXPECT_LT(message.epv, 500);
}

TEST(HilGpsMessage, AStandingVehicleHasNoCourse) {
    EXPECT_EQ(hil_gps({}, {}, 1).cog, 65535);
    EXPECT_EQ(hil_gps({.v_WB_m_s = {1.0, -1e-6, 0.0}}, {}, 1).cog, 0);
}

TEST(HilGpsMessage, ComesBackWithinItsResolution) {
    for (const Vector3& p_W_m :
         {Vector3(0.0, 0.0, 0.0), Vector3(3.0, -4.0, -1.5), Vector3(900.0, 1200.0, -300.0)}) {
        const auto gps =
            gps_reading(hil_gps({.p_WB_m = p_W_m, .v_WB_m_s = {0.1, 0.2, -0.3}}, {}, 1), {});
        ASSERT_TRUE(gps);
        EXPECT_LT((gps->p_WB_m - p_W_m).norm(), 0.01);  // half of 1e-7 deg is 5.6 mm
        EXPECT_LT((gps->v_WB_m_s - Vector3(0.1, 0.2, -0.3)).norm(), 1e-9);
    }
    HilGps no_fix;
    no_fix.fix_type = 2;
    EXPECT_FALSE(gps_reading(no_fix, {}));
}

TEST(HilActuatorControlsMessage, HoldsMotorsToTheirRange) {
    HilActuatorControls message;
    message.controls = {0.25F, 1.5F, -0.5F, kNaN};
    message.mode = 129;
    const RotorCommand command = rotor_command(message);
    EXPECT_TRUE(command.armed);
    EXPECT_EQ(command.command.size(), kMaxRotors);
    EXPECT_EQ(command.command[0], 0.25);
    EXPECT_EQ(command.command[1], 1.0);
    EXPECT_EQ(command.command[2], 0.0);
    EXPECT_EQ(command.command[3], 0.0);
    message.mode = 1;
    EXPECT_FALSE(rotor_command(message).armed);
}

TEST(HilActuatorControlsMessage, SaysZeroWhenDisarmed) {
    RotorCommand command{.command = {0.5, 0.5, 0.25, 1.0}, .armed = false};
    HilActuatorControls message = hil_actuator_controls(command, 8000);
    EXPECT_EQ(message.controls, (std::array<float, 16>{}));
    EXPECT_EQ(message.mode, 1);
    EXPECT_EQ(message.flags, 1U);
    EXPECT_EQ(message.time_usec, 8000U);
    command.armed = true;
    message = hil_actuator_controls(command, 8000);
    EXPECT_EQ(message.mode, 129);
    RotorList<double> told = rotor_command(message).command;
    told.resize(4);
    EXPECT_EQ(told, command.command);
}

TEST(OdometryOfAPose, IsVisionInNedWithUnknownCovariance) {
    const Odometry message =
        odometry(PoseReading{.p_WB_m = {1.0, -2.0, -1.5}, .q_WB = kQuarterTurn}, 123456);
    EXPECT_EQ(message.time_usec, 123456U);
    EXPECT_EQ(message.frame_id, 1);
    EXPECT_EQ(message.child_frame_id, 12);
    EXPECT_EQ(message.estimator_type, 2);
    EXPECT_EQ(message.y, -2.0F);
    EXPECT_NEAR(message.q[0], std::sqrt(0.5), 1e-7);
    EXPECT_NEAR(message.q[3], std::sqrt(0.5), 1e-7);
    EXPECT_TRUE(std::isnan(message.pose_covariance[0]));
    EXPECT_TRUE(std::isnan(message.velocity_covariance[0]));
    EXPECT_TRUE(std::isnan(message.vx));
    const auto pose = pose_reading(message);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->p_WB_m, Vector3(1.0, -2.0, -1.5));
    EXPECT_LT(pose->q_WB.angularDistance(kQuarterTurn), 1e-6);
}

TEST(OdometryOfAPose, IsRefusedWhereEkf2WouldNotUseIt) {
    const Odometry good = odometry(PoseReading{}, 1);
    ASSERT_TRUE(pose_reading(good));
    Odometry bad = good;
    bad.estimator_type = 6;  // motion capture by its name: PX4 ignores it
    EXPECT_FALSE(pose_reading(bad));
    bad = good;
    bad.frame_id = 20;
    EXPECT_FALSE(pose_reading(bad));
    bad = good;
    bad.child_frame_id = 8;
    EXPECT_FALSE(pose_reading(bad));
    bad = good;
    bad.z = kNaN;
    EXPECT_FALSE(pose_reading(bad));
    bad = good;
    bad.q = {};
    EXPECT_FALSE(pose_reading(bad));
    bad.q = {1.0F, kNaN, 0.0F, 0.0F};
    EXPECT_FALSE(pose_reading(bad));
}

Estimate some_estimate() {
    Estimate estimate;
    estimate.time_s = 3.0;
    estimate.p_WB_m = {1.0, 2.0, -3.0};
    estimate.v_WB_m_s = {0.5, -0.25, 0.125};
    estimate.q_WB = kQuarterTurn;
    estimate.w_WB_B_rad_s = {0.25, 0.5, -1.0};
    for (std::size_t i = 0; i < 9; ++i) {
        estimate.variance[i] = static_cast<double>(i + 1);
    }
    estimate.valid = true;
    return estimate;
}

TEST(OdometryOfAnEstimate, ComesBack) {
    const Odometry message = odometry(some_estimate(), 3'000'000);
    // rows of a 6 x 6 upper right half: its diagonal lies at 0, 6, 11, 15, 18, 20
    EXPECT_EQ(message.pose_covariance[11], 3.0F);
    EXPECT_EQ(message.pose_covariance[20], 9.0F);
    EXPECT_EQ(message.velocity_covariance[6], 5.0F);
    const auto back = estimate_from(message);
    ASSERT_TRUE(back);
    EXPECT_DOUBLE_EQ(back->time_s, 3.0);
    EXPECT_EQ(back->p_WB_m, some_estimate().p_WB_m);
    EXPECT_EQ(back->v_WB_m_s, some_estimate().v_WB_m_s);
    EXPECT_EQ(back->w_WB_B_rad_s, some_estimate().w_WB_B_rad_s);
    EXPECT_EQ(back->variance, some_estimate().variance);
    EXPECT_TRUE(back->valid);
}

TEST(OdometryOfAnEstimate, VelocityInTheBodyIsTurnedAndRatesAreNot) {
    Odometry message = odometry(some_estimate(), 1);
    message.child_frame_id = 12;
    message.vx = 2.0F;  // forward; the nose points east
    message.vy = message.vz = 0.0F;
    const auto estimate = estimate_from(message);
    ASSERT_TRUE(estimate);
    EXPECT_LT((estimate->v_WB_m_s - Vector3(0.0, 2.0, 0.0)).norm(), 1e-6);
    EXPECT_EQ(estimate->w_WB_B_rad_s, Vector3(0.25, 0.5, -1.0));
}

TEST(OdometryOfAnEstimate, UnknownVarianceIsZeroAndAFailedOneNotValid) {
    Odometry message = odometry(some_estimate(), 1);
    message.pose_covariance[0] = kNaN;
    message.quality = -1;
    const auto estimate = estimate_from(message);
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->variance[0], 0.0);
    EXPECT_FALSE(estimate->valid);
    Estimate lost = some_estimate();
    lost.valid = false;
    EXPECT_FALSE(estimate_from(odometry(lost, 1))->valid);
}

TEST(OdometryOfAnEstimate, WrongFramesAndNaNAreRefused) {
    const Odometry good = odometry(some_estimate(), 1);
    for (const auto spoil :
         {+[](Odometry& m) { m.frame_id = 20; }, +[](Odometry& m) { m.child_frame_id = 20; },
          +[](Odometry& m) { m.x = kNaN; }, +[](Odometry& m) { m.vz = kNaN; },
          +[](Odometry& m) { m.yawspeed = kNaN; }, +[](Odometry& m) { m.q[2] = kNaN; }}) {
        Odometry bad = good;
        spoil(bad);
        EXPECT_FALSE(estimate_from(bad));
    }
}

TEST(SetPoints, PositionGoesAndComes) {
    PositionSetpoint target{.p_W_m = {1.5, -2.5, -3.0}, .yaw_rad = 0.25};
    SetPositionTargetLocalNed message = position_target(target, 42);
    EXPECT_EQ(message.type_mask, 0x9F8);
    EXPECT_EQ(message.coordinate_frame, 1);
    EXPECT_EQ(message.time_boot_ms, 42U);
    EXPECT_EQ(position_set_point(message)->p_W_m, target.p_W_m);
    EXPECT_EQ(position_set_point(message)->yaw_rad, 0.25);
    EXPECT_FALSE(velocity_set_point(message));
    target.feedforward_v_W_m_s = {0.5, 0.0, -0.25};
    message = position_target(target, 42);
    EXPECT_EQ(message.type_mask, 0x9C0);
    EXPECT_EQ(position_set_point(message)->feedforward_v_W_m_s, target.feedforward_v_W_m_s);
}

TEST(SetPoints, VelocityGoesAndComes) {
    VelocitySetpoint target{.v_W_m_s = {0.5, 0.0, -0.25}, .yaw_rad = -0.5};
    SetPositionTargetLocalNed message = position_target(target, 1);
    EXPECT_EQ(message.type_mask, 0x9C7);
    EXPECT_EQ(velocity_set_point(message)->v_W_m_s, target.v_W_m_s);
    EXPECT_EQ(velocity_set_point(message)->yaw_rad, -0.5);
    EXPECT_FALSE(position_set_point(message));
    target.feedforward_a_W_m_s2 = {1.0, 2.0, -3.0};
    message = position_target(target, 1);
    EXPECT_EQ(message.type_mask, 0x807);
    EXPECT_EQ(velocity_set_point(message)->feedforward_a_W_m_s2, target.feedforward_a_W_m_s2);
}

TEST(SetPoints, AttitudeGoesAndComes) {
    const AttitudeSetpoint target{.q_WB = kQuarterTurn, .thrust = 0.625};
    SetAttitudeTarget message = attitude_target(target, 1);
    EXPECT_EQ(message.type_mask, 7);
    const auto back = attitude_set_point(message);
    ASSERT_TRUE(back);
    EXPECT_LT(back->q_WB.angularDistance(kQuarterTurn), 1e-6);
    EXPECT_EQ(back->thrust, 0.625);
    message.type_mask = 128;  // rates
    EXPECT_FALSE(attitude_set_point(message));
}

TEST(SetPoints, OtherMasksFramesAndNaNAreRefused) {
    SetPositionTargetLocalNed position = position_target(PositionSetpoint{}, 1);
    position.type_mask = 0xDF8;  // no yaw
    EXPECT_FALSE(position_set_point(position));
    position = position_target(PositionSetpoint{}, 1);
    position.coordinate_frame = 8;  // MAV_FRAME_BODY_NED
    EXPECT_FALSE(position_set_point(position));
    position = position_target(PositionSetpoint{}, 1);
    position.x = kNaN;
    EXPECT_FALSE(position_set_point(position));
    SetPositionTargetLocalNed velocity = position_target(VelocitySetpoint{}, 1);
    velocity.yaw = kNaN;
    EXPECT_FALSE(velocity_set_point(velocity));
    SetAttitudeTarget attitude = attitude_target(AttitudeSetpoint{}, 1);
    attitude.thrust = kNaN;
    EXPECT_FALSE(attitude_set_point(attitude));
    attitude = attitude_target(AttitudeSetpoint{}, 1);
    attitude.q = {};
    EXPECT_FALSE(attitude_set_point(attitude));
}

TEST(DistanceSensorMessage, IsInCentimetresAndZeroIsNoEcho) {
    DistanceSensor message = distance_sensor({.distance_m = 1.234, .valid = true}, 1, 0.1, 12.0, 9);
    EXPECT_EQ(message.current_distance, 123);
    EXPECT_EQ(message.min_distance, 10);
    EXPECT_EQ(message.max_distance, 1200);
    EXPECT_EQ(message.orientation, 0);
    EXPECT_EQ(message.id, 1);
    EXPECT_TRUE(range_reading(message).valid);
    EXPECT_DOUBLE_EQ(range_reading(message).distance_m, 1.23);
    message = distance_sensor({.distance_m = 1.234, .valid = false}, 1, 0.1, 12.0, 9);
    EXPECT_EQ(message.current_distance, 0);
    EXPECT_FALSE(range_reading(message).valid);
    message.current_distance = 1201;
    EXPECT_FALSE(range_reading(message).valid);
    message.current_distance = 9;
    EXPECT_FALSE(range_reading(message).valid);
}

TEST(CustomMode, IsPx4s) {
    EXPECT_EQ(custom_mode(kMainModeOffboard), 0x00060000U);
    EXPECT_EQ(custom_mode(kMainModeAuto, kSubModeLoiter), 0x03040000U);
    EXPECT_EQ(main_mode(0x03040000U), kMainModeAuto);
}

}  // namespace
}  // namespace limpet::mavlink
