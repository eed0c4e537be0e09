// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::record {

/// Messages of a kind that does not become columns: no fault of the file's.
struct NotTaken : InputError {
    using InputError::InputError;
};

/// The basic types of a .msg file; `byte` and `char` are read as uint8.
enum class Primitive {
    boolean,
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64,
    string,
    time,  ///< builtin_interfaces/msg/Time, read as seconds
};

/// One line of a .msg file that is no constant.
struct Field {
    enum class Shape {
        single,
        fixed_array,
        dynamic_array
    };

    std::string name;
    Primitive primitive = Primitive::float64;  ///< if nested_type is empty
    std::string nested_type;                   ///< full: "geometry_msgs/msg/Point"
    Shape shape = Shape::single;
    std::size_t count = 1;  ///< of a fixed array
};

struct MessageType {
    std::string name;  ///< full: "geometry_msgs/msg/Pose"
    std::vector<Field> fields;
};

/// Reads one .msg text: comments, constants, default values, bounds and arrays of every kind.
/// @param name  full or short name of the type; names without a package are looked up in its
/// package
/// @throws NotTaken for text of wide characters
/// @throws InputError naming type and line
[[nodiscard]] MessageType parse_message_type(const std::string& name, const std::string& text);

/// Reads a schema in MCAP's encoding "ros2msg".
/// @return the types that it defines, the one called `name` first
/// @throws NotTaken for text of wide characters
/// @throws InputError naming type and line
[[nodiscard]] std::vector<MessageType> parse_ros2msg(const std::string& name,
                                                     const std::string& text);

/// "geometry_msgs/msg/Point" -> "geometry_msgs/Point"
[[nodiscard]] std::string short_type_name(std::string_view full);
/// "geometry_msgs/Point" -> "geometry_msgs/msg/Point"; a full name stays, also one of a service
[[nodiscard]] std::string full_type_name(std::string_view name);

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
/// @return its text and that of all it depends on, separated as MCAP's encoding "ros2msg" requires
/// @throws InternalError for a type that is not there
[[nodiscard]] std::string ros2msg_schema(std::string_view type, std::size_t rotors = 4);

/// The same of a message that holds a stamp and a float64 for each column.
[[nodiscard]] std::string column_schema(std::span<const std::string_view> columns);

}  // namespace limpet::record
