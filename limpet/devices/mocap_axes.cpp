// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/mocap_axes.hpp"

#include <cmath>

namespace limpet::devices {
namespace {

/// Axes of a frame with `up` upwards in a frame with z downwards, when its x axis has this yaw.
Matrix3 axes_seen_from_above(UpAxis up, double x_axis_yaw_deg) {
    const double c = std::cos(radians(x_axis_yaw_deg));
    const double s = std::sin(radians(x_axis_yaw_deg));
    const Vector3 x{c, s, 0.0};
    const Vector3 upwards{0.0, 0.0, -1.0};
    Matrix3 axes;
    switch (up) {
        case UpAxis::z: axes << x, upwards.cross(x), upwards; break;
        case UpAxis::y: axes << x, upwards, x.cross(upwards); break;
    }
    return axes;
}

Quaternion q_WM(const MocapAxes& axes) {
    return Quaternion(axes_seen_from_above(axes.up, axes.x_axis_yaw_deg));
}

/// P's x axis lies at minus the nose's yaw when B is level.
Quaternion q_BP(const MocapAxes& axes) {
    return Quaternion(axes_seen_from_above(axes.up, -axes.nose_yaw_deg));
}

}  // namespace

PoseReading pose_in_world(const MocapAxes& axes, const MocapPose& pose) {
    const Quaternion turn = q_WM(axes);
    const Quaternion q_WB = (turn * pose.q_MP * q_BP(axes).conjugate()).normalized();
    return {.p_WB_m = axes.p_WM_m + turn * pose.p_MP_m - q_WB * axes.p_BP_m, .q_WB = q_WB};
}

MocapPose pose_in_mocap(const MocapAxes& axes, const PoseReading& pose) {
    const Quaternion back = q_WM(axes).conjugate();
    return {.p_MP_m = back * (pose.p_WB_m + pose.q_WB * axes.p_BP_m - axes.p_WM_m),
            .q_MP = (back * pose.q_WB * q_BP(axes)).normalized()};
}

}  // namespace limpet::devices
