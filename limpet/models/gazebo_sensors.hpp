// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "limpet/models/gazebo_world.hpp"

namespace limpet::models::sdf {

/// Adds to a model of write_vehicle(): imu, lidar_left, lidar_right and contacts on the base;
/// slider_force on the slider. Without a cup the imu alone.
void write_sensors(pugi::xml_node model, const vehicle::Airframe& airframe,
                   const GazeboSensors& sensors);

/// Appends a static model whose camera saves what it sees.
void write_camera(pugi::xml_node world, const GazeboCamera& camera);

/// x y z roll pitch yaw of something that looks along its own x and is level.
[[nodiscard]] std::string looking(const Viewpoint& view);

}  // namespace limpet::models::sdf
