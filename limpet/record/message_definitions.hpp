// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace limpet::record {

/// One ROS 2 interface in the text form of a .msg file.
struct MessageDefinition {
    std::string_view type;  ///< "limpet_msgs/msg/CupState"
    std::string_view text;
};

/// Every message that a recording uses, and what those are made of. Fields of ROS's own messages
/// are in ROS's order, which is what CDR goes by; Range is that of ROS 2 Jazzy, whose last field
/// older readers leave unread. Field names of ours are lower-case, as ROS 2 wants them; read back,
/// a column carries the unit as we write it: `pressure_pa` becomes `pressure_Pa` (units.hpp).
[[nodiscard]] std::span<const MessageDefinition> message_definitions();

/// @param type    one of message_definitions()
/// @param rotors  of the vehicle: the length of fields that have a number for each
/// @return its text and that of all it depends on, separated as MCAP's encoding "ros2msg" asks for
/// @throws InternalError for a type that is not there
[[nodiscard]] std::string ros2msg_schema(std::string_view type, std::size_t rotors = 4);

/// The same of a message that holds a stamp and a float64 for each column.
[[nodiscard]] std::string column_schema(std::span<const std::string_view> columns);

}  // namespace limpet::record
