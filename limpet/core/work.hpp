// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "limpet/core/errors.hpp"

namespace limpet {

/// Who waits for long work: receives its progress, and may stop it.
struct Work {
    std::function<void(const std::string& what)> tell = {};  ///< "frame 12 of 250"
    const std::atomic<bool>* stop = nullptr;

    /// Between two pieces of it.
    /// @throws Interrupted where a stop was requested
    void say(const std::string& what = {}) const {
        if (stop != nullptr && *stop) {
            throw Interrupted("interrupted; nothing was written");
        }
        if (tell && !what.empty()) {
            tell(what);
        }
    }
};

}  // namespace limpet
