// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "limpet/px4/wires.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::gazebo11 {

/// Elements of LimpetVehiclePlugin, described in vehicle_plugin.hpp.
struct VehicleOptions {
    enum class Autopilot {
        builtin,
        px4,
    };
    enum class WhenOver {
        quit,
        pause,
    };
    scenario::Scenario scenario;
    Autopilot autopilot = Autopilot::builtin;
    px4::Px4Addresses px4;
    std::filesystem::path recording;
    std::filesystem::path result;
    double speed = 0.0;
    std::optional<std::uint16_t> live;  ///< port; none: nobody watches
    WhenOver when_over = WhenOver::pause;
};

/// Names of what read_vehicle_options() reads.
[[nodiscard]] std::vector<std::string_view> vehicle_elements();

/// @param parameters  of the plugin, see sdf_tree()
/// @param allowed     vehicle_elements(), and those that are read elsewhere
/// @throws InputError in one line
[[nodiscard]] VehicleOptions read_vehicle_options(const scenario::YamlNode& parameters,
                                                  const std::vector<std::string_view>& allowed);

}  // namespace limpet::gazebo11
