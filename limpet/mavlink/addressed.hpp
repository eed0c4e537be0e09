// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/mavlink/codec.hpp"

namespace limpet::mavlink {

/// Whether a message with a target is for this system and component; 0 is for all.
template <class Message>
[[nodiscard]] bool addressed_to(const Sender& self, const Message& message) {
    return (message.target_system == 0 || message.target_system == self.system) &&
           (message.target_component == 0 || message.target_component == self.component);
}

}  // namespace limpet::mavlink
