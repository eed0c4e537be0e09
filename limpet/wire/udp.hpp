// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/wire/transport.hpp"

namespace limpet::wire {

/// listen: bound to the address, hears and answers one at a time: another is heard, and then
/// answered, only once the former has been silent for 2 s (for a group: joined, hears all, answers
/// who spoke last). connect: sends to the address; hears a single host's port alone, and for
/// broadcast and multicast answers who spoke last.
/// @throws InputError when the port is in use, the address not of this machine, or the group not
/// joined
[[nodiscard]] std::unique_ptr<Transport> open_udp(const TransportAddress& address, Role role);

/// As PX4's links: bound to a port of its own, speaks to `first` until somebody speaks to it, and
/// from then on to that one alone; what others send is dropped.
/// @param local  port 0: the kernel chooses
/// @throws InputError when the port is in use or the address not of this machine
[[nodiscard]] std::unique_ptr<Transport> open_udp_between(const TransportAddress& local,
                                                          const TransportAddress& first);

}  // namespace limpet::wire
