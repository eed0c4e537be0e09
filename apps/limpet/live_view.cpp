// SPDX-License-Identifier: Apache-2.0
#include "live_view.hpp"

#include <charconv>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::app {

std::uint16_t port_of(const LiveViewOptions& options) {
    const std::string& text = options.port;
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw InputError("--live " + text + ": must be a port, 0..65535 (0: any that is free)");
    }
    return port;
}

OptionList options_of(LiveViewOptions& options, bool waits) {
    OptionList all = {{"--live PORT",
                       [&options](const std::string& port) {
                           options.wanted = true;
                           options.port = port.empty() ? options.port : port;
                       },
                       "let the lab, Foxglove and Lichtblick watch, on this machine alone, in\n"
                       "real time (default port 8765; 0: any)",
                       values(0, 1)}};
    if (waits) {
        all.push_back({"--live-wait", &options.wait, "begin when the first of them watches"});
    }
    return all;
}

void print_address(const live::Live& live, Terminal& terminal) {
    terminal.line("live",
                  live.address() + "  (limpet lab: Live; Foxglove: Open connection, WebSocket)");
}

std::unique_ptr<live::Live> open_live(const LiveViewOptions& options, live::LiveOptions about,
                                      Terminal& terminal) {
    if (!options.wanted) {
        return nullptr;
    }
    about.server = live::server_for_viewers(port_of(options));
    auto opened = std::make_unique<live::Live>(std::move(about));
    print_address(*opened, terminal);
    return opened;
}

}  // namespace limpet::app
