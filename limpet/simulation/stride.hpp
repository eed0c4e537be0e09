// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"

namespace limpet::simulation {

/// How the bodies go on from a tick.
struct Stride {
    int ticks = 1;         ///< to where they are looked at again
    int steps = 1;         ///< of the plant on the way there
    bool contacts = true;  ///< a leg may touch something

    [[nodiscard]] double step_s() const { return ticks * kTick_s / steps; }
    /// By the rotors as they turn then, not at its end. docs/decisions/0043.
    [[nodiscard]] bool pushed_at_its_start() const { return ticks > 1; }
};

/// One tick: in one step of the plant or, around a touch, in several.
[[nodiscard]] Stride one_tick(const FlightModel& model, const FlightState& state);

/// To the next tick at which a station looks at the bodies, in one step of the plant; a tick where
/// something touches, is about to, or goes fast next to the wall or the ground.
/// docs/decisions/0043.
[[nodiscard]] Stride next_stride(const FlightModel& model, const FlightState& state);

/// From each tick of a second the ticks to the next at which a sensor samples, guidance decides, or
/// the truth is recorded or digested.
/// @param longest  at most so many
[[nodiscard]] Strides strides_of(const FlightModel& model, int longest);

}  // namespace limpet::simulation
