// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace limpet {

/// Simulated time is counted in base ticks, so that it never drifts and every rate is exact.
using Tick = std::int64_t;

inline constexpr Tick kTicksPerSecond = 1000;
inline constexpr double kTick_s = 1.0 / static_cast<double>(kTicksPerSecond);

[[nodiscard]] constexpr double seconds(Tick tick) {
    return static_cast<double>(tick) / static_cast<double>(kTicksPerSecond);
}

/// Whether something that runs `rate_Hz` times a second runs in this tick.
/// Rates that do not divide the tick rate (120 Hz motion capture) fall on the nearest later tick,
/// so that their mean is exact. No state: a resumed run keeps its phase.
/// @param tick     base tick, >= 0
/// @param rate_Hz  1..kTicksPerSecond
[[nodiscard]] constexpr bool due(Tick tick, int rate_Hz) {
    return tick * rate_Hz % kTicksPerSecond < rate_Hz;
}

}  // namespace limpet
