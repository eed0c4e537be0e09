// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/system/error_code.hpp>
#include <string>

#include "limpet/wire/address.hpp"

namespace limpet::wire {

/// Says in one line why an address cannot be used.
/// @throws InputError always
[[noreturn]] void refuse_address(const TransportAddress& address,
                                 const boost::system::error_code& error);

/// @return "peer 127.0.0.1:5000" or "nobody there", of a socket that may be open
template <class Socket>
[[nodiscard]] std::string peer_text(const Socket& socket) {
    boost::system::error_code error;
    const auto peer = socket.remote_endpoint(error);
    return error ? "nobody there"
                 : "peer " + peer.address().to_string() + ":" + std::to_string(peer.port());
}

}  // namespace limpet::wire
