// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include "limpet/core/frames.hpp"

/// North-east-down and forward-right-down meet Gazebo's world (x north, y west, z up) and its links
/// (forward-left-up): half a turn about x, both ways alike. Here and nowhere else.
namespace limpet::gazebo11::gazebo_frames {

[[nodiscard]] inline ignition::math::Vector3d turn(const Vector3& v) {
    return {v.x(), -v.y(), -v.z()};
}
[[nodiscard]] inline Vector3 turn(const ignition::math::Vector3d& v) {
    return {v.X(), -v.Y(), -v.Z()};
}
[[nodiscard]] inline ignition::math::Quaterniond turn(const Quaternion& q) {
    return {q.w(), q.x(), -q.y(), -q.z()};
}
[[nodiscard]] inline Quaternion turn(const ignition::math::Quaterniond& q) {
    return {q.W(), q.X(), -q.Y(), -q.Z()};
}

}  // namespace limpet::gazebo11::gazebo_frames
