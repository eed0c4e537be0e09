// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"
#include "limpet/simulation/tick_report.hpp"

namespace limpet::simulation {

/// The loop from the truth at this tick to the truth where it is looked at again: the next tick, or
/// a few on (stride.hpp).
/// @param report   what happened in it, for observe() and others; made anew
/// @param outside  stations that are not ours
void step(const FlightModel& model, FlightState& state, plant::Plant& plant, TickReport& report,
          const Outside& outside = {});

}  // namespace limpet::simulation
