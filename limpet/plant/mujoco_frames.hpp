// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

/// The one place where north-east-down and forward-right-down meet MuJoCo's axes: a world with x
/// north, y west, z up, and bodies forward-left-up. Both pairs are half a turn about x apart, so
/// one map serves worlds and bodies, and it is its own inverse.
namespace limpet::plant::mujoco_frames {

/// A vector (position, velocity, force, moment, angular velocity) from either side to the other.
[[nodiscard]] inline Vector3 turn(const Vector3& v) {
    return {v.x(), -v.y(), -v.z()};
}
[[nodiscard]] inline Vector3 turn(const double v[3]) {
    return {v[0], -v[1], -v[2]};
}

/// Attitude of a body in its world; MuJoCo's order is w x y z.
[[nodiscard]] inline Quaternion turn_attitude(const double q[4]) {
    return {q[0], q[1], -q[2], -q[3]};
}

inline void write(const Vector3& v, double out[3]) {
    out[0] = v.x();
    out[1] = -v.y();
    out[2] = -v.z();
}
inline void write_attitude(const Quaternion& q, double out[4]) {
    out[0] = q.w();
    out[1] = q.x();
    out[2] = -q.y();
    out[3] = -q.z();
}

}  // namespace limpet::plant::mujoco_frames
