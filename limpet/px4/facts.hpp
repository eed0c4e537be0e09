// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "limpet/mavlink/messages.hpp"

namespace limpet::px4 {

/// A parameter's type by its number in MAVLink and in a `.params` file.
using Px4Type = mavlink::MavParamType::Value;

/// Which PX4 is set up: some parameters are gone in newer ones.
enum class Px4Version {
    released,  ///< v1.15, v1.16
    main,      ///< of 2026-05 or later, v1.18
};

/// What PX4 v1.15.1 says of one of its parameters, or a build of its own.
struct Px4Fact {
    Px4Type type;
    double default_value;
    double minimum;  ///< -infinity: PX4 states none
    double maximum;  ///< +infinity: PX4 states none
    bool gone;       ///< Px4Version::main has it no more
};
using Px4Facts = std::map<std::string, Px4Fact, std::less<>>;

/// @return nullptr for others than those that an airframe of ours sets, or may set
///         (parameters.json)
[[nodiscard]] const Px4Fact* find_px4_fact(std::string_view name);

/// What a PX4 that was built says of its parameters itself.
/// @param build  its build folder
/// @return nothing where it has no parameters.json
/// @throws InputError when that is not one
[[nodiscard]] std::optional<Px4Facts> px4_facts_of(const std::filesystem::path& build);

}  // namespace limpet::px4
