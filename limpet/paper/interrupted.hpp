// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace limpet {

/// Thrown when the watch asked to stop; no page was written.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace limpet
