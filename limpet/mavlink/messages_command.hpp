// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "limpet/mavlink/layout.hpp"

/// What is asked of an autopilot: parameters, commands, set-points, clocks.
/// Units and names are those of the wire. Source: MAVLink common.xml; PX4 v1.15 where named.
namespace limpet::mavlink {

struct ParamRequestRead {
    static constexpr std::uint32_t kId = 20;
    static constexpr std::string_view kName = "PARAM_REQUEST_READ";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::array<char, 16> param_id = {};                    ///< no NUL when full
    std::int16_t param_index = 0;                          ///< -1: by name
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &ParamRequestRead::target_system),
                          field("target_component", &ParamRequestRead::target_component),
                          field("param_id", &ParamRequestRead::param_id),
                          field("param_index", &ParamRequestRead::param_index));
    }
};

struct ParamRequestList {
    static constexpr std::uint32_t kId = 21;
    static constexpr std::string_view kName = "PARAM_REQUEST_LIST";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &ParamRequestList::target_system),
                          field("target_component", &ParamRequestList::target_component));
    }
};

struct ParamValue {
    static constexpr std::uint32_t kId = 22;
    static constexpr std::string_view kName = "PARAM_VALUE";
    std::array<char, 16> param_id = {};  ///< no NUL when full
    float param_value = 0;               ///< PX4: an integer's bytes
    std::uint8_t param_type = 0;         ///< MAV_PARAM_TYPE
    std::uint16_t param_count = 0, param_index = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("param_id", &ParamValue::param_id),
                          field("param_value", &ParamValue::param_value),
                          field("param_type", &ParamValue::param_type),
                          field("param_count", &ParamValue::param_count),
                          field("param_index", &ParamValue::param_index));
    }
};

struct ParamSet {
    static constexpr std::uint32_t kId = 23;
    static constexpr std::string_view kName = "PARAM_SET";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::array<char, 16> param_id = {};                    ///< no NUL when full
    float param_value = 0;                                 ///< PX4: an integer's bytes
    std::uint8_t param_type = 0;                           ///< MAV_PARAM_TYPE
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &ParamSet::target_system),
                          field("target_component", &ParamSet::target_component),
                          field("param_id", &ParamSet::param_id),
                          field("param_value", &ParamSet::param_value),
                          field("param_type", &ParamSet::param_type));
    }
};

struct SetGpsGlobalOrigin {
    static constexpr std::uint32_t kId = 48;
    static constexpr std::string_view kName = "SET_GPS_GLOBAL_ORIGIN";
    std::uint8_t target_system = 0;
    std::int32_t latitude = 0, longitude = 0;  ///< [1e-7 deg]
    std::int32_t altitude = 0;                 ///< above sea [mm]
    std::uint64_t time_usec = 0;               ///< [us]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &SetGpsGlobalOrigin::target_system),
                          field("latitude", &SetGpsGlobalOrigin::latitude),
                          field("longitude", &SetGpsGlobalOrigin::longitude),
                          field("altitude", &SetGpsGlobalOrigin::altitude),
                          extension("time_usec", &SetGpsGlobalOrigin::time_usec));
    }
};

struct CommandLong {
    static constexpr std::uint32_t kId = 76;
    static constexpr std::string_view kName = "COMMAND_LONG";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::uint16_t command = 0;                             ///< MAV_CMD
    std::uint8_t confirmation = 0;                         ///< times sent before
    /// as the command says
    float param1 = 0, param2 = 0, param3 = 0, param4 = 0, param5 = 0, param6 = 0, param7 = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("target_system", &CommandLong::target_system),
            field("target_component", &CommandLong::target_component),
            field("command", &CommandLong::command),
            field("confirmation", &CommandLong::confirmation),
            field("param1", &CommandLong::param1), field("param2", &CommandLong::param2),
            field("param3", &CommandLong::param3), field("param4", &CommandLong::param4),
            field("param5", &CommandLong::param5), field("param6", &CommandLong::param6),
            field("param7", &CommandLong::param7));
    }
};

struct CommandAck {
    static constexpr std::uint32_t kId = 77;
    static constexpr std::string_view kName = "COMMAND_ACK";
    std::uint16_t command = 0;  ///< MAV_CMD
    std::uint8_t result = 0;    ///< MAV_RESULT
    std::uint8_t progress = 0;  ///< [%], 255 unknown
    std::int32_t result_param2 = 0;
    std::uint8_t target_system = 0, target_component = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("command", &CommandAck::command),
                          field("result", &CommandAck::result),
                          extension("progress", &CommandAck::progress),
                          extension("result_param2", &CommandAck::result_param2),
                          extension("target_system", &CommandAck::target_system),
                          extension("target_component", &CommandAck::target_component));
    }
};

struct SetAttitudeTarget {
    static constexpr std::uint32_t kId = 82;
    static constexpr std::string_view kName = "SET_ATTITUDE_TARGET";
    std::uint32_t time_boot_ms = 0;                                    ///< since boot
    std::uint8_t target_system = 0, target_component = 0;              ///< 0: all
    std::uint8_t type_mask = 0;                                        ///< bit set: ignored
    std::array<float, 4> q = {};                                       ///< q_WB, w x y z
    float body_roll_rate = 0, body_pitch_rate = 0, body_yaw_rate = 0;  ///< in B [rad/s]
    float thrust = 0;                                                  ///< collective, 0..1
    std::array<float, 3> thrust_body = {};                             ///< in B, -1..1
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &SetAttitudeTarget::time_boot_ms),
                          field("target_system", &SetAttitudeTarget::target_system),
                          field("target_component", &SetAttitudeTarget::target_component),
                          field("type_mask", &SetAttitudeTarget::type_mask),
                          field("q", &SetAttitudeTarget::q),
                          field("body_roll_rate", &SetAttitudeTarget::body_roll_rate),
                          field("body_pitch_rate", &SetAttitudeTarget::body_pitch_rate),
                          field("body_yaw_rate", &SetAttitudeTarget::body_yaw_rate),
                          field("thrust", &SetAttitudeTarget::thrust),
                          extension("thrust_body", &SetAttitudeTarget::thrust_body));
    }
};

struct AttitudeTarget {
    static constexpr std::uint32_t kId = 83;
    static constexpr std::string_view kName = "ATTITUDE_TARGET";
    std::uint32_t time_boot_ms = 0;                                    ///< since boot
    std::uint8_t type_mask = 0;                                        ///< bit set: ignored
    std::array<float, 4> q = {};                                       ///< q_WB, w x y z
    float body_roll_rate = 0, body_pitch_rate = 0, body_yaw_rate = 0;  ///< in B [rad/s]
    float thrust = 0;                                                  ///< collective, 0..1
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &AttitudeTarget::time_boot_ms),
                          field("type_mask", &AttitudeTarget::type_mask),
                          field("q", &AttitudeTarget::q),
                          field("body_roll_rate", &AttitudeTarget::body_roll_rate),
                          field("body_pitch_rate", &AttitudeTarget::body_pitch_rate),
                          field("body_yaw_rate", &AttitudeTarget::body_yaw_rate),
                          field("thrust", &AttitudeTarget::thrust));
    }
};

struct SetPositionTargetLocalNed {
    static constexpr std::uint32_t kId = 84;
    static constexpr std::string_view kName = "SET_POSITION_TARGET_LOCAL_NED";
    std::uint32_t time_boot_ms = 0;                        ///< since boot
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::uint8_t coordinate_frame = 0;                     ///< MAV_FRAME, 1 local NED
    std::uint16_t type_mask = 0;                           ///< bit set: ignored
    float x = 0, y = 0, z = 0;                             ///< p_WB [m]
    float vx = 0, vy = 0, vz = 0;                          ///< v_WB_W [m/s]
    float afx = 0, afy = 0, afz = 0;                       ///< acceleration in W [m/s^2]
    float yaw = 0;                                         ///< [rad]
    float yaw_rate = 0;                                    ///< [rad/s]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_boot_ms", &SetPositionTargetLocalNed::time_boot_ms),
            field("target_system", &SetPositionTargetLocalNed::target_system),
            field("target_component", &SetPositionTargetLocalNed::target_component),
            field("coordinate_frame", &SetPositionTargetLocalNed::coordinate_frame),
            field("type_mask", &SetPositionTargetLocalNed::type_mask),
            field("x", &SetPositionTargetLocalNed::x), field("y", &SetPositionTargetLocalNed::y),
            field("z", &SetPositionTargetLocalNed::z), field("vx", &SetPositionTargetLocalNed::vx),
            field("vy", &SetPositionTargetLocalNed::vy),
            field("vz", &SetPositionTargetLocalNed::vz),
            field("afx", &SetPositionTargetLocalNed::afx),
            field("afy", &SetPositionTargetLocalNed::afy),
            field("afz", &SetPositionTargetLocalNed::afz),
            field("yaw", &SetPositionTargetLocalNed::yaw),
            field("yaw_rate", &SetPositionTargetLocalNed::yaw_rate));
    }
};

struct PositionTargetLocalNed {
    static constexpr std::uint32_t kId = 85;
    static constexpr std::string_view kName = "POSITION_TARGET_LOCAL_NED";
    std::uint32_t time_boot_ms = 0;     ///< since boot
    std::uint8_t coordinate_frame = 0;  ///< MAV_FRAME, 1 local NED
    std::uint16_t type_mask = 0;        ///< bit set: ignored
    float x = 0, y = 0, z = 0;          ///< p_WB [m]
    float vx = 0, vy = 0, vz = 0;       ///< v_WB_W [m/s]
    float afx = 0, afy = 0, afz = 0;    ///< acceleration in W [m/s^2]
    float yaw = 0;                      ///< [rad]
    float yaw_rate = 0;                 ///< [rad/s]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_boot_ms", &PositionTargetLocalNed::time_boot_ms),
            field("coordinate_frame", &PositionTargetLocalNed::coordinate_frame),
            field("type_mask", &PositionTargetLocalNed::type_mask),
            field("x", &PositionTargetLocalNed::x), field("y", &PositionTargetLocalNed::y),
            field("z", &PositionTargetLocalNed::z), field("vx", &PositionTargetLocalNed::vx),
            field("vy", &PositionTargetLocalNed::vy), field("vz", &PositionTargetLocalNed::vz),
            field("afx", &PositionTargetLocalNed::afx), field("afy", &PositionTargetLocalNed::afy),
            field("afz", &PositionTargetLocalNed::afz), field("yaw", &PositionTargetLocalNed::yaw),
            field("yaw_rate", &PositionTargetLocalNed::yaw_rate));
    }
};

struct TimeSync {
    static constexpr std::uint32_t kId = 111;
    static constexpr std::string_view kName = "TIMESYNC";
    std::int64_t tc1 = 0, ts1 = 0;  ///< [ns]; tc1 0 asks
    std::uint8_t target_system = 0, target_component = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("tc1", &TimeSync::tc1), field("ts1", &TimeSync::ts1),
                          extension("target_system", &TimeSync::target_system),
                          extension("target_component", &TimeSync::target_component));
    }
};

/// How long is your mission?
struct MissionRequestList {
    static constexpr std::uint32_t kId = 43;
    static constexpr std::string_view kName = "MISSION_REQUEST_LIST";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::uint8_t mission_type = 0;                         ///< MAV_MISSION_TYPE
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &MissionRequestList::target_system),
                          field("target_component", &MissionRequestList::target_component),
                          extension("mission_type", &MissionRequestList::mission_type));
    }
};

struct MissionCount {
    static constexpr std::uint32_t kId = 44;
    static constexpr std::string_view kName = "MISSION_COUNT";
    std::uint8_t target_system = 0, target_component = 0;  ///< 0: all
    std::uint16_t count = 0;
    std::uint8_t mission_type = 0;  ///< MAV_MISSION_TYPE
    std::uint32_t opaque_id = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &MissionCount::target_system),
                          field("target_component", &MissionCount::target_component),
                          field("count", &MissionCount::count),
                          extension("mission_type", &MissionCount::mission_type),
                          extension("opaque_id", &MissionCount::opaque_id));
    }
};

/// Hands a key over in the clear. Limpet refuses it.
struct SetupSigning {
    static constexpr std::uint32_t kId = 256;
    static constexpr std::string_view kName = "SETUP_SIGNING";
    std::uint8_t target_system = 0, target_component = 0;
    std::array<std::uint8_t, 32> secret_key = {};
    std::uint64_t initial_timestamp = 0;  ///< [10 us] since 2015
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("target_system", &SetupSigning::target_system),
                          field("target_component", &SetupSigning::target_component),
                          field("secret_key", &SetupSigning::secret_key),
                          field("initial_timestamp", &SetupSigning::initial_timestamp));
    }
};

}  // namespace limpet::mavlink
