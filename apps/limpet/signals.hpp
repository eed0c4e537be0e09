// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace limpet::app {

/// From now on the first Ctrl-C or SIGTERM sets the flag, for long work to end in good order; the
/// second ends the program as ever.
[[nodiscard]] const std::atomic<bool>* stop_on_signals();

/// Thrown where the flag ends work of which nothing is kept.
struct Interrupted : std::runtime_error {
    explicit Interrupted(const std::string& during) : std::runtime_error("interrupted " + during) {}
};

}  // namespace limpet::app
