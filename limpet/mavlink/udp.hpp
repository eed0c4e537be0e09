// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/mavlink/transport.hpp"

namespace limpet {

/// listen: bound to the address (for a group: joined), sends to who spoke last. connect: sends to
/// the address; hears a single host's port alone, and for broadcast and multicast answers who spoke
/// last.
/// @throws InputError when the port is in use, the address not of this machine, or the group not
/// joined
[[nodiscard]] std::unique_ptr<Transport> open_udp(const TransportAddress& address, Role role);

}  // namespace limpet
