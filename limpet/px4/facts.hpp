// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace limpet::px4 {

/// A parameter's type by its number in MAVLink (MAV_PARAM_TYPE) and in a `.params` file.
enum class Px4Type {
    int32 = 6,
    real32 = 9
};

/// What PX4 v1.15.1 says of one of its parameters.
struct Px4Fact {
    std::string_view name;
    Px4Type type;
    double default_value;
    double minimum;  ///< -infinity: PX4 states none
    double maximum;  ///< +infinity: PX4 states none
};

/// Those that an airframe of ours sets, or may set. Enumerations range from their least to their
/// largest value.
/// Source: `parameters.json` of px4_sitl_default, built at tag v1.15.1 (93eef0c787).
[[nodiscard]] const std::vector<Px4Fact>& px4_facts();

/// @return nullptr when it is not among them
[[nodiscard]] const Px4Fact* find_px4_fact(std::string_view name);

}  // namespace limpet::px4
