// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/convert.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapters/ros/src/geometry.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/scene.hpp"

namespace limpet::ros {
namespace {

using ros::put;

using limpet_ros::AttitudeTarget;
using limpet_ros::CupContact;
using limpet_ros::PositionTarget;
using record::ros::enu_flu_from_ned_frd;
using record::ros::enu_from_ned;
using record::ros::flu_from_frd;

constexpr std::string_view kWorld = record::kMapFrame;
constexpr std::string_view kBody = record::kBaseFrame;
constexpr double kUnitTolerance = 1e-3;

template <class Message>
Message in_frame(std::string_view frame) {
    Message message;
    message.header.frame_id = std::string(frame);
    return message;
}

void put(const Quaternion& q_WB, geometry_msgs::Quaternion& message) {
    const Quaternion q = enu_flu_from_ned_frd(q_WB);
    message.w = q.w();
    put(Vector3(q.vec()), message);
}

std::optional<Quaternion> attitude(const geometry_msgs::Quaternion& message) {
    const Quaternion q(message.w, message.x, message.y, message.z);
    if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
        return std::nullopt;
    }
    return enu_flu_from_ned_frd(q.normalized());
}

std::optional<Vector3> finite(const Vector3& v) {
    return v.allFinite() ? std::optional(v) : std::nullopt;
}

/// Yaw from north, clockwise, and from east, counter-clockwise: its own inverse.
double turned_yaw_rad(double yaw_rad) {
    return wrap_pi(0.5 * kPi - yaw_rad);
}

constexpr int kNoPosition =
    PositionTarget::IGNORE_PX | PositionTarget::IGNORE_PY | PositionTarget::IGNORE_PZ;
constexpr int kNoVelocity =
    PositionTarget::IGNORE_VX | PositionTarget::IGNORE_VY | PositionTarget::IGNORE_VZ;
constexpr int kNoAcceleration =
    PositionTarget::IGNORE_AFX | PositionTarget::IGNORE_AFY | PositionTarget::IGNORE_AFZ;
constexpr int kNoRates = AttitudeTarget::IGNORE_ROLL_RATE | AttitudeTarget::IGNORE_PITCH_RATE |
                         AttitudeTarget::IGNORE_YAW_RATE;

PositionTarget target_of(int type_mask, double yaw_rad) {
    auto message = in_frame<PositionTarget>(kWorld);
    message.coordinate_frame = PositionTarget::FRAME_LOCAL_NED;
    message.type_mask = static_cast<std::uint16_t>(type_mask | PositionTarget::IGNORE_YAW_RATE);
    message.yaw = static_cast<float>(turned_yaw_rad(yaw_rad));
    return message;
}

/// The numbers of a contact, here and there.
struct ContactNumber {
    double suction::LipContact::*ours;
    double CupContact::*theirs;
};
constexpr ContactNumber kContactNumbers[] = {
    {&suction::LipContact::gap_m, &CupContact::gap_m},
    {&suction::LipContact::tilt_rad, &CupContact::tilt_rad},
    {&suction::LipContact::press_N, &CupContact::press_N},
    {&suction::LipContact::pull_N, &CupContact::pull_N},
    {&suction::LipContact::peel_N_m, &CupContact::peel_N_m},
    {&suction::LipContact::pull_margin_N, &CupContact::pull_margin_N},
    {&suction::LipContact::shear_margin_N, &CupContact::shear_margin_N},
    {&suction::LipContact::peel_margin_N, &CupContact::peel_margin_N},
};

}  // namespace

::ros::Time ros_time(double time_s) {
    return ::ros::Time(std::max(time_s, 0.0));
}

geometry_msgs::PoseStamped pose_message(const Estimate& estimate) {
    auto message = in_frame<geometry_msgs::PoseStamped>(kWorld);
    put(enu_from_ned(estimate.p_WB_m), message.pose.position);
    put(estimate.q_WB, message.pose.orientation);
    return message;
}

std::optional<PoseReading> pose_reading(const geometry_msgs::PoseStamped& message) {
    const auto q_WB = attitude(message.pose.orientation);
    const auto p_WB_m = finite(enu_from_ned(triple(message.pose.position)));
    if (!q_WB || !p_WB_m) {
        return std::nullopt;
    }
    return PoseReading{.p_WB_m = *p_WB_m, .q_WB = *q_WB};
}

geometry_msgs::TwistStamped velocity_message(const Estimate& estimate) {
    auto message = in_frame<geometry_msgs::TwistStamped>(kWorld);
    put(enu_from_ned(estimate.v_WB_m_s), message.twist.linear);
    put(enu_from_ned(estimate.q_WB * estimate.w_WB_B_rad_s), message.twist.angular);
    return message;
}

std::optional<Vector3> velocity_W(const geometry_msgs::TwistStamped& message) {
    return finite(enu_from_ned(triple(message.twist.linear)));
}

sensor_msgs::Imu imu_message(const Estimate& estimate) {
    auto message = in_frame<sensor_msgs::Imu>(kBody);
    put(estimate.q_WB, message.orientation);
    put(flu_from_frd(estimate.w_WB_B_rad_s), message.angular_velocity);
    put(flu_from_frd(estimate.specific_force_B_m_s2), message.linear_acceleration);
    return message;
}

std::optional<Vector3> rate_B(const sensor_msgs::Imu& message) {
    return finite(flu_from_frd(triple(message.angular_velocity)));
}

sensor_msgs::Range range_message(const RangeReading& reading, std::string_view frame,
                                 double minimum_m, double maximum_m) {
    constexpr double kFieldOfView_deg = 3.6;  // TFmini Plus, its data sheet
    auto message = in_frame<sensor_msgs::Range>(frame);
    message.radiation_type = sensor_msgs::Range::INFRARED;
    message.field_of_view = static_cast<float>(radians(kFieldOfView_deg));
    message.min_range = static_cast<float>(minimum_m);
    message.max_range = static_cast<float>(maximum_m);
    message.range = reading.valid ? static_cast<float>(reading.distance_m)
                                  : std::numeric_limits<float>::infinity();
    return message;
}

std::optional<RangeReading> range_reading(const sensor_msgs::Range& message) {
    const bool valid = std::isfinite(message.range) && message.range >= message.min_range &&
                       message.range <= message.max_range;
    return RangeReading{.distance_m = valid ? double{message.range} : 0.0, .valid = valid};
}

geometry_msgs::WrenchStamped force_message(const ForceReading& reading) {
    auto message = in_frame<geometry_msgs::WrenchStamped>(record::kCarriageFrame);
    message.wrench.force.x = reading.axial_N;
    return message;
}

std::optional<ForceReading> force_reading(const geometry_msgs::WrenchStamped& message) {
    const ForceReading reading{.axial_N = message.wrench.force.x};
    return std::isfinite(reading.axial_N) ? std::optional(reading) : std::nullopt;
}

sensor_msgs::FluidPressure pressure_message(const PressureReading& reading) {
    auto message = in_frame<sensor_msgs::FluidPressure>(record::kLipFrame);
    message.fluid_pressure = reading.pressure_Pa;
    return message;
}

std::optional<PressureReading> pressure_reading(const sensor_msgs::FluidPressure& message) {
    const PressureReading reading{.pressure_Pa = message.fluid_pressure};
    return std::isfinite(reading.pressure_Pa) ? std::optional(reading) : std::nullopt;
}

sensor_msgs::BatteryState battery_message(const BatteryReading& reading) {
    auto message = in_frame<sensor_msgs::BatteryState>(kBody);
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

PositionTarget target_message(const PositionSetpoint& target) {
    const bool with_velocity = !target.feedforward_v_W_m_s.isZero(0.0);
    auto message = target_of(kNoAcceleration | (with_velocity ? 0 : kNoVelocity), target.yaw_rad);
    put(enu_from_ned(target.p_W_m), message.position);
    put(enu_from_ned(target.feedforward_v_W_m_s), message.velocity);
    return message;
}

PositionTarget target_message(const VelocitySetpoint& target) {
    const bool with_acceleration = !target.feedforward_a_W_m_s2.isZero(0.0);
    auto message =
        target_of(kNoPosition | (with_acceleration ? 0 : kNoAcceleration), target.yaw_rad);
    put(enu_from_ned(target.v_W_m_s), message.velocity);
    put(enu_from_ned(target.feedforward_a_W_m_s2), message.acceleration_or_force);
    return message;
}

AttitudeTarget target_message(const AttitudeSetpoint& target) {
    auto message = in_frame<AttitudeTarget>(kWorld);
    message.type_mask = kNoRates;
    put(target.q_WB, message.orientation);
    message.thrust = static_cast<float>(target.thrust);
    return message;
}

std::optional<Motion> motion_from(const PositionTarget& message) {
    const int mask = message.type_mask & ~PositionTarget::IGNORE_YAW_RATE;
    if (message.coordinate_frame != PositionTarget::FRAME_LOCAL_NED ||
        (message.type_mask & PositionTarget::IGNORE_YAW_RATE) == 0 || !std::isfinite(message.yaw)) {
        return std::nullopt;
    }
    /// What the mask leaves out is zero, and may be anything.
    const auto wanted = [mask](int none, const auto& sent) {
        return (mask & none) != 0 ? Vector3(Vector3::Zero()) : enu_from_ned(triple(sent));
    };
    const Vector3 p_W_m = wanted(kNoPosition, message.position);
    const Vector3 v_W_m_s = wanted(kNoVelocity, message.velocity);
    const Vector3 a_W_m_s2 = wanted(kNoAcceleration, message.acceleration_or_force);
    const double yaw_rad = turned_yaw_rad(message.yaw);
    if (!p_W_m.allFinite() || !v_W_m_s.allFinite() || !a_W_m_s2.allFinite()) {
        return std::nullopt;
    }
    if (mask == kNoAcceleration || mask == (kNoAcceleration | kNoVelocity)) {
        return PositionSetpoint{.p_W_m = p_W_m, .yaw_rad = yaw_rad, .feedforward_v_W_m_s = v_W_m_s};
    }
    if (mask == kNoPosition || mask == (kNoPosition | kNoAcceleration)) {
        return VelocitySetpoint{
            .v_W_m_s = v_W_m_s, .yaw_rad = yaw_rad, .feedforward_a_W_m_s2 = a_W_m_s2};
    }
    return std::nullopt;
}

std::optional<Motion> motion_from(const AttitudeTarget& message) {
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

CupContact contact_message(const suction::LipContact& contact) {
    auto message = in_frame<CupContact>(record::kLipFrame);
    message.touches = contact.touches ? 1 : 0;
    message.lies_still = contact.lies_still ? 1 : 0;
    message.let_go = static_cast<std::uint8_t>(contact.let_go);
    for (const ContactNumber& number : kContactNumbers) {
        message.*number.theirs = contact.*number.ours;
    }
    return message;
}

std::optional<suction::LipContact> lip_contact(const CupContact& message) {
    suction::LipContact contact{.touches = message.touches != 0,
                                .lies_still = message.lies_still != 0,
                                .let_go = static_cast<suction::LetGo>(message.let_go)};
    bool sound = message.let_go <= CupContact::PEELED;
    for (const ContactNumber& number : kContactNumbers) {
        contact.*number.ours = message.*number.theirs;
        sound = sound && std::isfinite(contact.*number.ours);
    }
    return sound ? std::optional(contact) : std::nullopt;
}

limpet_ros::CupState cup_message(const suction::CupState& state) {
    auto message = in_frame<limpet_ros::CupState>(record::kLipFrame);
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
