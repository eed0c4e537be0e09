// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

/// Where our frames meet those of ROS (REP 103, REP 105), and nowhere else:
///
///   ours                             ROS
///   W north-east-down            ->  "map", east-north-up
///   B, C, S forward-right-down   ->  "base_link" and others, forward-left-up
///
/// Both turns are by 180 deg, so each is its own inverse.
namespace limpet::record::ros {

/// Half a turn about the diagonal between north and east. Also east-north-up to north-east-down.
[[nodiscard]] inline Vector3 enu_from_ned(const Vector3& v_W) {
    return {v_W.y(), v_W.x(), -v_W.z()};
}

/// Half a turn about x. Also forward-left-up to forward-right-down.
[[nodiscard]] inline Vector3 flu_from_frd(const Vector3& v_B) {
    return {v_B.x(), -v_B.y(), -v_B.z()};
}

/// @param q_WB  turns forward-right-down into north-east-down
/// @return turns forward-left-up into east-north-up, w >= 0: pointing north is a yaw of +90 deg
/// there. Its own inverse (up to the sign, which means nothing to a rotation).
[[nodiscard]] inline Quaternion enu_flu_from_ned_frd(const Quaternion& q_WB) {
    // (0, s, s, 0) * q_WB * (0, 1, 0, 0), s = sqrt(1/2), multiplied out; the sign is then chosen.
    const double s = 0.70710678118654752440;
    const Quaternion q(s * (q_WB.w() + q_WB.z()), s * (q_WB.x() + q_WB.y()),
                       s * (q_WB.x() - q_WB.y()), s * (q_WB.w() - q_WB.z()));
    return q.w() < 0.0 ? Quaternion(-q.w(), -q.x(), -q.y(), -q.z()) : q;
}

}  // namespace limpet::record::ros
