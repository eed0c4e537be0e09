// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"

namespace limpet {

/// One base tick of the loop, from the truth at this tick to the truth at the next.
/// @param events   what happened in it; cleared first
/// @param outside  stations that are not ours
void step(const SimulationModel& model, SimulationState& state, Plant& plant, EventList& events,
          const Outside& outside = {});

}  // namespace limpet
