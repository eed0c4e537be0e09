// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/models/gazebo_world.hpp"
#include "limpet/scenario/scenario.hpp"

namespace limpet::scenario {

/// The world in which LimpetVehiclePlugin flies a scenario: its wall, its ground, the vehicle where
/// it starts.
/// @param wanted  how the plugin finds the scenario: a name, or a file's path
/// @param sets    overrides with which `scenario` was loaded
[[nodiscard]] models::GazeboWorld world_of(const Scenario& scenario, const std::string& wanted,
                                           const std::vector<std::string>& sets);

/// Gazebo's own sensors with the ranges and rates of ours.
[[nodiscard]] models::GazeboSensors gazebo_sensors(const sensors::SensorParameters& sensors);

/// A wall of each surface in a row, named wall_SURFACE, and before each a vehicle that stands still
/// in the air, its lip at the wall.
[[nodiscard]] models::GazeboWorld showroom(const vehicle::Airframe& airframe,
                                           const std::vector<Surface>& surfaces);

}  // namespace limpet::scenario
