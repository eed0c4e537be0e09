// SPDX-License-Identifier: Apache-2.0
#pragma once

// In place of adapters/ros/src/description.hpp: ROS 2 looks for it on a topic. Found first, see
// adapters/ros2/CMakeLists.txt.

#include <ros/ros.h>
#include <std_msgs/String.h>

#include "limpet/models/model_writer.hpp"

namespace limpet::ros {

[[nodiscard]] inline ::ros::Publisher publish_description(::ros::NodeHandle& node,
                                                          const vehicle::Airframe& airframe) {
    ::ros::Publisher stays = node.advertise<std_msgs::String>("robot_description", 1, true);
    std_msgs::String text;
    text.data = models::write_robot_description(airframe);
    stays.publish(text);
    return stays;
}

}  // namespace limpet::ros
