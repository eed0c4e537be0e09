// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "command_line.hpp"
#include "limpet/live/live.hpp"
#include "terminal.hpp"

namespace limpet::app {

struct LiveViewOptions {
    bool wanted = false;
    bool wait = false;
    std::string port = "8765";  ///< where Foxglove looks first
};
/// @param waits  --live-wait is there too
[[nodiscard]] OptionList options_of(LiveViewOptions& options, bool waits);

/// The port of --live.
/// @throws InputError if it is none
[[nodiscard]] std::uint16_t port_of(const LiveViewOptions& options);
/// Where to watch.
void print_address(const live::Live& live, Terminal& terminal);

/// Serves a recording as it grows.
/// @return null where none is wanted
/// @throws InputError for a port that cannot be had
[[nodiscard]] std::unique_ptr<live::Live> open_live(const LiveViewOptions& options,
                                                    live::LiveOptions about, Terminal& terminal);

}  // namespace limpet::app
