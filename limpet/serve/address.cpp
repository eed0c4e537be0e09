// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/address.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/address.hpp>
#include <charconv>

#include "limpet/core/errors.hpp"

namespace limpet::serve {
namespace {

constexpr auto kDigits = "0123456789";

std::string unescape(std::string_view text, bool plus_is_space) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '+' && plus_is_space) {
            plain += ' ';
        } else if (text[i] != '%') {
            plain += text[i];
        } else {
            unsigned byte = 0;
            const std::string_view digits = text.substr(i + 1, 2);
            const auto [end, error] =
                std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
            if (digits.size() != 2 || error != std::errc() || end != digits.data() + 2 ||
                byte == 0) {
                throw InputError("the address has a bad escape: % and two digits of 0-9, a-f");
            }
            plain += static_cast<char>(byte);
            i += 2;
        }
    }
    return plain;
}

}  // namespace

Target parse_target(std::string_view target, std::string_view wanted) {
    if (target.empty() || target.front() != '/') {
        throw InputError("the address is no path: it begins with /");
    }
    Target parsed;
    const std::size_t question = std::min(target.find('?'), target.size());
    std::string_view path = target.substr(0, question);
    const std::string_view first = path.substr(1, path.find('/', 1) - 1);
    if (!wanted.empty() && same_token(first, wanted)) {
        parsed.token = first;
        path.remove_prefix(1 + first.size());
    }
    parsed.request.path = path.empty() ? "/" : unescape(path, false);
    for (std::string_view rest = target.substr(std::min(question + 1, target.size()));
         !rest.empty();) {
        const std::size_t end = std::min(rest.find('&'), rest.size());
        const std::string_view pair = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::size_t equals = std::min(pair.find('='), pair.size());
        std::string key = unescape(pair.substr(0, equals), true);
        std::string value = unescape(pair.substr(std::min(equals + 1, pair.size())), true);
        if (key == "token") {
            parsed.token = std::move(value);
        } else {
            parsed.request.query.emplace_back(std::move(key), std::move(value));
        }
    }
    return parsed;
}

bool same_token(std::string_view shown, std::string_view wanted) {
    unsigned differs = shown.size() == wanted.size() ? 0U : 1U;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        differs |= static_cast<unsigned>(wanted[i] ^ (i < shown.size() ? shown[i] : '\0'));
    }
    return differs == 0;
}

bool host_allowed(std::string_view host) {
    std::string_view name = host;
    std::string_view port;
    if (host.substr(0, 1) == "[") {
        const std::size_t end = host.find(']');
        if (end == std::string_view::npos) {
            return false;
        }
        name = host.substr(1, end - 1);
        port = host.substr(end + 1);
    } else if (const std::size_t colon = host.find(':'); colon != std::string_view::npos) {
        name = host.substr(0, colon);
        port = host.substr(colon);
    }
    if (!port.empty() &&
        (port.front() != ':' || port.find_first_not_of(kDigits, 1) != std::string_view::npos)) {
        return false;
    }
    boost::system::error_code error;
    (void)boost::asio::ip::make_address(std::string(name), error);
    return name == "localhost" || !error;
}

bool origin_allowed(std::string_view origin, std::string_view host,
                    const std::vector<std::string>& others) {
    // "http://localhost:*" is any port of it.
    const std::string_view page = origin.substr(0, origin.rfind(':') + 1);
    const std::string_view port = origin.substr(page.size());
    const bool has_port = !port.empty() && port.find_first_not_of(kDigits) == port.npos;
    return origin.empty() || origin == "http://" + std::string(host) ||
           std::any_of(others.begin(), others.end(), [&](const std::string& other) {
               return other == origin || (has_port && other == std::string(page) + "*");
           });
}

std::string Request::value(std::string_view key, std::string_view otherwise) const {
    const auto found = std::find_if(query.begin(), query.end(),
                                    [key](const auto& pair) { return pair.first == key; });
    return found != query.end() ? found->second : std::string(otherwise);
}

std::string make_token() {
    std::array<unsigned char, 16> bytes{};
    const bool random = getrandom(bytes.data(), bytes.size(), 0) == ssize_t{bytes.size()};
    require(random, "the kernel has 16 random bytes");
    std::string token;
    for (const unsigned byte : bytes) {
        token += "0123456789abcdef"[byte >> 4U];
        token += "0123456789abcdef"[byte & 15U];
    }
    return token;
}

}  // namespace limpet::serve
