// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

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
inline constexpr std::uint8_t kArmedFlag = 128;  ///< of a heartbeat's base_mode

/// MAV_CMD
inline constexpr std::uint16_t kCommandSetMode = 176;
inline constexpr std::uint16_t kCommandArm = 400;
inline constexpr std::uint16_t kCommandMessageInterval = 511;
inline constexpr float kForce = 21196.0F;  ///< second parameter of arming: without asking

/// Where on earth the origin of W is: PX4's home in simulation, near Zurich. A flight on motion
/// capture has no place; the wire wants one.
struct GeographicOrigin {
    double latitude_deg = 47.397742;
    double longitude_deg = 8.545594;
    double altitude_m = 0.0;  ///< above sea
};

/// @param readings  a sample younger than `last` is marked as updated in `fields_updated`
[[nodiscard]] HilSensor hil_sensor(const Readings& readings, const Readings& last,
                                   std::uint64_t time_usec);
[[nodiscard]] HilGps hil_gps(const GpsReading& gps, const GeographicOrigin& origin,
                             std::uint64_t time_usec);
[[nodiscard]] RotorCommand rotor_command(const HilActuatorControls& controls);

/// A pose for PX4's EKF2: visual odometry in NED, covariance unknown (its own parameters count).
[[nodiscard]] Odometry odometry(const PoseReading& pose, std::uint64_t time_usec);
/// @return nothing when the frames are not those that EKF2 tells or a number is not finite
[[nodiscard]] std::optional<PoseReading> pose_reading(const Odometry& odometry);
/// PX4's own estimate: pose, velocity in W or B as child_frame_id says, rates, covariance.
/// @return nothing as pose_reading
[[nodiscard]] std::optional<Estimate> estimate_from(const Odometry& odometry);
[[nodiscard]] Odometry odometry(const Estimate& estimate, std::uint64_t time_usec);

[[nodiscard]] SetPositionTargetLocalNed position_target(const PositionSetpoint& target,
                                                        std::uint32_t time_boot_ms);
[[nodiscard]] SetPositionTargetLocalNed position_target(const VelocitySetpoint& target,
                                                        std::uint32_t time_boot_ms);
[[nodiscard]] SetAttitudeTarget attitude_target(const AttitudeSetpoint& target,
                                                std::uint32_t time_boot_ms);
/// The other way, as the stand-in flight controller hears it.
/// @return nothing for masks that Limpet does not fly
[[nodiscard]] std::optional<PositionSetpoint> position_set_point(
    const SetPositionTargetLocalNed& message);
[[nodiscard]] std::optional<VelocitySetpoint> velocity_set_point(
    const SetPositionTargetLocalNed& message);
[[nodiscard]] std::optional<AttitudeSetpoint> attitude_set_point(const SetAttitudeTarget& message);

/// LiDARs: id 0 left, 1 right, orientation forward; 0 cm means no echo.
[[nodiscard]] DistanceSensor distance_sensor(const RangeReading& range, std::uint8_t id,
                                             double minimum_m, double maximum_m,
                                             std::uint32_t time_boot_ms);
[[nodiscard]] RangeReading range_reading(const DistanceSensor& message);

/// Names of NAMED_VALUE_FLOAT between companion, sensors and mechanism.
inline constexpr std::string_view kForceName = "cup_force";     ///< [N], tension positive
inline constexpr std::string_view kPressureName = "cup_press";  ///< [hPa], absolute

}  // namespace limpet::mavlink
