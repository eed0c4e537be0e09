// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "limpet/core/time.hpp"

namespace limpet::sensors {

/// One step of a bias that wanders and forgets: b <- keep b + kick n, n standard normal.
struct GaussMarkov {
    double keep = 1.0;
    double kick = 0.0;
};

/// Exact solution of db = -b / tau dt + walk dW over a step.
/// @param walk   density of the driving noise [unit of b / s / rtHz], >= 0
/// @param tau_s  correlation time, > 0; for dt << tau this is a random walk of walk * sqrt(t)
[[nodiscard]] inline GaussMarkov gauss_markov(double walk, double tau_s, double dt_s) {
    return {.keep = std::exp(-dt_s / tau_s),
            .kick = walk * std::sqrt(-0.5 * tau_s * std::expm1(-2.0 * dt_s / tau_s))};
}

/// @param step  of the reading, >= 0; 0 leaves the value as it is
[[nodiscard]] inline double quantised(double value, double step) {
    return step > 0.0 ? step * std::round(value / step) : value;
}

/// due() for a rate that comes from a parameter; one below 1 Hz is never due.
[[nodiscard]] inline bool sampled(Tick tick, int rate_Hz) {
    constexpr auto kSecond = static_cast<std::uint32_t>(kTicksPerSecond);
    const auto within = static_cast<std::uint32_t>(tick % kTicksPerSecond);  // one for all sensors
    const auto rate = static_cast<std::uint32_t>(rate_Hz);
    return rate_Hz >= 1 && within * rate % kSecond < rate;
}

}  // namespace limpet::sensors
