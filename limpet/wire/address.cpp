// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "limpet/core/errors.hpp"

namespace limpet::wire {
namespace {

// Autopilots' telemetry runs from 57600 on; 3 Mbaud is what USB bridges (FT232R) still do.
constexpr unsigned kLowestBaud = 57600;
constexpr unsigned kHighestBaud = 3000000;

struct Scheme {
    std::string_view name;
    Medium medium;
};
constexpr std::array kSchemes = {Scheme{"tcp", Medium::tcp}, Scheme{"udp", Medium::udp},
                                 Scheme{"udp-broadcast", Medium::udp_broadcast},
                                 Scheme{"udp-multicast", Medium::udp_multicast},
                                 Scheme{"serial", Medium::serial}};

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
        in_addr ignored{};
        if (digits.find('\0') != std::string::npos ||
            inet_pton(AF_INET, digits.c_str(), &ignored) != 1) {
            refuse(fmt::format("{} '{}' is not an IPv4 address in digits", what, name));
        }
        return digits;
    }
};

bool is_multicast(const std::string& host) {
    in_addr address{};
    inet_pton(AF_INET, host.c_str(), &address);
    return (ntohl(address.s_addr) >> 28) == 0xE;  // 224.0.0.0/4, RFC 5771
}

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
    if (group && !is_multicast(address.host)) {
        parsed.refuse(
            fmt::format("group '{}' is not in 224.0.0.0 to 239.255.255.255", address.host));
    }
    if (!group && is_multicast(address.host)) {
        parsed.refuse(
            fmt::format("'{}' is a multicast group; ask for it with udp-multicast:", address.host));
    }
    if (!group && address.host == "255.255.255.255" && address.medium != Medium::udp_broadcast) {
        parsed.refuse("255.255.255.255 is a broadcast; ask for it with udp-broadcast:");
    }
}

std::optional<Medium> medium_of(std::string_view name) {
    for (const Scheme& scheme : kSchemes) {
        if (scheme.name == name) {
            return scheme.medium;
        }
    }
    return std::nullopt;
}

}  // namespace

TransportAddress parse_address(std::string_view text) {
    const Parsed parsed{text};
    const std::size_t colon = text.find(':');
    const std::optional<Medium> medium = medium_of(text.substr(0, colon));
    if (colon == std::string_view::npos || !medium) {
        parsed.refuse(fmt::format("allowed are {}", kForms));
    }
    TransportAddress address;
    address.medium = *medium;
    if (*medium == Medium::serial) {
        read_serial(parsed, text.substr(colon + 1), address);
    } else {
        read_network(parsed, text.substr(colon + 1), address);
    }
    return address;
}

std::string to_text(const TransportAddress& address) {
    std::string_view scheme;
    for (const Scheme& each : kSchemes) {
        if (each.medium == address.medium) {
            scheme = each.name;
        }
    }
    if (address.medium == Medium::serial) {
        return fmt::format("{}:{}:{}", scheme, address.device, address.baud);
    }
    return fmt::format("{}:{}:{}{}{}", scheme, address.host, address.port,
                       address.interface.empty() ? "" : "@", address.interface);
}

}  // namespace limpet::wire
