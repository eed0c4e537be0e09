// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace limpet::wire {

/// What carries the bytes.
enum class Medium {
    tcp,
    udp,
    udp_broadcast,  ///< a scheme of its own, so that nobody floods a network by a typing error
    udp_multicast,
    serial,
};

/// Where a transport listens or connects, or which serial port it opens.
struct TransportAddress {
    Medium medium = Medium::tcp;
    std::string host = "127.0.0.1";  ///< IPv4 in digits
    std::uint16_t port = 0;          ///< 0: the kernel chooses; parse_address never gives it
    std::string interface = {};      ///< multicast: IPv4 of the network card, empty: by the routes
    std::string device = {};         ///< serial: path
    unsigned baud = 0;               ///< serial [1/s]
};

/// Reads one of
///   tcp:HOST:PORT  udp:HOST:PORT  udp-broadcast:HOST:PORT
///   udp-multicast:GROUP:PORT[@INTERFACE]  serial:DEVICE:BAUD
/// HOST is an IPv4 address in digits or `localhost`; tcp:PORT and udp:PORT mean 127.0.0.1. Whether
/// the device is there is found out when it is opened.
/// @throws InputError naming text, part and what is allowed: unknown scheme, port outside 1..65535,
///         baud outside 57600..3000000, a group outside 224.0.0.0/4, a group where none belongs
[[nodiscard]] TransportAddress parse_address(std::string_view text);

/// @return the text that parse_address reads as the same address
[[nodiscard]] std::string to_text(const TransportAddress& address);

}  // namespace limpet::wire
