// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace limpet::app {

/// From now on the first Ctrl-C, SIGTERM or SIGHUP sets the flag, for long work to end in good
/// order; the second ends the program as ever.
[[nodiscard]] const std::atomic<bool>* stop_on_signals();

}  // namespace limpet::app
