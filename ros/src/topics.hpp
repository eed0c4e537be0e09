// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <string>

namespace limpet::ros {

inline constexpr std::uint32_t kQueue = 1000;  ///< nothing is to be lost on one machine

/// Small messages, each of which counts at once: none may wait for the next.
/// @param call  takes a Message
template <class Message, class Call>
[[nodiscard]] ::ros::Subscriber listen(::ros::NodeHandle& node, const std::string& topic,
                                       Call call) {
    return node.subscribe<Message>(
        topic, kQueue,
        boost::function<void(const boost::shared_ptr<const Message>&)>(
            [call](const boost::shared_ptr<const Message>& message) { call(*message); }),
        ::ros::VoidConstPtr(), ::ros::TransportHints().tcpNoDelay());
}

template <class Message>
void send(const ::ros::Publisher& to, Message message, const ::ros::Time& stamp) {
    message.header.stamp = stamp;
    to.publish(message);
}

}  // namespace limpet::ros
