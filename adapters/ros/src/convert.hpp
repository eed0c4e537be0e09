// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <limpet_ros/AttitudeTarget.h>
#include <limpet_ros/CupContact.h>
#include <limpet_ros/CupState.h>
#include <limpet_ros/PerchingEvent.h>
#include <limpet_ros/PositionTarget.h>
#include <ros/time.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>

#include <optional>
#include <string_view>
#include <variant>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/suction/cup.hpp"

/// Our signals as ROS messages and back: the one place in adapters/ros/ where axes turn (REP 103, REP 105).
/// Ours are north-east-down and forward-right-down, ROS's east-north-up ("map") and
/// forward-left-up ("base_link"); the turns themselves are those of limpet/record/ros_frames.hpp.
///
/// What comes in is checked: a message with a number that is none, or a quaternion that is no
/// rotation, is nothing.
namespace limpet::ros {

/// @param time_s  >= 0
[[nodiscard]] ::ros::Time ros_time(double time_s);

// --- the autopilot's estimate -------------------------------------------------------------------

/// mavros/local_position/pose: B in W.
[[nodiscard]] geometry_msgs::PoseStamped pose_message(const Estimate& estimate);
[[nodiscard]] std::optional<PoseReading> pose_reading(const geometry_msgs::PoseStamped& message);
/// mavros/local_position/velocity_local: velocity and angular velocity, both along the axes of W.
[[nodiscard]] geometry_msgs::TwistStamped velocity_message(const Estimate& estimate);
/// @return v_WB [m/s]; the angular velocity is not read
[[nodiscard]] std::optional<Vector3> velocity_W(const geometry_msgs::TwistStamped& message);
/// mavros/imu/data: attitude, angular velocity and specific force, less their biases, along B.
[[nodiscard]] sensor_msgs::Imu imu_message(const Estimate& estimate);
/// @return w_WB_B [rad/s]
[[nodiscard]] std::optional<Vector3> rate_B(const sensor_msgs::Imu& message);

// --- sensors of the mechanism -------------------------------------------------------------------

/// Out of range, or no echo: +infinity (REP 117).
/// @param frame  whose x is the beam
[[nodiscard]] sensor_msgs::Range range_message(const RangeReading& reading, std::string_view frame,
                                               double minimum_m, double maximum_m);
[[nodiscard]] std::optional<RangeReading> range_reading(const sensor_msgs::Range& message);
/// x of the wrench is the force through the slider, along whose axis "carriage" has its x: positive
/// in tension.
[[nodiscard]] geometry_msgs::WrenchStamped force_message(const ForceReading& reading);
[[nodiscard]] std::optional<ForceReading> force_reading(
    const geometry_msgs::WrenchStamped& message);
[[nodiscard]] sensor_msgs::FluidPressure pressure_message(const PressureReading& reading);
[[nodiscard]] std::optional<PressureReading> pressure_reading(
    const sensor_msgs::FluidPressure& message);
/// A battery that gives current has a negative one there.
[[nodiscard]] sensor_msgs::BatteryState battery_message(const BatteryReading& reading);
[[nodiscard]] std::optional<BatteryReading> battery_reading(
    const sensor_msgs::BatteryState& message);

// --- set-points ---------------------------------------------------------------------------------

using Motion = decltype(Setpoint::motion);

/// mavros/setpoint_raw/local; of a position its velocity, of a velocity its acceleration, if any.
[[nodiscard]] limpet_ros::PositionTarget target_message(const PositionSetpoint& target);
[[nodiscard]] limpet_ros::PositionTarget target_message(const VelocitySetpoint& target);
/// mavros/setpoint_raw/attitude
[[nodiscard]] limpet_ros::AttitudeTarget target_message(const AttitudeSetpoint& target);
/// @return nullopt for combinations that are none of the above
[[nodiscard]] std::optional<Motion> motion_from(const limpet_ros::PositionTarget& message);
[[nodiscard]] std::optional<Motion> motion_from(const limpet_ros::AttitudeTarget& message);
/// mavros/setpoint_position/local: a position and where to look.
[[nodiscard]] std::optional<Motion> motion_from(const geometry_msgs::PoseStamped& message);

// --- the cup ------------------------------------------------------------------------------------

/// Number, touch and press force are the caller's.
[[nodiscard]] limpet_ros::CupContact contact_message(const suction::LipContact& contact);
/// @return nullopt when a number in it is none, or let_go out of range
[[nodiscard]] std::optional<suction::LipContact> lip_contact(const limpet_ros::CupContact& message);
/// Number of the contact is the caller's.
[[nodiscard]] limpet_ros::CupState cup_message(const suction::CupState& state);
/// @return nullopt for a phase that is none
[[nodiscard]] std::optional<CupPhase> phase_from(const limpet_ros::CupState& message);

[[nodiscard]] limpet_ros::PerchingEvent event_message(const Event& event);

}  // namespace limpet::ros
