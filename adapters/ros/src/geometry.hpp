// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

namespace limpet::ros {

/// Into a message's x, y, z, and out of them; along the axes of the message.
template <class Message>
void put(const Vector3& v, Message& message) {
    message.x = v.x();
    message.y = v.y();
    message.z = v.z();
}
template <class Message>
[[nodiscard]] Vector3 triple(const Message& message) {
    return {message.x, message.y, message.z};
}

}  // namespace limpet::ros
