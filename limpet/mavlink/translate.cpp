// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/translate.hpp"

#include <cmath>
#include <limits>

#include "limpet/mavlink/numbers.hpp"

namespace limpet::mavlink {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Diagonal of a 6 x 6 covariance sent as the rows of its upper right half.
constexpr std::array<std::size_t, 6> kDiagonal = {0, 6, 11, 15, 18, 20};

std::array<float, 4> four(const Quaternion& q) {
    return {on_wire<float>(q.w()), on_wire<float>(q.x()), on_wire<float>(q.y()),
            on_wire<float>(q.z())};
}

/// @return nothing for what is not finite or has no length
std::optional<Quaternion> quaternion(const std::array<float, 4>& q) {
    const Quaternion raw(q[0], q[1], q[2], q[3]);
    constexpr double kShortest = 1e-3;  // of what calls itself a unit quaternion
    if (!raw.coeffs().allFinite() || raw.norm() < kShortest) {
        return std::nullopt;
    }
    return raw.normalized();
}

/// What goes for every set-point in W.
SetPositionTargetLocalNed local_target(std::uint16_t type_mask, double yaw_rad,
                                       std::uint32_t time_boot_ms) {
    return {.time_boot_ms = time_boot_ms,
            .coordinate_frame = MavFrame::local_ned,
            .type_mask = type_mask,
            .yaw = on_wire<float>(yaw_rad)};
}

/// @param plain  the mask without feed-forward
/// @param fed    the mask with it
template <class Target>
std::optional<Target> local_set_point(const SetPositionTargetLocalNed& message, std::uint16_t plain,
                                      std::uint16_t fed, const Vector3& aim,
                                      const Vector3& feedforward) {
    const bool is_fed = message.type_mask == fed;
    const bool known = message.coordinate_frame == MavFrame::local_ned &&
                       (is_fed || message.type_mask == plain) && aim.allFinite() &&
                       (!is_fed || feedforward.allFinite()) && std::isfinite(message.yaw);
    return known ? std::optional(Target{aim, message.yaw, is_fed ? feedforward : Vector3(0, 0, 0)})
                 : std::nullopt;
}

}  // namespace

Odometry odometry(const PoseReading& pose, std::uint64_t time_usec) {
    Odometry message{.time_usec = time_usec,
                     .frame_id = MavFrame::local_ned,
                     .child_frame_id = MavFrame::body_frd,
                     .q = four(pose.q_WB),
                     .pose_covariance = {kUnknown},
                     .velocity_covariance = {kUnknown},
                     .estimator_type = MavEstimatorType::vision};
    put(pose.p_WB_m, message.x, message.y, message.z);
    message.vx = message.vy = message.vz = kUnknown;
    message.rollspeed = message.pitchspeed = message.yawspeed = kUnknown;
    return message;
}

std::string_view why_no_pose(const Odometry& odometry) {
    const Vector3 p_WB_m(odometry.x, odometry.y, odometry.z);
    return odometry.estimator_type != MavEstimatorType::vision
               ? "its estimator_type is not MAV_ESTIMATOR_TYPE_VISION"
           : odometry.frame_id != MavFrame::local_ned ? "its frame_id is not MAV_FRAME_LOCAL_NED"
           : odometry.child_frame_id != MavFrame::body_frd
               ? "its child_frame_id is not MAV_FRAME_BODY_FRD"
           : !p_WB_m.allFinite()     ? "its position is not finite"
           : !quaternion(odometry.q) ? "its quaternion is not finite or of length 0"
                                     : "";
}

std::optional<PoseReading> pose_reading(const Odometry& odometry) {
    if (!why_no_pose(odometry).empty()) {
        return std::nullopt;
    }
    return PoseReading{.p_WB_m = Vector3(odometry.x, odometry.y, odometry.z),
                       .q_WB = *quaternion(odometry.q)};
}

Odometry odometry(const Estimate& estimate, std::uint64_t time_usec) {
    Odometry message{.time_usec = time_usec,
                     .frame_id = MavFrame::local_ned,
                     .child_frame_id = MavFrame::local_ned,
                     .q = four(estimate.q_WB),
                     .estimator_type = MavEstimatorType::autopilot,
                     .quality = std::int8_t(estimate.valid ? 100 : -1)};
    put(estimate.p_WB_m, message.x, message.y, message.z);
    put(estimate.v_WB_m_s, message.vx, message.vy, message.vz);
    put(estimate.w_WB_B_rad_s, message.rollspeed, message.pitchspeed, message.yawspeed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = kDiagonal[axis];
        message.pose_covariance[at] = on_wire<float>(estimate.variance[axis]);
        message.pose_covariance[kDiagonal[axis + 3]] = on_wire<float>(estimate.variance[axis + 6]);
        message.velocity_covariance[at] = on_wire<float>(estimate.variance[axis + 3]);
    }
    return message;
}

std::optional<Estimate> estimate_from(const Odometry& odometry) {
    const auto q_WB = quaternion(odometry.q);
    const bool in_body = odometry.child_frame_id == MavFrame::body_frd;
    if (odometry.frame_id != MavFrame::local_ned ||
        !(in_body || odometry.child_frame_id == MavFrame::local_ned) || !q_WB) {
        return std::nullopt;
    }
    Estimate estimate;
    estimate.time_s = 1e-6 * static_cast<double>(odometry.time_usec);
    estimate.p_WB_m = {odometry.x, odometry.y, odometry.z};
    estimate.q_WB = *q_WB;
    const Vector3 velocity(odometry.vx, odometry.vy, odometry.vz);
    estimate.v_WB_m_s = in_body ? Vector3(*q_WB * velocity) : velocity;
    estimate.w_WB_B_rad_s = {odometry.rollspeed, odometry.pitchspeed, odometry.yawspeed};
    if (!estimate.p_WB_m.allFinite() || !estimate.v_WB_m_s.allFinite() ||
        !estimate.w_WB_B_rad_s.allFinite()) {
        return std::nullopt;
    }
    const auto known = [](float variance) { return variance > 0.0F ? double{variance} : 0.0; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        estimate.variance[axis] = known(odometry.pose_covariance[kDiagonal[axis]]);
        estimate.variance[axis + 6] = known(odometry.pose_covariance[kDiagonal[axis + 3]]);
        estimate.variance[axis + 3] = known(odometry.velocity_covariance[kDiagonal[axis]]);
    }
    estimate.valid = odometry.quality >= 0;
    return estimate;
}

SetPositionTargetLocalNed position_target(const PositionSetpoint& target,
                                          std::uint32_t time_boot_ms) {
    const bool fed = !target.feedforward_v_W_m_s.isZero(0.0);
    SetPositionTargetLocalNed message =
        local_target(fed ? kPositionVelocityYaw : kPositionYaw, target.yaw_rad, time_boot_ms);
    put(target.p_W_m, message.x, message.y, message.z);
    put(target.feedforward_v_W_m_s, message.vx, message.vy, message.vz);
    return message;
}

SetPositionTargetLocalNed position_target(const VelocitySetpoint& target,
                                          std::uint32_t time_boot_ms) {
    const bool fed = !target.feedforward_a_W_m_s2.isZero(0.0);
    SetPositionTargetLocalNed message =
        local_target(fed ? kVelocityAccelerationYaw : kVelocityYaw, target.yaw_rad, time_boot_ms);
    put(target.v_W_m_s, message.vx, message.vy, message.vz);
    put(target.feedforward_a_W_m_s2, message.afx, message.afy, message.afz);
    return message;
}

SetAttitudeTarget attitude_target(const AttitudeSetpoint& target, std::uint32_t time_boot_ms) {
    return {.time_boot_ms = time_boot_ms,
            .type_mask = kAttitudeThrust,
            .q = four(target.q_WB),
            .thrust = on_wire<float>(target.thrust)};
}

std::optional<PositionSetpoint> position_set_point(const SetPositionTargetLocalNed& message) {
    return local_set_point<PositionSetpoint>(message, kPositionYaw, kPositionVelocityYaw,
                                             {message.x, message.y, message.z},
                                             {message.vx, message.vy, message.vz});
}

std::optional<VelocitySetpoint> velocity_set_point(const SetPositionTargetLocalNed& message) {
    return local_set_point<VelocitySetpoint>(message, kVelocityYaw, kVelocityAccelerationYaw,
                                             {message.vx, message.vy, message.vz},
                                             {message.afx, message.afy, message.afz});
}

std::optional<AttitudeSetpoint> attitude_set_point(const SetAttitudeTarget& message) {
    const auto q_WB = quaternion(message.q);
    if (message.type_mask != kAttitudeThrust || !q_WB || !std::isfinite(message.thrust)) {
        return std::nullopt;
    }
    return AttitudeSetpoint{.q_WB = *q_WB, .thrust = message.thrust};
}

DistanceSensor distance_sensor(const RangeReading& range, std::uint8_t id, double minimum_m,
                               double maximum_m, std::uint32_t time_boot_ms) {
    constexpr std::uint8_t kUnknownCovariance = 255;
    return {
        .time_boot_ms = time_boot_ms,
        .min_distance = on_wire<std::uint16_t>(100.0 * minimum_m),
        .max_distance = on_wire<std::uint16_t>(100.0 * maximum_m),
        .current_distance = on_wire<std::uint16_t>(range.valid ? 100.0 * range.distance_m : 0.0),
        .id = id,
        .covariance = kUnknownCovariance};
}

RangeReading range_reading(const DistanceSensor& message) {
    const bool valid = message.current_distance > 0 &&
                       message.current_distance >= message.min_distance &&
                       message.current_distance <= message.max_distance;
    return {.distance_m = valid ? 0.01 * message.current_distance : 0.0, .valid = valid};
}

}  // namespace limpet::mavlink
