// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "limpet/mavlink/layout.hpp"
#include "limpet/mavlink/messages_command.hpp"
#include "limpet/mavlink/messages_sensor.hpp"
#include "limpet/mavlink/messages_state.hpp"

/// The messages that Limpet speaks. A new one: its struct with fields() in one of the files above,
/// its name in AllMessages, its row in tests/mavlink/messages_test.cpp.
namespace limpet::mavlink {

/// By rising id.
using AllMessages =
    std::tuple<Heartbeat, SysStatus, SystemTime, Ping, ParamRequestRead, ParamRequestList,
               ParamValue, ParamSet, Attitude, AttitudeQuaternion, LocalPositionNed,
               GlobalPositionInt, MissionRequestList, MissionCount, SetGpsGlobalOrigin, CommandLong,
               CommandAck, SetAttitudeTarget, AttitudeTarget, SetPositionTargetLocalNed,
               PositionTargetLocalNed, HilActuatorControls, VisionPositionEstimate, HilSensor,
               TimeSync, HilGps, HilStateQuaternion, DistanceSensor, AttPosMocap, BatteryStatus,
               AutopilotVersion, EstimatorStatus, HomePosition, ExtendedSysState, NamedValueFloat,
               StatusText, SetupSigning, Odometry, EventMessage>;

struct MessageInfo {
    std::uint32_t id = 0;
    std::string_view name;
    std::uint8_t crc_extra = 0;
    std::size_t payload_bytes = 0;             ///< with extensions
    std::size_t bytes_without_extensions = 0;  ///< what MAVLink 1 knows
};

/// @return what is known of a message, nullptr when Limpet does not speak it
[[nodiscard]] const MessageInfo* find_message(std::uint32_t id);

/// @param text  a wire field; shorter texts are filled with NUL, longer ones cut
template <std::size_t n>
void set_text(std::array<char, n>& field, std::string_view text) {
    field.fill('\0');
    text.substr(0, n).copy(field.data(), n);
}

/// @return up to the first NUL or the field's end
template <std::size_t n>
[[nodiscard]] std::string_view text_of(const std::array<char, n>& field) {
    const std::string_view whole(field.data(), n);
    return whole.substr(0, whole.find('\0'));
}

}  // namespace limpet::mavlink
