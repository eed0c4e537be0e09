// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/mavlink/messages.hpp"

namespace limpet::px4 {

/// A parameter's type by its number in MAVLink and in a `.params` file.
using Px4Type = mavlink::MavParamType::Value;

/// What PX4 v1.15.1 says of one of its parameters.
struct Px4Fact {
    Px4Type type;
    double default_value;
    double minimum;  ///< -infinity: PX4 states none
    double maximum;  ///< +infinity: PX4 states none
};

/// @return nullptr for others than those that an airframe of ours sets, or may set
///         (parameters.json)
[[nodiscard]] const Px4Fact* find_px4_fact(std::string_view name);

}  // namespace limpet::px4
