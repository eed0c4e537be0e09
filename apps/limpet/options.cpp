// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <fmt/format.h>

#include <string_view>

#include "limpet/core/errors.hpp"

namespace limpet::app {
namespace {

struct Form {
    std::string_view scheme;
    std::string_view text;
};

Form form_of(wire::Medium medium) {
    switch (medium) {
        case wire::Medium::tcp: return {"tcp:", "tcp:HOST:PORT"};
        case wire::Medium::udp: return {"udp:", "udp:HOST:PORT"};
        case wire::Medium::udp_broadcast: return {"udp-broadcast:", "udp-broadcast:HOST:PORT"};
        case wire::Medium::udp_multicast:
            return {"udp-multicast:", "udp-multicast:GROUP:PORT[@INTERFACE]"};
        case wire::Medium::serial: return {"serial:", "serial:DEVICE:BAUD"};
    }
    throw InternalError("unknown medium");
}

}  // namespace

wire::TransportAddress address_of(const std::string& option, const std::string& text,
                                  std::initializer_list<wire::Medium> media) {
    std::string forms;
    for (const wire::Medium medium : media) {
        const Form form = form_of(medium);
        if (text.rfind(form.scheme, 0) == 0) {
            try {
                return wire::parse_address(text);
            } catch (const InputError& error) {
                throw InputError(option + ": " + error.what());
            }
        }
        forms += (forms.empty() ? "" : " or ") + std::string(form.text);
    }
    throw InputError(fmt::format("{} '{}': must be {}", option, text, forms));
}

}  // namespace limpet::app
