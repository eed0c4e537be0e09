// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

/// What the messages made of messages.xml are made with. Each is a plain struct with kId, kName,
/// kInfo and fields(), its fields as they follow each other on the wire.
namespace limpet::mavlink {

struct MessageInfo {
    std::uint32_t id = 0;
    std::string_view name = {};
    std::uint8_t crc_extra = 0;
    std::size_t payload_bytes = 0;             ///< with extensions
    std::size_t bytes_without_extensions = 0;  ///< what MAVLink 1 knows
};

template <class Message, class Value>
struct Field {
    std::string_view name;
    Value Message::*member;
};
template <class Message, class Value>
Field(std::string_view, Value Message::*) -> Field<Message, Value>;

/// Calls visit(name, value) for each field, in the order of the wire.
template <class Message, class Visit>
constexpr void for_each_field(Message& message, Visit&& visit) {
    std::apply([&](const auto&... each) { (visit(each.name, message.*each.member), ...); },
               std::remove_const_t<Message>::fields());
}

/// Calls each(element) for each element of a field: of an array, or the one number.
template <class Value, class Each>
constexpr void for_each_element(Value& value, Each&& each) {
    if constexpr (std::is_arithmetic_v<Value>) {
        each(value);
    } else {
        for (auto& element : value) {
            each(element);
        }
    }
}

}  // namespace limpet::mavlink
