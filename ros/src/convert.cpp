// SPDX-License-Identifier: Apache-2.0
#include "ros/src/convert.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/record/ros_frames.hpp"

namespace limpet::ros {
namespace {

constexpr const char* kWorld = "map";
constexpr const char* kBody = "base_link";
constexpr double kUnitTolerance = 1e-3;

template <class Vector>
Vector vector_message(const Vector3& v) {
    Vector message;
    message.x = v.x();
    message.y = v.y();
    message.z = v.z();
    return message;
}

/// @return the triple, along the axes that it came in
template <class Vector>
Vector3 triple(const Vector& message) {
    return {message.x, message.y, message.z};
}

geometry_msgs::Quaternion attitude_message(const Quaternion& q_WB) {
    const Quaternion q = record::ros::enu_flu_from_ned_frd(q_WB);
    geometry_msgs::Quaternion message;
    message.w = q.w();
    message.x = q.x();
    message.y = q.y();
    message.z = q.z();
    return message;
}

std::optional<Quaternion> attitude(const geometry_msgs::Quaternion& message) {
    const Quaternion q(message.w, message.x, message.y, message.z);
    if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
        return std::nullopt;
    }
    return record::ros::enu_flu_from_ned_frd(q.normalized());
}

/// Yaw from north, clockwise, and from east, counter-clockwise: its own inverse.
double turned_yaw_rad(double yaw_rad) {
    return wrap_pi(0.5 * kPi - yaw_rad);
}

using Target = limpet_ros::PositionTarget;
constexpr int kNoPosition = Target::IGNORE_PX | Target::IGNORE_PY | Target::IGNORE_PZ;
constexpr int kNoVelocity = Target::IGNORE_VX | Target::IGNORE_VY | Target::IGNORE_VZ;
constexpr int kNoAcceleration = Target::IGNORE_AFX | Target::IGNORE_AFY | Target::IGNORE_AFZ;
constexpr int kNoRates = limpet_ros::AttitudeTarget::IGNORE_ROLL_RATE |
                         limpet_ros::AttitudeTarget::IGNORE_PITCH_RATE |
                         limpet_ros::AttitudeTarget::IGNORE_YAW_RATE;

Target target_of(int type_mask, double yaw_rad) {
    Target message;
    message.header.frame_id = kWorld;
    message.coordinate_frame = Target::FRAME_LOCAL_NED;
    message.type_mask = static_cast<std::uint16_t>(type_mask | Target::IGNORE_YAW_RATE);
    message.yaw = static_cast<float>(turned_yaw_rad(yaw_rad));
    return message;
}

}  // namespace

::ros::Time ros_time(double time_s) {
    return ::ros::Time(std::max(time_s, 0.0));
}

geometry_msgs::PoseStamped pose_message(const Estimate& estimate) {
    geometry_msgs::PoseStamped message;
    message.header.frame_id = kWorld;
    message.pose.position =
        vector_message<geometry_msgs::Point>(record::ros::enu_from_ned(estimate.p_WB_m));
    message.pose.orientation = attitude_message(estimate.q_WB);
    return message;
}

std::optional<PoseReading> pose_reading(const geometry_msgs::PoseStamped& message) {
    const auto q_WB = attitude(message.pose.orientation);
    const Vector3 p_WB_m = record::ros::enu_from_ned(triple(message.pose.position));
    if (!q_WB || !p_WB_m.allFinite()) {
        return std::nullopt;
    }
    return PoseReading{.p_WB_m = p_WB_m, .q_WB = *q_WB};
}

geometry_msgs::TwistStamped velocity_message(const Estimate& estimate) {
    geometry_msgs::TwistStamped message;
    message.header.frame_id = kWorld;
    message.twist.linear =
        vector_message<geometry_msgs::Vector3>(record::ros::enu_from_ned(estimate.v_WB_m_s));
    message.twist.angular = vector_message<geometry_msgs::Vector3>(
        record::ros::enu_from_ned(estimate.q_WB * estimate.w_WB_B_rad_s));
    return message;
}

std::optional<Vector3> velocity_W(const geometry_msgs::TwistStamped& message) {
    const Vector3 v_WB_m_s = record::ros::enu_from_ned(triple(message.twist.linear));
    return v_WB_m_s.allFinite() ? std::optional(v_WB_m_s) : std::nullopt;
}

sensor_msgs::Imu imu_message(const Estimate& estimate) {
    sensor_msgs::Imu message;
    message.header.frame_id = kBody;
    message.orientation = attitude_message(estimate.q_WB);
    message.angular_velocity =
        vector_message<geometry_msgs::Vector3>(record::ros::flu_from_frd(estimate.w_WB_B_rad_s));
    message.linear_acceleration = vector_message<geometry_msgs::Vector3>(
        record::ros::flu_from_frd(estimate.specific_force_B_m_s2));
    return message;
}

std::optional<Vector3> rate_B(const sensor_msgs::Imu& message) {
    const Vector3 w_WB_B_rad_s = record::ros::flu_from_frd(triple(message.angular_velocity));
    return w_WB_B_rad_s.allFinite() ? std::optional(w_WB_B_rad_s) : std::nullopt;
}

sensor_msgs::Range range_message(const RangeReading& reading, double minimum_m, double maximum_m) {
    constexpr double kFieldOfView_deg = 3.6;  // TFmini Plus, its data sheet
    sensor_msgs::Range message;
    message.radiation_type = sensor_msgs::Range::INFRARED;
    message.field_of_view = static_cast<float>(radians(kFieldOfView_deg));
    message.min_range = static_cast<float>(minimum_m);
    message.max_range = static_cast<float>(maximum_m);
    message.range = reading.valid ? static_cast<float>(reading.distance_m)
                                  : std::numeric_limits<float>::infinity();
    return message;
}

RangeReading range_reading(const sensor_msgs::Range& message) {
    const bool valid = std::isfinite(message.range) && message.range >= message.min_range &&
                       message.range <= message.max_range;
    return {.distance_m = valid ? double{message.range} : 0.0, .valid = valid};
}

geometry_msgs::WrenchStamped force_message(const ForceReading& reading) {
    geometry_msgs::WrenchStamped message;
    message.header.frame_id = "cup";
    message.wrench.force.x = reading.axial_N;
    return message;
}

std::optional<ForceReading> force_reading(const geometry_msgs::WrenchStamped& message) {
    if (!std::isfinite(message.wrench.force.x)) {
        return std::nullopt;
    }
    return ForceReading{.axial_N = message.wrench.force.x};
}

sensor_msgs::FluidPressure pressure_message(const PressureReading& reading) {
    sensor_msgs::FluidPressure message;
    message.header.frame_id = "cup";
    message.fluid_pressure = reading.pressure_Pa;
    return message;
}

std::optional<PressureReading> pressure_reading(const sensor_msgs::FluidPressure& message) {
    if (!std::isfinite(message.fluid_pressure)) {
        return std::nullopt;
    }
    return PressureReading{.pressure_Pa = message.fluid_pressure};
}

sensor_msgs::BatteryState battery_message(const BatteryReading& reading) {
    sensor_msgs::BatteryState message;
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    message.voltage = static_cast<float>(reading.voltage_V);
    message.current = static_cast<float>(-reading.current_A);
    message.charge = message.capacity = message.design_capacity = kUnknown;
    message.percentage = static_cast<float>(reading.remaining);
    message.power_supply_status = sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_DISCHARGING;
    message.power_supply_technology = sensor_msgs::BatteryState::POWER_SUPPLY_TECHNOLOGY_LIPO;
    message.present = 1;
    return message;
}

std::optional<BatteryReading> battery_reading(const sensor_msgs::BatteryState& message) {
    if (!(message.percentage >= 0.0F && message.percentage <= 1.0F)) {
        return std::nullopt;
    }
    return BatteryReading{
        .voltage_V = std::isfinite(message.voltage) ? double{message.voltage} : 0.0,
        .current_A = std::isfinite(message.current) ? std::max(0.0, -double{message.current}) : 0.0,
        .remaining = message.percentage};
}

limpet_ros::PositionTarget target_message(const PositionSetpoint& target) {
    const bool with_velocity = !target.feedforward_v_W_m_s.isZero(0.0);
    Target message = target_of(kNoAcceleration | (with_velocity ? 0 : kNoVelocity), target.yaw_rad);
    message.position =
        vector_message<geometry_msgs::Point>(record::ros::enu_from_ned(target.p_W_m));
    message.velocity = vector_message<geometry_msgs::Vector3>(
        record::ros::enu_from_ned(target.feedforward_v_W_m_s));
    return message;
}

limpet_ros::PositionTarget target_message(const VelocitySetpoint& target) {
    const bool with_acceleration = !target.feedforward_a_W_m_s2.isZero(0.0);
    Target message =
        target_of(kNoPosition | (with_acceleration ? 0 : kNoAcceleration), target.yaw_rad);
    message.velocity =
        vector_message<geometry_msgs::Vector3>(record::ros::enu_from_ned(target.v_W_m_s));
    message.acceleration_or_force = vector_message<geometry_msgs::Vector3>(
        record::ros::enu_from_ned(target.feedforward_a_W_m_s2));
    return message;
}

limpet_ros::AttitudeTarget target_message(const AttitudeSetpoint& target) {
    limpet_ros::AttitudeTarget message;
    message.header.frame_id = kWorld;
    message.type_mask = kNoRates;
    message.orientation = attitude_message(target.q_WB);
    message.thrust = static_cast<float>(target.thrust);
    return message;
}

std::optional<Motion> motion_from(const limpet_ros::PositionTarget& message) {
    const int mask = message.type_mask & ~Target::IGNORE_YAW_RATE;
    const Vector3 p_W_m = record::ros::enu_from_ned(triple(message.position));
    const Vector3 v_W_m_s = record::ros::enu_from_ned(triple(message.velocity));
    const Vector3 a_W_m_s2 = record::ros::enu_from_ned(triple(message.acceleration_or_force));
    const double yaw_rad = turned_yaw_rad(message.yaw);
    if (message.coordinate_frame != Target::FRAME_LOCAL_NED ||
        (message.type_mask & Target::IGNORE_YAW_RATE) == 0 || !std::isfinite(message.yaw)) {
        return std::nullopt;
    }
    const Vector3 none = Vector3::Zero();
    if (mask == kNoAcceleration || mask == (kNoAcceleration | kNoVelocity)) {
        const PositionSetpoint target{
            .p_W_m = p_W_m,
            .yaw_rad = yaw_rad,
            .feedforward_v_W_m_s = mask == kNoAcceleration ? v_W_m_s : none};
        const bool sound = target.p_W_m.allFinite() && target.feedforward_v_W_m_s.allFinite();
        return sound ? std::optional<Motion>(target) : std::nullopt;
    }
    if (mask == kNoPosition || mask == (kNoPosition | kNoAcceleration)) {
        const VelocitySetpoint target{
            .v_W_m_s = v_W_m_s,
            .yaw_rad = yaw_rad,
            .feedforward_a_W_m_s2 = mask == kNoPosition ? a_W_m_s2 : none};
        const bool sound = target.v_W_m_s.allFinite() && target.feedforward_a_W_m_s2.allFinite();
        return sound ? std::optional<Motion>(target) : std::nullopt;
    }
    return std::nullopt;
}

std::optional<Motion> motion_from(const limpet_ros::AttitudeTarget& message) {
    const auto q_WB = attitude(message.orientation);
    if (message.type_mask != kNoRates || !q_WB || !std::isfinite(message.thrust)) {
        return std::nullopt;
    }
    return AttitudeSetpoint{.q_WB = *q_WB, .thrust = message.thrust};
}

std::optional<Motion> motion_from(const geometry_msgs::PoseStamped& message) {
    const auto pose = pose_reading(message);
    if (!pose) {
        return std::nullopt;
    }
    return PositionSetpoint{.p_W_m = pose->p_WB_m,
                            .yaw_rad = euler_from_quaternion(pose->q_WB).yaw_rad};
}

limpet_ros::CupContact contact_message(const suction::LipContact& contact) {
    limpet_ros::CupContact message;
    message.header.frame_id = "cup";
    message.touches = contact.touches ? 1 : 0;
    message.gap_m = contact.gap_m;
    message.tilt_rad = contact.tilt_rad;
    message.pull_N = contact.pull_N;
    message.lies_still = contact.lies_still ? 1 : 0;
    message.let_go = static_cast<std::uint8_t>(contact.let_go);
    message.pull_margin_N = contact.pull_margin_N;
    message.shear_margin_N = contact.shear_margin_N;
    message.peel_margin_N = contact.peel_margin_N;
    return message;
}

std::optional<suction::LipContact> lip_contact(const limpet_ros::CupContact& message) {
    for (const double number :
         {message.gap_m, message.tilt_rad, message.press_N, message.pull_N, message.pull_margin_N,
          message.shear_margin_N, message.peel_margin_N}) {
        if (!std::isfinite(number)) {
            return std::nullopt;
        }
    }
    if (message.let_go > limpet_ros::CupContact::PEELED) {
        return std::nullopt;
    }
    return suction::LipContact{.touches = message.touches != 0,
                               .gap_m = message.gap_m,
                               .tilt_rad = message.tilt_rad,
                               .lies_still = message.lies_still != 0,
                               .let_go = static_cast<suction::LetGo>(message.let_go),
                               .pull_N = message.pull_N,
                               .pull_margin_N = message.pull_margin_N,
                               .shear_margin_N = message.shear_margin_N,
                               .peel_margin_N = message.peel_margin_N};
}

limpet_ros::CupState cup_message(const suction::CupState& state) {
    limpet_ros::CupState message;
    message.header.frame_id = "cup";
    message.touches = static_cast<std::uint32_t>(state.touches);
    message.phase = static_cast<std::uint8_t>(state.status.phase);
    message.sealed = suction::is_sealed(state.status.phase) ? 1 : 0;
    message.attached = state.status.phase == CupPhase::attached ? 1 : 0;
    message.pump_running = state.status.pump_running ? 1 : 0;
    message.valve_open = state.status.valve_open ? 1 : 0;
    message.pressure_Pa = state.status.pressure_Pa;
    message.mean_pressure_Pa = state.mean_pressure_Pa;
    message.seal_threshold_N = state.status.seal_threshold_N;
    return message;
}

std::optional<CupPhase> phase_from(const limpet_ros::CupState& message) {
    if (message.phase > limpet_ros::CupState::UNSEALING || !std::isfinite(message.pressure_Pa) ||
        !std::isfinite(message.mean_pressure_Pa)) {
        return std::nullopt;
    }
    return static_cast<CupPhase>(message.phase);
}

limpet_ros::PerchingEvent event_message(const Event& event) {
    limpet_ros::PerchingEvent message;
    message.station = std::string(event.station);
    message.name = std::string(to_string(event.name));
    message.reason = std::string(event.reason);
    for (std::size_t i = 0; i < event.value_count; ++i) {
        message.value_names.emplace_back(event.values[i].name);
        message.values.push_back(event.values[i].value);
    }
    return message;
}

}  // namespace limpet::ros
