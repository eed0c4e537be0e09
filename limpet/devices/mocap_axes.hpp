// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet::devices {

/// Which axis of the motion-capture frame points up, as chosen in Motive's streaming pane.
enum class UpAxis {
    y,
    z
};

/// How the motion-capture frame M lies in W, and how the rigid body's frame P (its pivot) lies in
/// B. Both M and P are right-handed with the same axis up; Motive gives a new rigid body the axes
/// of M, so P turns with the vehicle from there.
struct MocapAxes {
    UpAxis up = UpAxis::y;
    /// Yaw in W of M's x axis: 0 when it points north, +90 when east.
    double x_axis_yaw_deg = 0.0;
    Vector3 p_WM_m = Vector3::Zero();  ///< where M's origin is
    /// Yaw of the nose from P's x axis, clockwise from above: 0 when the vehicle pointed along M's
    /// x as the rigid body was made.
    double nose_yaw_deg = 0.0;
    /// The pivot, seen from the centre of mass.
    Vector3 p_BP_m = Vector3::Zero();
};

/// A pose as motion capture reports it, in its own axes.
struct MocapPose {
    Vector3 p_MP_m = Vector3::Zero();
    Quaternion q_MP = Quaternion::Identity();
};

/// The one place where motion-capture axes meet north-east-down.
/// @param pose  q_MP of any length but zero
[[nodiscard]] PoseReading pose_in_world(const MocapAxes& axes, const MocapPose& pose);
/// The other way, for the simulator and tests.
[[nodiscard]] MocapPose pose_in_mocap(const MocapAxes& axes, const PoseReading& pose);

}  // namespace limpet::devices
