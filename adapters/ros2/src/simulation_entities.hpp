// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <simulation_interfaces/Bounds.h>
#include <simulation_interfaces/EntityFilters.h>
#include <simulation_interfaces/EntityInfo.h>
#include <simulation_interfaces/EntityState.h>
#include <simulation_interfaces/Result.h>

#include <string>
#include <vector>

#include "adapters/ros2/src/simulator.hpp"

namespace limpet::ros {

[[nodiscard]] simulation_interfaces::Result result(std::uint8_t code, std::string why = {});

/// What simulation_interfaces call an entity: the vehicle, under its file's name, and "wall".
struct Entity {
    std::string name;
    bool moves = false;
    simulation_interfaces::EntityInfo info{};
    simulation_interfaces::EntityState state{};  ///< in frame "map", the velocities too
    simulation_interfaces::Bounds bounds{};      ///< a box in its own axes
};
/// @return none without a world
[[nodiscard]] std::vector<Entity> entities_of(const Simulator& simulator);

/// Those that a filter lets through.
/// @param left  is made of `all`
/// @return ok, or what of the filter cannot be had
[[nodiscard]] simulation_interfaces::Result filter(
    const std::vector<Entity>& all, const simulation_interfaces::EntityFilters& filters,
    std::vector<Entity>& left);

/// Whether a sphere meets a box that lies somewhere.
/// @param box_pose  of the axes in which the box is
[[nodiscard]] bool overlaps(const geometry_msgs::Pose& box_pose,
                            const simulation_interfaces::Bounds& box, const Vector3& centre_map_m,
                            double radius_m);

/// @param base  where the vehicle is; what is to be set is changed in it
/// @return empty, or why this is no pose or no twist
[[nodiscard]] std::string read_pose(const geometry_msgs::Pose& pose, Kinematics& base);
[[nodiscard]] std::string read_twist(const geometry_msgs::Twist& twist, Kinematics& base);

}  // namespace limpet::ros
