// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <vector>

namespace limpet::ros {

/// A message as it came in, whatever its definition: roscpp itself drops a peer of another one
/// without a word to the node that listens.
struct RawMessage {
    std::vector<std::uint8_t> bytes;
};

}  // namespace limpet::ros

// What roscpp needs of a message: any definition, bytes as they are.
namespace ros::message_traits {
template <>
struct IsMessage<limpet::ros::RawMessage> : TrueType {};
template <>
struct MD5Sum<limpet::ros::RawMessage> {
    static const char* value() { return "*"; }
    static const char* value(const limpet::ros::RawMessage&) { return value(); }
};
template <>
struct DataType<limpet::ros::RawMessage> {
    static const char* value() { return "*"; }
    static const char* value(const limpet::ros::RawMessage&) { return value(); }
};
}  // namespace ros::message_traits
namespace ros::serialization {
template <>
struct Serializer<limpet::ros::RawMessage> {
    template <class Stream>
    static void read(Stream& stream, limpet::ros::RawMessage& message) {
        const std::uint32_t size = stream.getLength();
        const std::uint8_t* const bytes = stream.advance(size);
        message.bytes.assign(bytes, bytes + size);
    }
};
}  // namespace ros::serialization
