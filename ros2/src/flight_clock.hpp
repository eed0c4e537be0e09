// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros/src/heard.hpp"

namespace limpet::ros {

/// Time zero of a flight, on /clock.
[[nodiscard]] inline double flight_start_s() {
    Heard heard({}, false);
    static_cast<void>(heard.tick(0.0));
    return heard.clock_s();
}

}  // namespace limpet::ros
