// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "limpet/core/frames.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/mavlink/messages.hpp"

/// Signals to messages and back; pure functions. The wire is NED and FRD as we are.
namespace limpet::mavlink {

/// PX4's custom modes: main in bits 16..23, sub in bits 24..31.
inline constexpr std::uint8_t kMainModeAuto = 4;
inline constexpr std::uint8_t kMainModeOffboard = 6;
inline constexpr std::uint8_t kSubModeLoiter = 3;
[[nodiscard]] constexpr std::uint32_t custom_mode(std::uint8_t main, std::uint8_t sub = 0) {
    return static_cast<std::uint32_t>(main) << 16U | static_cast<std::uint32_t>(sub) << 24U;
}
[[nodiscard]] constexpr std::uint8_t main_mode(std::uint32_t custom_mode) {
    return static_cast<std::uint8_t>(custom_mode >> 16U);
}

inline constexpr float kForce = 21196.0F;  ///< second parameter of arming: without checks

/// Where on earth the origin of W is: PX4's home in simulation, near Zurich. A flight on motion
/// capture has no place; the wire wants one.
struct GeographicOrigin {
    double latitude_deg = 47.397742;  ///< -89..89
    double longitude_deg = 8.545594;
    double altitude_m = 0.0;  ///< above sea
};
/// @return latitude, longitude [deg] and altitude above sea [m] of a point
[[nodiscard]] GeographicOrigin geographic(const Vector3& p_W_m, const GeographicOrigin& origin);
/// As messages carry it: [1e-7 deg], [mm].
void put(const GeographicOrigin& place, std::int32_t& latitude, std::int32_t& longitude,
         std::int32_t& altitude);

/// HIL_SENSOR::fields_updated
inline constexpr std::uint32_t kImuFields =
    HilSensorUpdatedFlags::xacc | HilSensorUpdatedFlags::yacc | HilSensorUpdatedFlags::zacc |
    HilSensorUpdatedFlags::xgyro | HilSensorUpdatedFlags::ygyro | HilSensorUpdatedFlags::zgyro;
inline constexpr std::uint32_t kMagnetometerFields =
    HilSensorUpdatedFlags::xmag | HilSensorUpdatedFlags::ymag | HilSensorUpdatedFlags::zmag;
inline constexpr std::uint32_t kBarometerFields = HilSensorUpdatedFlags::abs_pressure |
                                                  HilSensorUpdatedFlags::pressure_alt |
                                                  HilSensorUpdatedFlags::temperature;

/// Fields whose samples have not changed keep their last value.
/// @param readings  a sample younger than that in `last` is marked in `fields_updated`
[[nodiscard]] HilSensor hil_sensor(const Readings& readings, const Readings& last,
                                   std::uint64_t time_usec);
/// The other way: what `fields_updated` names becomes a new sample of `readings`.
void take(const HilSensor& message, double time_s, Readings& readings);

/// Azimuthal equidistant projection on a sphere, as PX4 undoes it. Source: PX4, lib/geo; units:
/// px4.md "Simulator link". Quantised to 1e-7 deg (11 mm), mm and cm/s.
[[nodiscard]] HilGps hil_gps(const GpsReading& gps, const GeographicOrigin& origin,
                             std::uint64_t time_usec);
/// @return nothing without a 3D fix
[[nodiscard]] std::optional<GpsReading> gps_reading(const HilGps& message,
                                                    const GeographicOrigin& origin);
/// Of kMaxRotors motors, as the wire has no number. What is not finite counts as 0; motors are held
/// to 0..1.
[[nodiscard]] RotorCommand rotor_command(const HilActuatorControls& controls);
/// Motors that are not armed get 0, as PX4 does. Says "lockstep" (flags 1).
[[nodiscard]] HilActuatorControls hil_actuator_controls(const RotorCommand& command,
                                                        std::uint64_t time_usec);

/// A pose for PX4's EKF2: visual odometry in NED, covariance unknown (its own parameters count).
[[nodiscard]] Odometry odometry(const PoseReading& pose, std::uint64_t time_usec);
/// @return nothing where EKF2 would use nothing: another estimator_type than vision, other frames
///         than NED and FRD, a pose that is not finite or a quaternion without length
[[nodiscard]] std::string_view why_no_pose(const Odometry& odometry);
[[nodiscard]] std::optional<PoseReading> pose_reading(const Odometry& odometry);
/// An autopilot's own estimate: pose, velocity in W or B as child_frame_id says, rates in B always,
/// diagonal of the covariance (0 where unknown). Not valid when its quality says that it failed.
/// @return nothing for other frames than NED with NED or FRD, or when a number is not finite
[[nodiscard]] std::optional<Estimate> estimate_from(const Odometry& odometry);
/// As PX4 v1.15 sends it: velocity in W. Quality 100, or -1 when not valid.
[[nodiscard]] Odometry odometry(const Estimate& estimate, std::uint64_t time_usec);

/// SET_POSITION_TARGET_LOCAL_NED::type_mask, a bit set: ignored. Source: px4.md "Offboard"
namespace ignored {
inline constexpr std::uint16_t kPosition = PositionTargetTypemask::x_ignore |
                                           PositionTargetTypemask::y_ignore |
                                           PositionTargetTypemask::z_ignore;
inline constexpr std::uint16_t kVelocity = PositionTargetTypemask::vx_ignore |
                                           PositionTargetTypemask::vy_ignore |
                                           PositionTargetTypemask::vz_ignore;
inline constexpr std::uint16_t kAcceleration = PositionTargetTypemask::ax_ignore |
                                               PositionTargetTypemask::ay_ignore |
                                               PositionTargetTypemask::az_ignore;
inline constexpr std::uint16_t kYawRate = PositionTargetTypemask::yaw_rate_ignore;
}  // namespace ignored
inline constexpr std::uint16_t kPositionYaw =
    ignored::kVelocity | ignored::kAcceleration | ignored::kYawRate;
inline constexpr std::uint16_t kPositionVelocityYaw = ignored::kAcceleration | ignored::kYawRate;
inline constexpr std::uint16_t kVelocityYaw =
    ignored::kPosition | ignored::kAcceleration | ignored::kYawRate;
inline constexpr std::uint16_t kVelocityAccelerationYaw = ignored::kPosition | ignored::kYawRate;
/// SET_ATTITUDE_TARGET::type_mask: quaternion and thrust
inline constexpr std::uint8_t kAttitudeThrust = AttitudeTargetTypemask::body_roll_rate_ignore |
                                                AttitudeTargetTypemask::body_pitch_rate_ignore |
                                                AttitudeTargetTypemask::body_yaw_rate_ignore;

/// A feed-forward of zero is not sent: the mask leaves it out.
[[nodiscard]] SetPositionTargetLocalNed position_target(const PositionSetpoint& target,
                                                        std::uint32_t time_boot_ms);
[[nodiscard]] SetPositionTargetLocalNed position_target(const VelocitySetpoint& target,
                                                        std::uint32_t time_boot_ms);
[[nodiscard]] SetAttitudeTarget attitude_target(const AttitudeSetpoint& target,
                                                std::uint32_t time_boot_ms);
/// The other way, as the stand-in flight controller receives it.
/// @return nothing for masks and frames that Limpet does not fly, or numbers that are not finite
[[nodiscard]] std::optional<PositionSetpoint> position_set_point(
    const SetPositionTargetLocalNed& message);
[[nodiscard]] std::optional<VelocitySetpoint> velocity_set_point(
    const SetPositionTargetLocalNed& message);
[[nodiscard]] std::optional<AttitudeSetpoint> attitude_set_point(const SetAttitudeTarget& message);

/// LiDARs: id 0 left, 1 right, orientation forward; 0 cm means no echo. In whole centimetres.
[[nodiscard]] DistanceSensor distance_sensor(const RangeReading& range, std::uint8_t id,
                                             double minimum_m, double maximum_m,
                                             std::uint32_t time_boot_ms);
/// Valid within the message's own limits.
[[nodiscard]] RangeReading range_reading(const DistanceSensor& message);

/// Names of NAMED_VALUE_FLOAT between companion, sensors and mechanism.
inline constexpr std::string_view kForceName = "cup_force";     ///< [N], tension positive
inline constexpr std::string_view kPressureName = "cup_press";  ///< [hPa], absolute

}  // namespace limpet::mavlink
