// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/transport.hpp"

#include "limpet/core/errors.hpp"
#include "limpet/wire/serial.hpp"
#include "limpet/wire/tcp.hpp"
#include "limpet/wire/udp.hpp"

namespace limpet::wire {

std::unique_ptr<Transport> open_transport(const TransportAddress& address, Role role) {
    switch (address.medium) {
        case Medium::tcp: return role == Role::listen ? listen_tcp(address) : connect_tcp(address);
        case Medium::udp:
        case Medium::udp_broadcast:
        case Medium::udp_multicast: return open_udp(address, role);
        case Medium::serial: return open_serial(address);
    }
    throw InternalError("open_transport: no such medium");
}

}  // namespace limpet::wire
