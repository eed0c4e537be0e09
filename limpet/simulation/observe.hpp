// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "limpet/simulation/metrics.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/tick_report.hpp"
#include "limpet/simulation/true_end.hpp"

namespace limpet::simulation {

/// How often a flight is digested: a difference between two runs does not heal within 10 ms.
inline constexpr int kDigestRate_Hz = 100;

/// What a flight has looked like from outside so far. No station reads it.
struct Observations {
    Metrics metrics;
    MetricsMemory memory;
    long long physics_steps = 0;
    std::uint64_t hash = 0;  ///< digest of the trajectory
    EndWatch end;
};

/// Of the vehicle's nose, up positive.
[[nodiscard]] double pitch_deg(const Truth& truth);

/// After a tick: what it has led to and what happened in it.
void observe(Observations& seen, const FlightModel& model, const FlightState& state,
             const TickReport& report);

}  // namespace limpet::simulation
