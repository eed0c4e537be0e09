// SPDX-License-Identifier: Apache-2.0
#pragma once

// In place of adapters/ros/src/topics.hpp: what is ROS 1's own there (sums of definitions) means
// nothing to ROS 2. Found first, see adapters/ros2/CMakeLists.txt.

#include <ros/ros.h>

#include <cstdint>
#include <string>

namespace limpet::ros {

inline constexpr std::uint32_t kQueue = 1000;  ///< nothing is to be lost on one machine

/// @param call  takes a Message
template <class Message, class Call>
[[nodiscard]] ::ros::Subscriber listen(::ros::NodeHandle& node, const std::string& topic,
                                       Call call) {
    return node.subscribe<Message>(topic, kQueue, call);
}

template <class Message>
void send(const ::ros::Publisher& to, Message message, const ::ros::Time& stamp) {
    message.header.stamp = stamp;
    to.publish(message);
}

}  // namespace limpet::ros
