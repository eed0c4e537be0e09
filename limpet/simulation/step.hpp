// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"
#include "limpet/simulation/tick_report.hpp"

namespace limpet::simulation {

/// One base tick of the loop, from the truth at this tick to the truth at the next.
/// @param report   what happened in it, for observe() and others; made anew
/// @param outside  stations that are not ours
void step(const FlightModel& model, FlightState& state, plant::Plant& plant, TickReport& report,
          const Outside& outside = {});

}  // namespace limpet::simulation
