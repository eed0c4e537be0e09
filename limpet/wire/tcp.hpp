// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/wire/transport.hpp"

namespace limpet::wire {

/// A server with one client at a time. A second one is accepted and closed at once, as soon as
/// receive, wait_for_peer or a waiting send runs; when the first is gone the next may come.
/// @throws InputError when the port is in use, is privileged, or the address is not of this machine
[[nodiscard]] std::unique_ptr<Transport> listen_tcp(const TransportAddress& address);

/// A client that keeps trying for as long as receive or wait_for_peer wait, and comes back after a
/// loss.
[[nodiscard]] std::unique_ptr<Transport> connect_tcp(const TransportAddress& address);

}  // namespace limpet::wire
