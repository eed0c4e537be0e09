// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include "limpet/models/model_writer.hpp"

namespace limpet::ros {

/// The vehicle's URDF, where ROS 1 looks for it: a parameter. Its links are named as the frames of
/// messages, its meshes are files of this machine.
/// @return what has to stay for that: nothing here
inline ::ros::Publisher publish_description(const ::ros::NodeHandle& node,
                                            const vehicle::Airframe& airframe) {
    node.setParam("robot_description",
                  write_robot_description(airframe, models::MeshNames::of_files));
    return {};
}

}  // namespace limpet::ros
