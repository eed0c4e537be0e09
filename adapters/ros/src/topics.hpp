// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limpet_ros/State.h>
#include <ros/ros.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "adapters/ros/src/raw_message.hpp"

namespace limpet::ros {

inline constexpr std::uint32_t kQueue = 1000;  ///< nothing is to be lost on one machine

/// Whether a message of the definition with this sum is read as a Message is: the same definition,
/// or one whose fields are the same and whose constants are others, which the sum counts too.
template <class Message>
[[nodiscard]] bool understands(std::string_view md5) {
    if (md5 == ::ros::message_traits::MD5Sum<Message>::value()) {
        return true;
    }
    // Of mavros_msgs 1.0 to 1.4, which had no constants.
    return std::is_same_v<Message, limpet_ros::State> && md5 == "ce783f756cab1193cb71ba9e90fece50";
}

/// Small messages, each of which counts at once: none may wait for the next. A peer whose
/// definition is another one is logged once, and ignored.
/// @param call  takes a Message
template <class Message, class Call>
[[nodiscard]] ::ros::Subscriber listen(::ros::NodeHandle& node, const std::string& topic,
                                       Call call) {
    using Raw = ::ros::MessageEvent<const RawMessage>;
    const auto logged = std::make_shared<std::set<std::string>>();
    const boost::function<void(const Raw&)> receive = [call, logged, topic](const Raw& event) {
        auto& peer = event.getConnectionHeader();
        if (!understands<Message>(peer["md5sum"])) {
            if (logged->insert(peer["callerid"] + peer["md5sum"]).second) {
                ROS_ERROR(
                    "%s: %s sends %s of another definition (md5 %s), understood is %s (md5 %s)",
                    topic.c_str(), peer["callerid"].c_str(), peer["type"].c_str(),
                    peer["md5sum"].c_str(), ::ros::message_traits::DataType<Message>::value(),
                    ::ros::message_traits::MD5Sum<Message>::value());
            }
            return;
        }
        std::vector<std::uint8_t> bytes = event.getMessage()->bytes;
        ::ros::serialization::IStream stream(bytes.data(),
                                             static_cast<std::uint32_t>(bytes.size()));
        Message message;
        try {
            ::ros::serialization::deserialize(stream, message);
        } catch (const std::exception& error) {
            ROS_WARN_THROTTLE(5.0, "%s: a message that is cut short: %s", topic.c_str(),
                              error.what());
            return;
        }
        call(message);
    };
    ::ros::SubscribeOptions options;
    options.initByFullCallbackType<const Raw&>(topic, kQueue, receive);
    options.datatype = ::ros::message_traits::DataType<Message>::value();
    options.transport_hints = ::ros::TransportHints().tcpNoDelay();
    return node.subscribe(options);
}

template <class Message>
void send(const ::ros::Publisher& to, Message message, const ::ros::Time& stamp) {
    message.header.stamp = stamp;
    to.publish(message);
}

}  // namespace limpet::ros
