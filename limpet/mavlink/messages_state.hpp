// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "limpet/mavlink/layout.hpp"

/// What the vehicle says of itself: to a ground station, to a companion.
/// Units and names are those of the wire. Source: MAVLink common.xml; PX4 v1.15 where named.
namespace limpet::mavlink {

/// At 1 Hz, from everybody.
struct Heartbeat {
    static constexpr std::uint32_t kId = 0;
    static constexpr std::string_view kName = "HEARTBEAT";
    std::uint8_t type = 0;             ///< MAV_TYPE
    std::uint8_t autopilot = 0;        ///< MAV_AUTOPILOT
    std::uint8_t base_mode = 0;        ///< MAV_MODE_FLAG
    std::uint32_t custom_mode = 0;     ///< PX4: main mode in bits 16-23
    std::uint8_t system_status = 0;    ///< MAV_STATE
    std::uint8_t mavlink_version = 0;  ///< 3
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("type", &Heartbeat::type),
                          field("autopilot", &Heartbeat::autopilot),
                          field("base_mode", &Heartbeat::base_mode),
                          field("custom_mode", &Heartbeat::custom_mode),
                          field("system_status", &Heartbeat::system_status),
                          field("mavlink_version", &Heartbeat::mavlink_version));
    }
};

/// Sensors and supply.
struct SysStatus {
    static constexpr std::uint32_t kId = 1;
    static constexpr std::string_view kName = "SYS_STATUS";
    /// MAV_SYS_STATUS_SENSOR
    std::uint32_t onboard_control_sensors_present = 0, onboard_control_sensors_enabled = 0,
                  onboard_control_sensors_health = 0;
    std::uint16_t load = 0;             ///< [0.1 %]
    std::uint16_t voltage_battery = 0;  ///< [mV], 65535 unknown
    std::int16_t current_battery = 0;   ///< [cA], -1 unknown
    std::int8_t battery_remaining = 0;  ///< [%], -1 unknown
    std::uint16_t drop_rate_comm = 0;   ///< [0.01 %]
    std::uint16_t errors_comm = 0, errors_count1 = 0, errors_count2 = 0, errors_count3 = 0,
                  errors_count4 = 0;
    std::uint32_t onboard_control_sensors_present_extended = 0,
                  onboard_control_sensors_enabled_extended = 0,
                  onboard_control_sensors_health_extended = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("onboard_control_sensors_present", &SysStatus::onboard_control_sensors_present),
            field("onboard_control_sensors_enabled", &SysStatus::onboard_control_sensors_enabled),
            field("onboard_control_sensors_health", &SysStatus::onboard_control_sensors_health),
            field("load", &SysStatus::load), field("voltage_battery", &SysStatus::voltage_battery),
            field("current_battery", &SysStatus::current_battery),
            field("battery_remaining", &SysStatus::battery_remaining),
            field("drop_rate_comm", &SysStatus::drop_rate_comm),
            field("errors_comm", &SysStatus::errors_comm),
            field("errors_count1", &SysStatus::errors_count1),
            field("errors_count2", &SysStatus::errors_count2),
            field("errors_count3", &SysStatus::errors_count3),
            field("errors_count4", &SysStatus::errors_count4),
            extension("onboard_control_sensors_present_extended",
                      &SysStatus::onboard_control_sensors_present_extended),
            extension("onboard_control_sensors_enabled_extended",
                      &SysStatus::onboard_control_sensors_enabled_extended),
            extension("onboard_control_sensors_health_extended",
                      &SysStatus::onboard_control_sensors_health_extended));
    }
};

struct SystemTime {
    static constexpr std::uint32_t kId = 2;
    static constexpr std::string_view kName = "SYSTEM_TIME";
    std::uint64_t time_unix_usec = 0;  ///< since 1970 [us]
    std::uint32_t time_boot_ms = 0;    ///< since boot
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_unix_usec", &SystemTime::time_unix_usec),
                          field("time_boot_ms", &SystemTime::time_boot_ms));
    }
};

struct Ping {
    static constexpr std::uint32_t kId = 4;
    static constexpr std::string_view kName = "PING";
    std::uint64_t time_usec = 0;  ///< since boot or 1970 [us]
    std::uint32_t seq = 0;
    std::uint8_t target_system = 0, target_component = 0;  ///< 0 asks; else the answer to
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_usec", &Ping::time_usec), field("seq", &Ping::seq),
                          field("target_system", &Ping::target_system),
                          field("target_component", &Ping::target_component));
    }
};

/// B in W (NED), Euler 3-2-1.
struct Attitude {
    static constexpr std::uint32_t kId = 30;
    static constexpr std::string_view kName = "ATTITUDE";
    std::uint32_t time_boot_ms = 0;                     ///< since boot
    float roll = 0, pitch = 0, yaw = 0;                 ///< [rad]
    float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< in B [rad/s]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &Attitude::time_boot_ms),
                          field("roll", &Attitude::roll), field("pitch", &Attitude::pitch),
                          field("yaw", &Attitude::yaw), field("rollspeed", &Attitude::rollspeed),
                          field("pitchspeed", &Attitude::pitchspeed),
                          field("yawspeed", &Attitude::yawspeed));
    }
};

struct AttitudeQuaternion {
    static constexpr std::uint32_t kId = 31;
    static constexpr std::string_view kName = "ATTITUDE_QUATERNION";
    std::uint32_t time_boot_ms = 0;  ///< since boot
    /// q_WB, w x y z
    float q1 = 0, q2 = 0, q3 = 0, q4 = 0;
    float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< in B [rad/s]
    std::array<float, 4> repr_offset_q = {};
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_boot_ms", &AttitudeQuaternion::time_boot_ms),
            field("q1", &AttitudeQuaternion::q1), field("q2", &AttitudeQuaternion::q2),
            field("q3", &AttitudeQuaternion::q3), field("q4", &AttitudeQuaternion::q4),
            field("rollspeed", &AttitudeQuaternion::rollspeed),
            field("pitchspeed", &AttitudeQuaternion::pitchspeed),
            field("yawspeed", &AttitudeQuaternion::yawspeed),
            extension("repr_offset_q", &AttitudeQuaternion::repr_offset_q));
    }
};

struct LocalPositionNed {
    static constexpr std::uint32_t kId = 32;
    static constexpr std::string_view kName = "LOCAL_POSITION_NED";
    std::uint32_t time_boot_ms = 0;  ///< since boot
    float x = 0, y = 0, z = 0;       ///< p_WB [m]
    float vx = 0, vy = 0, vz = 0;    ///< v_WB_W [m/s]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &LocalPositionNed::time_boot_ms),
                          field("x", &LocalPositionNed::x), field("y", &LocalPositionNed::y),
                          field("z", &LocalPositionNed::z), field("vx", &LocalPositionNed::vx),
                          field("vy", &LocalPositionNed::vy), field("vz", &LocalPositionNed::vz));
    }
};

struct GlobalPositionInt {
    static constexpr std::uint32_t kId = 33;
    static constexpr std::string_view kName = "GLOBAL_POSITION_INT";
    std::uint32_t time_boot_ms = 0;          ///< since boot
    std::int32_t lat = 0, lon = 0;           ///< [1e-7 deg]
    std::int32_t alt = 0, relative_alt = 0;  ///< above sea, above home [mm]
    std::int16_t vx = 0, vy = 0, vz = 0;     ///< north, east, down [cm/s]
    std::uint16_t hdg = 0;                   ///< [cdeg], 65535 unknown
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_boot_ms", &GlobalPositionInt::time_boot_ms),
            field("lat", &GlobalPositionInt::lat), field("lon", &GlobalPositionInt::lon),
            field("alt", &GlobalPositionInt::alt),
            field("relative_alt", &GlobalPositionInt::relative_alt),
            field("vx", &GlobalPositionInt::vx), field("vy", &GlobalPositionInt::vy),
            field("vz", &GlobalPositionInt::vz), field("hdg", &GlobalPositionInt::hdg));
    }
};

struct BatteryStatus {
    static constexpr std::uint32_t kId = 147;
    static constexpr std::string_view kName = "BATTERY_STATUS";
    std::uint8_t id = 0, battery_function = 0, type = 0;  ///< MAV_BATTERY_FUNCTION, _TYPE
    std::int16_t temperature = 0;                         ///< [cdegC], 32767 unknown
    std::array<std::uint16_t, 10> voltages = {};          ///< of cells [mV], 65535 none
    std::int16_t current_battery = 0;                     ///< [cA], -1 unknown
    std::int32_t current_consumed = 0;                    ///< [mAh], -1 unknown
    std::int32_t energy_consumed = 0;                     ///< [hJ], -1 unknown
    std::int8_t battery_remaining = 0;                    ///< [%], -1 unknown
    std::int32_t time_remaining = 0;                      ///< [s]
    std::uint8_t charge_state = 0;
    std::array<std::uint16_t, 4> voltages_ext = {};  ///< [mV], 0 none
    std::uint8_t mode = 0;
    std::uint32_t fault_bitmask = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("id", &BatteryStatus::id),
                          field("battery_function", &BatteryStatus::battery_function),
                          field("type", &BatteryStatus::type),
                          field("temperature", &BatteryStatus::temperature),
                          field("voltages", &BatteryStatus::voltages),
                          field("current_battery", &BatteryStatus::current_battery),
                          field("current_consumed", &BatteryStatus::current_consumed),
                          field("energy_consumed", &BatteryStatus::energy_consumed),
                          field("battery_remaining", &BatteryStatus::battery_remaining),
                          extension("time_remaining", &BatteryStatus::time_remaining),
                          extension("charge_state", &BatteryStatus::charge_state),
                          extension("voltages_ext", &BatteryStatus::voltages_ext),
                          extension("mode", &BatteryStatus::mode),
                          extension("fault_bitmask", &BatteryStatus::fault_bitmask));
    }
};

/// Who it is, when asked (MAV_CMD_REQUEST_MESSAGE).
struct AutopilotVersion {
    static constexpr std::uint32_t kId = 148;
    static constexpr std::string_view kName = "AUTOPILOT_VERSION";
    std::uint64_t capabilities = 0;  ///< MAV_PROTOCOL_CAPABILITY
    /// major, minor, patch, FIRMWARE_VERSION_TYPE: a byte each from the top
    std::uint32_t flight_sw_version = 0, middleware_sw_version = 0, os_sw_version = 0;
    std::uint32_t board_version = 0;
    std::array<std::uint8_t, 8> flight_custom_version = {}, middleware_custom_version = {},
                                os_custom_version = {};
    std::uint16_t vendor_id = 0, product_id = 0;
    std::uint64_t uid = 0;
    std::array<std::uint8_t, 18> uid2 = {};
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("capabilities", &AutopilotVersion::capabilities),
            field("flight_sw_version", &AutopilotVersion::flight_sw_version),
            field("middleware_sw_version", &AutopilotVersion::middleware_sw_version),
            field("os_sw_version", &AutopilotVersion::os_sw_version),
            field("board_version", &AutopilotVersion::board_version),
            field("flight_custom_version", &AutopilotVersion::flight_custom_version),
            field("middleware_custom_version", &AutopilotVersion::middleware_custom_version),
            field("os_custom_version", &AutopilotVersion::os_custom_version),
            field("vendor_id", &AutopilotVersion::vendor_id),
            field("product_id", &AutopilotVersion::product_id),
            field("uid", &AutopilotVersion::uid), extension("uid2", &AutopilotVersion::uid2));
    }
};

/// Innovations over their gates.
struct EstimatorStatus {
    static constexpr std::uint32_t kId = 230;
    static constexpr std::string_view kName = "ESTIMATOR_STATUS";
    std::uint64_t time_usec = 0;  ///< since boot or 1970 [us]
    std::uint16_t flags = 0;      ///< ESTIMATOR_STATUS_FLAGS
    /// 1: at the gate
    float vel_ratio = 0, pos_horiz_ratio = 0, pos_vert_ratio = 0, mag_ratio = 0, hagl_ratio = 0,
          tas_ratio = 0;
    float pos_horiz_accuracy = 0, pos_vert_accuracy = 0;  ///< 1 sigma [m]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_usec", &EstimatorStatus::time_usec),
                          field("flags", &EstimatorStatus::flags),
                          field("vel_ratio", &EstimatorStatus::vel_ratio),
                          field("pos_horiz_ratio", &EstimatorStatus::pos_horiz_ratio),
                          field("pos_vert_ratio", &EstimatorStatus::pos_vert_ratio),
                          field("mag_ratio", &EstimatorStatus::mag_ratio),
                          field("hagl_ratio", &EstimatorStatus::hagl_ratio),
                          field("tas_ratio", &EstimatorStatus::tas_ratio),
                          field("pos_horiz_accuracy", &EstimatorStatus::pos_horiz_accuracy),
                          field("pos_vert_accuracy", &EstimatorStatus::pos_vert_accuracy));
    }
};

struct HomePosition {
    static constexpr std::uint32_t kId = 242;
    static constexpr std::string_view kName = "HOME_POSITION";
    std::int32_t latitude = 0, longitude = 0;  ///< [1e-7 deg]
    std::int32_t altitude = 0;                 ///< above sea [mm]
    float x = 0, y = 0, z = 0;                 ///< in W [m]
    std::array<float, 4> q = {};
    float approach_x = 0, approach_y = 0, approach_z = 0;  ///< [m]
    std::uint64_t time_usec = 0;                           ///< [us]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("latitude", &HomePosition::latitude),
                          field("longitude", &HomePosition::longitude),
                          field("altitude", &HomePosition::altitude), field("x", &HomePosition::x),
                          field("y", &HomePosition::y), field("z", &HomePosition::z),
                          field("q", &HomePosition::q),
                          field("approach_x", &HomePosition::approach_x),
                          field("approach_y", &HomePosition::approach_y),
                          field("approach_z", &HomePosition::approach_z),
                          extension("time_usec", &HomePosition::time_usec));
    }
};

struct ExtendedSysState {
    static constexpr std::uint32_t kId = 245;
    static constexpr std::string_view kName = "EXTENDED_SYS_STATE";
    std::uint8_t vtol_state = 0, landed_state = 0;  ///< MAV_VTOL_STATE, MAV_LANDED_STATE
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("vtol_state", &ExtendedSysState::vtol_state),
                          field("landed_state", &ExtendedSysState::landed_state));
    }
};

/// A number with a name: cup pressure, force.
struct NamedValueFloat {
    static constexpr std::uint32_t kId = 251;
    static constexpr std::string_view kName = "NAMED_VALUE_FLOAT";
    std::uint32_t time_boot_ms = 0;  ///< since boot
    std::array<char, 10> name = {};  ///< no NUL when full
    float value = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &NamedValueFloat::time_boot_ms),
                          field("name", &NamedValueFloat::name),
                          field("value", &NamedValueFloat::value));
    }
};

struct StatusText {
    static constexpr std::uint32_t kId = 253;
    static constexpr std::string_view kName = "STATUSTEXT";
    std::uint8_t severity = 0;       ///< MAV_SEVERITY
    std::array<char, 50> text = {};  ///< no NUL when full
    std::uint16_t id = 0;            ///< of a text in chunks, 0 whole
    std::uint8_t chunk_seq = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("severity", &StatusText::severity),
                          field("text", &StatusText::text), extension("id", &StatusText::id),
                          extension("chunk_seq", &StatusText::chunk_seq));
    }
};

/// PX4's events interface.
struct EventMessage {
    static constexpr std::uint32_t kId = 410;
    static constexpr std::string_view kName = "EVENT";
    std::uint8_t destination_component = 0, destination_system = 0;
    std::uint32_t id = 0;
    std::uint32_t event_time_boot_ms = 0;
    std::uint16_t sequence = 0;
    std::uint8_t log_levels = 0;  ///< external, internal: 4 bits each
    std::array<std::uint8_t, 40> arguments = {};
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("destination_component", &EventMessage::destination_component),
                          field("destination_system", &EventMessage::destination_system),
                          field("id", &EventMessage::id),
                          field("event_time_boot_ms", &EventMessage::event_time_boot_ms),
                          field("sequence", &EventMessage::sequence),
                          field("log_levels", &EventMessage::log_levels),
                          field("arguments", &EventMessage::arguments));
    }
};

}  // namespace limpet::mavlink
