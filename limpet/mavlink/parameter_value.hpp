// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>

#include "limpet/mavlink/messages.hpp"

/// PX4's way to send an integer: its bytes, in the float of PARAM_VALUE and PARAM_SET.
/// Source: mavlink.io, parameter protocol, "bytewise"
namespace limpet::mavlink {

[[nodiscard]] inline float parameter_on_wire(double value, bool int32) {
    auto sent = static_cast<float>(value);
    if (int32) {
        const auto whole = static_cast<std::int32_t>(value);
        std::memcpy(&sent, &whole, sizeof(sent));
    }
    return sent;
}

/// @tparam Message  ParamValue or ParamSet
template <class Message>
[[nodiscard]] double parameter_value(const Message& message) {
    std::int32_t whole = 0;
    std::memcpy(&whole, &message.param_value, sizeof(whole));
    return message.param_type == MavParamType::int32 ? whole : double{message.param_value};
}

}  // namespace limpet::mavlink
