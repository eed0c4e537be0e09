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

/// First times from here on are a clock's (Unix, GPS), not a log's own: fitted and drawn as they
/// are they lose their digits.
inline constexpr double kClockBegins_s = 1e5;

/// @param first_s  when the first sample of a log was taken
/// @return what is subtracted from a log's times before anything is fitted or drawn: the first
///         sample's of a clock's, 0 of times that begin with the log
[[nodiscard]] constexpr double clock_origin_s(double first_s) {
    return first_s >= kClockBegins_s ? first_s : 0.0;
}

/// The same in whole nanoseconds.
[[nodiscard]] constexpr std::uint64_t clock_origin_ns(std::uint64_t first_ns) {
    return static_cast<double>(first_ns) >= 1e9 * kClockBegins_s ? first_ns : 0;
}

/// @param time_s  that a user names, in the log's clock or from its first sample
/// @return from the first sample
[[nodiscard]] constexpr double since_origin_s(double time_s, double origin_s) {
    return origin_s > 0.0 && time_s >= origin_s ? time_s - origin_s : time_s;
}

}  // namespace limpet
