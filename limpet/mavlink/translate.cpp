// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/translate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpet::mavlink {
namespace {

constexpr std::uint8_t kLocalNed = 1;   ///< MAV_FRAME_LOCAL_NED
constexpr std::uint8_t kBodyFrd = 12;   ///< MAV_FRAME_BODY_FRD
constexpr std::uint8_t kVision = 2;     ///< MAV_ESTIMATOR_TYPE_VISION
constexpr std::uint8_t kAutopilot = 8;  ///< MAV_ESTIMATOR_TYPE_AUTOPILOT
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Diagonal of a 6 x 6 covariance sent as the rows of its upper right half.
constexpr std::array<std::size_t, 6> kDiagonal = {0, 6, 11, 15, 18, 20};

void put(const Vector3& from, float& x, float& y, float& z) {
    x = static_cast<float>(from.x());
    y = static_cast<float>(from.y());
    z = static_cast<float>(from.z());
}

Vector3 vector(float x, float y, float z) {
    return {x, y, z};
}

std::array<float, 4> wire(const Quaternion& q) {
    return {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
            static_cast<float>(q.z())};
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

std::uint16_t centimetres(double metres) {
    return static_cast<std::uint16_t>(std::clamp(std::round(metres * 100.0), 0.0, 65535.0));
}

}  // namespace

Odometry odometry(const PoseReading& pose, std::uint64_t time_usec) {
    Odometry message;
    message.time_usec = time_usec;
    message.frame_id = kLocalNed;
    message.child_frame_id = kBodyFrd;
    put(pose.p_WB_m, message.x, message.y, message.z);
    message.q = wire(pose.q_WB);
    message.vx = message.vy = message.vz = kUnknown;
    message.rollspeed = message.pitchspeed = message.yawspeed = kUnknown;
    message.pose_covariance[0] = message.velocity_covariance[0] = kUnknown;
    message.estimator_type = kVision;
    return message;
}

std::optional<PoseReading> pose_reading(const Odometry& odometry) {
    const auto q_WB = quaternion(odometry.q);
    const PoseReading pose{.p_WB_m = vector(odometry.x, odometry.y, odometry.z),
                           .q_WB = q_WB.value_or(Quaternion::Identity())};
    if (odometry.estimator_type != kVision || odometry.frame_id != kLocalNed ||
        odometry.child_frame_id != kBodyFrd || !q_WB || !pose.p_WB_m.allFinite()) {
        return std::nullopt;
    }
    return pose;
}

Odometry odometry(const Estimate& estimate, std::uint64_t time_usec) {
    Odometry message;
    message.time_usec = time_usec;
    message.frame_id = message.child_frame_id = kLocalNed;
    put(estimate.p_WB_m, message.x, message.y, message.z);
    message.q = wire(estimate.q_WB);
    put(estimate.v_WB_m_s, message.vx, message.vy, message.vz);
    put(estimate.w_WB_B_rad_s, message.rollspeed, message.pitchspeed, message.yawspeed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        message.pose_covariance[kDiagonal[axis]] = static_cast<float>(estimate.variance[axis]);
        message.pose_covariance[kDiagonal[axis + 3]] =
            static_cast<float>(estimate.variance[axis + 6]);
        message.velocity_covariance[kDiagonal[axis]] =
            static_cast<float>(estimate.variance[axis + 3]);
    }
    message.estimator_type = kAutopilot;
    message.quality = estimate.valid ? 100 : -1;
    return message;
}

std::optional<Estimate> estimate_from(const Odometry& odometry) {
    const auto q_WB = quaternion(odometry.q);
    const bool in_body = odometry.child_frame_id == kBodyFrd;
    if (odometry.frame_id != kLocalNed || !(in_body || odometry.child_frame_id == kLocalNed) ||
        !q_WB) {
        return std::nullopt;
    }
    Estimate estimate;
    estimate.time_s = 1e-6 * static_cast<double>(odometry.time_usec);
    estimate.p_WB_m = vector(odometry.x, odometry.y, odometry.z);
    estimate.q_WB = *q_WB;
    const Vector3 velocity = vector(odometry.vx, odometry.vy, odometry.vz);
    estimate.v_WB_m_s = in_body ? Vector3(*q_WB * velocity) : velocity;
    estimate.w_WB_B_rad_s = vector(odometry.rollspeed, odometry.pitchspeed, odometry.yawspeed);
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
    SetPositionTargetLocalNed message;
    message.time_boot_ms = time_boot_ms;
    message.coordinate_frame = kLocalNed;
    message.type_mask =
        target.feedforward_v_W_m_s.isZero(0.0) ? kPositionYaw : kPositionVelocityYaw;
    put(target.p_W_m, message.x, message.y, message.z);
    put(target.feedforward_v_W_m_s, message.vx, message.vy, message.vz);
    message.yaw = static_cast<float>(target.yaw_rad);
    return message;
}

SetPositionTargetLocalNed position_target(const VelocitySetpoint& target,
                                          std::uint32_t time_boot_ms) {
    SetPositionTargetLocalNed message;
    message.time_boot_ms = time_boot_ms;
    message.coordinate_frame = kLocalNed;
    message.type_mask =
        target.feedforward_a_W_m_s2.isZero(0.0) ? kVelocityYaw : kVelocityAccelerationYaw;
    put(target.v_W_m_s, message.vx, message.vy, message.vz);
    put(target.feedforward_a_W_m_s2, message.afx, message.afy, message.afz);
    message.yaw = static_cast<float>(target.yaw_rad);
    return message;
}

SetAttitudeTarget attitude_target(const AttitudeSetpoint& target, std::uint32_t time_boot_ms) {
    SetAttitudeTarget message;
    message.time_boot_ms = time_boot_ms;
    message.type_mask = kAttitudeThrust;
    message.q = wire(target.q_WB);
    message.thrust = static_cast<float>(target.thrust);
    return message;
}

std::optional<PositionSetpoint> position_set_point(const SetPositionTargetLocalNed& message) {
    const bool with_velocity = message.type_mask == kPositionVelocityYaw;
    PositionSetpoint target{.p_W_m = vector(message.x, message.y, message.z),
                            .yaw_rad = message.yaw};
    if (with_velocity) {
        target.feedforward_v_W_m_s = vector(message.vx, message.vy, message.vz);
    }
    if (message.coordinate_frame != kLocalNed ||
        !(with_velocity || message.type_mask == kPositionYaw) || !target.p_W_m.allFinite() ||
        !target.feedforward_v_W_m_s.allFinite() || !std::isfinite(target.yaw_rad)) {
        return std::nullopt;
    }
    return target;
}

std::optional<VelocitySetpoint> velocity_set_point(const SetPositionTargetLocalNed& message) {
    const bool with_acceleration = message.type_mask == kVelocityAccelerationYaw;
    VelocitySetpoint target{.v_W_m_s = vector(message.vx, message.vy, message.vz),
                            .yaw_rad = message.yaw};
    if (with_acceleration) {
        target.feedforward_a_W_m_s2 = vector(message.afx, message.afy, message.afz);
    }
    if (message.coordinate_frame != kLocalNed ||
        !(with_acceleration || message.type_mask == kVelocityYaw) || !target.v_W_m_s.allFinite() ||
        !target.feedforward_a_W_m_s2.allFinite() || !std::isfinite(target.yaw_rad)) {
        return std::nullopt;
    }
    return target;
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
    DistanceSensor message;
    message.time_boot_ms = time_boot_ms;
    message.min_distance = centimetres(minimum_m);
    message.max_distance = centimetres(maximum_m);
    message.current_distance = range.valid ? centimetres(range.distance_m) : std::uint16_t{0};
    message.id = id;
    message.covariance = kUnknownCovariance;
    return message;
}

RangeReading range_reading(const DistanceSensor& message) {
    const bool valid = message.current_distance > 0 &&
                       message.current_distance >= message.min_distance &&
                       message.current_distance <= message.max_distance;
    return {.distance_m = valid ? 0.01 * message.current_distance : 0.0, .valid = valid};
}

}  // namespace limpet::mavlink
