// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include "limpet/core/frames.hpp"
#include "limpet/record/ros_frames.hpp"

/// North-east-down and forward-right-down meet Gazebo's world and its links, which are ROS's map
/// and bodies (REP 103): east-north-up and forward-left-up. Both ways alike; here and nowhere else.
namespace limpet::gazebo11::gazebo_frames {

[[nodiscard]] inline ignition::math::Vector3d vector_of(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline Vector3 vector_of(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}

/// Of the world.
[[nodiscard]] inline ignition::math::Vector3d turn_W(const Vector3& v_W) {
    return vector_of(record::ros::enu_from_ned(v_W));
}
[[nodiscard]] inline Vector3 turn_W(const ignition::math::Vector3d& v) {
    return record::ros::enu_from_ned(vector_of(v));
}
/// Of a link, a lip, a sensor.
[[nodiscard]] inline ignition::math::Vector3d turn_F(const Vector3& v_F) {
    return vector_of(record::ros::flu_from_frd(v_F));
}
[[nodiscard]] inline Vector3 turn_F(const ignition::math::Vector3d& v) {
    return record::ros::flu_from_frd(vector_of(v));
}
/// How one stands in the world.
[[nodiscard]] inline ignition::math::Quaterniond turn(const Quaternion& q_WF) {
    const Quaternion q = record::ros::enu_flu_from_ned_frd(q_WF);
    return {q.w(), q.x(), q.y(), q.z()};
}
[[nodiscard]] inline Quaternion turn(const ignition::math::Quaterniond& q) {
    return record::ros::enu_flu_from_ned_frd({q.W(), q.X(), q.Y(), q.Z()});
}

}  // namespace limpet::gazebo11::gazebo_frames
