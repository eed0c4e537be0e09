// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/core/signals/truth.hpp"

/// Our signals as ROS 2 messages in CDR: ROS's own in its frames (ros_frames.hpp), limpet_msgs as
/// they are. The fields stand in message_definitions.cpp.
namespace limpet::record::messages {

/// Room for the longest message; a run reuses one, so that encoding allocates nothing.
struct Buffer {
    std::array<char, 4096> bytes{};
    std::size_t used = 0;
};

/// A message in its Buffer: valid until the buffer takes the next one.
using Encoded = std::span<const std::uint8_t>;

/// What a Range message says of its sensor besides the reading.
struct RangeSensor {
    double field_of_view_rad = radians(3.6);  ///< Source: TFmini Plus data sheet
    double minimum_m = 0.1;                   ///< Source: TFmini Plus data sheet
    double maximum_m = 12.0;                  ///< Source: TFmini Plus data sheet
};

// Every function takes the message's time stamp in nanoseconds. A text has at most 256 characters,
// else InternalError: texts are names and reasons.

[[nodiscard]] Encoded imu(Buffer& buffer, std::int64_t time_ns, const ImuReading& reading);
/// An invalid reading is +infinity (REP 117: nothing within range).
[[nodiscard]] Encoded range(Buffer& buffer, std::int64_t time_ns, std::string_view frame,
                            const RangeSensor& sensor, const RangeReading& reading);
[[nodiscard]] Encoded pressure(Buffer& buffer, std::int64_t time_ns, std::string_view frame,
                               double pressure_Pa);
[[nodiscard]] Encoded battery(Buffer& buffer, std::int64_t time_ns, const BatteryReading& reading);
/// In "map".
[[nodiscard]] Encoded pose(Buffer& buffer, std::int64_t time_ns, const Vector3& p_WB_m,
                           const Quaternion& q_WB);
/// In "base_link", both parts, as nav_msgs/Odometry has it.
[[nodiscard]] Encoded twist(Buffer& buffer, std::int64_t time_ns, const Quaternion& q_WB,
                            const Vector3& v_WB_W_m_s, const Vector3& w_WB_B_rad_s);
/// @param wrench  in a forward-right-down frame called `frame` when turned to forward-left-up
[[nodiscard]] Encoded wrench(Buffer& buffer, std::int64_t time_ns, std::string_view frame,
                             const Wrench& wrench);
[[nodiscard]] Encoded vehicle_truth(Buffer& buffer, std::int64_t time_ns, const Truth& truth);
[[nodiscard]] Encoded cup_state(Buffer& buffer, std::int64_t time_ns, const CupStatus& status);
[[nodiscard]] Encoded setpoint(Buffer& buffer, std::int64_t time_ns, const Setpoint& setpoint);
[[nodiscard]] Encoded guidance_state(Buffer& buffer, std::int64_t time_ns, std::string_view state,
                                     int attempt);
[[nodiscard]] Encoded rotor_command(Buffer& buffer, std::int64_t time_ns,
                                    const RotorCommand& command);
/// A stamp and numbers: column_schema() of message_definitions.hpp.
[[nodiscard]] Encoded columns(Buffer& buffer, std::int64_t time_ns,
                              std::span<const double> numbers);
[[nodiscard]] Encoded event(Buffer& buffer, std::int64_t time_ns, const Event& event);

}  // namespace limpet::record::messages
