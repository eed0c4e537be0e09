// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/socket_errors.hpp"

#include <fmt/format.h>

#include <cerrno>

#include "limpet/core/errors.hpp"

namespace limpet::wire {

void refuse_address(const TransportAddress& address, const boost::system::error_code& error) {
    std::string why;
    switch (error.value()) {
        case EADDRINUSE:
            why = fmt::format("port {} is in use by another program", address.port);
            break;
        case EADDRNOTAVAIL:
            why = fmt::format("{} is no address of this machine",
                              address.interface.empty() ? address.host : address.interface);
            break;
        case EACCES: why = fmt::format("port {} is not allowed to this user", address.port); break;
        case ENODEV: why = "no network card leads there; name one: @INTERFACE"; break;
        default: why = error.message();
    }
    throw InputError(fmt::format("address '{}': {}", to_text(address), why));
}

}  // namespace limpet::wire
