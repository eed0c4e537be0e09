// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>

#include "limpet/core/errors.hpp"

namespace limpet::ros {

/// A plugin of gzserver becomes a part of the node that it is: gazebo_ros's, or one of ours.
/// @throws InputError where there is no master
inline void join_ros(const std::string& plugin) {
    if (!::ros::isInitialized()) {
        int argc = 0;
        ::ros::init(argc, nullptr, "gazebo",
                    ::ros::init_options::NoSigintHandler | ::ros::init_options::AnonymousName);
    }
    if (!::ros::master::check()) {
        throw InputError(plugin + ": no ROS master at " + ::ros::master::getURI() +
                         ": start roscore or roslaunch first");
    }
}

}  // namespace limpet::ros
