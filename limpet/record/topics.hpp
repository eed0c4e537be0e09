// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace limpet::record {

/// What a recording holds: one channel each, in this order.
enum class Topic : std::size_t {
    imu,
    range_left,
    range_right,
    force,
    cup_pressure,
    motion_capture,
    barometer,
    magnetometer,
    gps,
    battery,
    truth_pose,
    truth_twist,
    truth_cup_wrench,
    truth_vehicle,
    cup,
    estimate_pose,
    estimate_twist,
    estimate_deviation,
    estimate_consistency,
    setpoint,
    guidance,
    rotor_command,
    events,
};

struct TopicInfo {
    std::string_view name;
    std::string_view type;
};

/// Types of ROS are in its frames and units, ours north-east-down, forward-right-down, with units
/// in the names.
inline constexpr std::array<TopicInfo, 23> kTopics = {{
    {"/sensors/imu", "sensor_msgs/msg/Imu"},
    {"/sensors/range_left", "sensor_msgs/msg/Range"},
    {"/sensors/range_right", "sensor_msgs/msg/Range"},
    {"/sensors/force", "geometry_msgs/msg/WrenchStamped"},
    {"/sensors/cup_pressure", "sensor_msgs/msg/FluidPressure"},
    {"/sensors/motion_capture", "geometry_msgs/msg/PoseStamped"},
    {"/sensors/barometer", "sensor_msgs/msg/FluidPressure"},
    {"/sensors/magnetometer", "sensor_msgs/msg/MagneticField"},
    {"/sensors/gps", "limpet_msgs/msg/GpsFix"},
    {"/sensors/battery", "sensor_msgs/msg/BatteryState"},
    {"/truth/pose", "geometry_msgs/msg/PoseStamped"},
    {"/truth/twist", "geometry_msgs/msg/TwistStamped"},
    {"/truth/cup_wrench", "geometry_msgs/msg/WrenchStamped"},
    {"/truth/vehicle", "limpet_msgs/msg/VehicleTruth"},
    {"/cup", "limpet_msgs/msg/CupState"},
    {"/estimate/pose", "geometry_msgs/msg/PoseStamped"},
    {"/estimate/twist", "geometry_msgs/msg/TwistStamped"},
    {"/estimate/deviation", "limpet_msgs/msg/EstimateDeviation"},
    {"/estimate/consistency", "limpet_msgs/msg/EstimateConsistency"},
    {"/setpoint", "limpet_msgs/msg/Setpoint"},
    {"/guidance", "limpet_msgs/msg/GuidanceState"},
    {"/rotor_command", "limpet_msgs/msg/RotorCommand"},
    {"/events", "limpet_msgs/msg/Event"},
}};

[[nodiscard]] constexpr const TopicInfo& info(Topic topic) {
    return kTopics[static_cast<std::size_t>(topic)];
}
// A channel next to them, of a vehicle with a payload on a cable alone: numbers in W.
inline constexpr std::string_view kPayloadTopic = "/truth/payload";
inline constexpr std::string_view kPayloadType = "limpet_msgs/msg/PayloadTruth";
inline constexpr std::array<std::string_view, 8> kPayloadColumns = {
    "north_m",           "east_m",    "down_m",      "velocity_north_m_s", "velocity_east_m_s",
    "velocity_down_m_s", "tension_n", "cable_parted"};
// Channels for viewers (scene.hpp): not read back as columns.
inline constexpr std::string_view kDescriptionTopic = "/robot_description";
inline constexpr std::string_view kMovingTopic = "/tf";
inline constexpr std::string_view kStandingTopic = "/tf_static";
inline constexpr std::string_view kMarkersTopic = "/scene";
/// Of an attachment that the description's `package://VEHICLE/NAME` means.
inline constexpr std::string_view kMeshMediaType = "model/stl";
[[nodiscard]] constexpr bool is_of_scene(std::string_view topic) {
    return topic == kDescriptionTopic || topic == kMovingTopic || topic == kStandingTopic ||
           topic == kMarkersTopic;
}
static_assert(info(Topic::events).name == "/events", "enum and table in the same order");

}  // namespace limpet::record
