// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"

namespace limpet {

struct GuidanceInput {
    const Readings& readings;
    const Estimate& estimate;
    double time_s = 0.0;
};

struct GuidanceOutput {
    Setpoint setpoint;                    ///< motion, arming, pump and valve
    std::optional<EventName> event = {};  ///< to be reported and recorded
    std::optional<Outcome> outcome = {};  ///< the flight ends so
    std::string_view reason = {};         ///< of event and outcome, a literal
};

/// A manoeuvre in place of the built-in one. As an autopilot it has no state of its own: what it
/// remembers are numbers of the flight.
class Guidance {
public:
    virtual ~Guidance() = default;

    /// How many numbers it remembers; they begin as zeros.
    [[nodiscard]] virtual std::size_t memory_size() const { return 0; }
    /// simulation.guidance_rate_Hz times a second.
    [[nodiscard]] virtual GuidanceOutput update(const GuidanceInput& input,
                                                std::span<double> memory) const = 0;
};

}  // namespace limpet
