// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/address.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/address_v4.hpp>
#include <charconv>

#include "limpet/core/errors.hpp"

namespace limpet::wire {
namespace {

using boost::asio::ip::make_address_v4;

// Autopilots' telemetry runs from 57600 on; 3 Mbaud is what USB bridges (FT232R) still do.
constexpr unsigned kLowestBaud = 57600;
constexpr unsigned kHighestBaud = 3000000;

constexpr std::array<std::string_view, 5> kSchemes = {  // by Medium
    "tcp", "udp", "udp-broadcast", "udp-multicast", "serial"};

constexpr const char* kForms =
    "tcp:127.0.0.1:4560, udp:127.0.0.1:14550, udp-broadcast:HOST:PORT, "
    "udp-multicast:GROUP:PORT[@INTERFACE], serial:/dev/ttyACM0:921600";

/// Carries the whole text, so that every refusal names it.
struct Parsed {
    std::string_view text;

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("address '{}': {}", text, why));
    }
    [[nodiscard]] unsigned number(std::string_view digits, const char* what, unsigned lowest,
                                  unsigned highest) const {
        unsigned value = 0;
        const char* end = digits.data() + digits.size();
        const auto [stop, error] = std::from_chars(digits.data(), end, value);
        if (error != std::errc() || stop != end || value < lowest || value > highest) {
            refuse(fmt::format("{} '{}' is not a whole number from {} to {}", what, digits, lowest,
                               highest));
        }
        return value;
    }
    [[nodiscard]] std::string host(std::string_view name, const char* what) const {
        std::string digits(name == "localhost" ? "127.0.0.1" : name);
        boost::system::error_code error;
        (void)make_address_v4(digits, error);
        if (error || digits.find('\0') != std::string::npos) {
            refuse(fmt::format("{} '{}' is not an IPv4 address in digits", what, name));
        }
        return digits;
    }
};

void read_serial(const Parsed& parsed, std::string_view rest, TransportAddress& address) {
    const std::size_t colon = rest.rfind(':');
    if (colon == std::string_view::npos || colon == 0) {
        parsed.refuse("allowed is serial:DEVICE:BAUD, as serial:/dev/ttyACM0:921600");
    }
    address.device = rest.substr(0, colon);
    address.host.clear();
    address.baud = parsed.number(rest.substr(colon + 1), "baud", kLowestBaud, kHighestBaud);
}

void read_network(const Parsed& parsed, std::string_view rest, TransportAddress& address) {
    const bool group = address.medium == Medium::udp_multicast;
    const bool loopback_is_meant = address.medium == Medium::tcp || address.medium == Medium::udp;
    if (const std::size_t at = rest.find('@'); group && at != std::string_view::npos) {
        address.interface = parsed.host(rest.substr(at + 1), "interface");
        rest = rest.substr(0, at);
    }
    const std::size_t colon = rest.rfind(':');
    if (colon != std::string_view::npos) {
        address.host = parsed.host(rest.substr(0, colon), "host");
        rest = rest.substr(colon + 1);
    } else if (!loopback_is_meant) {
        parsed.refuse("allowed is HOST:PORT after the scheme");
    }
    address.port = static_cast<std::uint16_t>(parsed.number(rest, "port", 1, 65535));
    const bool is_group = make_address_v4(address.host).is_multicast();
    if (group && !is_group) {
        parsed.refuse(
            fmt::format("group '{}' is not in 224.0.0.0 to 239.255.255.255", address.host));
    }
    if (!group && is_group) {
        parsed.refuse(fmt::format("'{}' is a multicast group; write udp-multicast:", address.host));
    }
    if (!group && address.host == "255.255.255.255" && address.medium != Medium::udp_broadcast) {
        parsed.refuse("255.255.255.255 is a broadcast; write udp-broadcast:");
    }
}

}  // namespace

TransportAddress parse_address(std::string_view text) {
    const Parsed parsed{text};
    const std::size_t colon = text.find(':');
    const auto scheme = std::find(kSchemes.begin(), kSchemes.end(), text.substr(0, colon));
    if (colon == std::string_view::npos || scheme == kSchemes.end()) {
        parsed.refuse(fmt::format("allowed are {}", kForms));
    }
    TransportAddress address;
    address.medium = static_cast<Medium>(scheme - kSchemes.begin());
    const auto read = address.medium == Medium::serial ? read_serial : read_network;
    read(parsed, text.substr(colon + 1), address);
    return address;
}

std::string to_text(const TransportAddress& address) {
    const std::string_view scheme = kSchemes.at(static_cast<std::size_t>(address.medium));
    if (address.medium == Medium::serial) {
        return fmt::format("{}:{}:{}", scheme, address.device, address.baud);
    }
    return fmt::format("{}:{}:{}{}{}", scheme, address.host, address.port,
                       address.interface.empty() ? "" : "@", address.interface);
}

}  // namespace limpet::wire
