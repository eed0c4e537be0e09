// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/transport.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/wire/stream_transport.hpp"

namespace limpet::wire {
namespace {

std::string why_not(const TransportAddress& address, int error) {
    const bool serial = address.medium == Medium::serial;
    switch (error) {
        case EADDRINUSE: return fmt::format("port {} is in use by another program", address.port);
        case EADDRNOTAVAIL:
            return fmt::format("{} is no address of this machine",
                               address.interface.empty() ? address.host : address.interface);
        case ENODEV:
            return serial ? "there is no such device"
                          : "no network card leads there; name one: @INTERFACE";
        case EACCES:
        case EPERM:
            return serial ? "not allowed to this user (is he in the group dialout?)"
                          : fmt::format("port {} is not allowed to this user", address.port);
        case ENOENT:
        case ENXIO: return "there is no such device";
        case EBUSY: return "in use by another program";
        case ENOTTY: return "is not a serial port";
        case EINVAL:
            return serial ? fmt::format("the device does not do {} baud", address.baud)
                          : std::strerror(error);
        default: return std::strerror(error);
    }
}

}  // namespace

void refuse_address(const TransportAddress& address, int error) {
    throw InputError(fmt::format("address '{}': {}", to_text(address), why_not(address, error)));
}

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
