// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/external.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/remote_guidance.hpp"

namespace limpet {

/// One base tick of the loop, from the truth at this tick to the truth at the next.
/// @param events    what happened in it; cleared first
/// @param external  an autopilot behind a wire; nullptr: the built-in one
/// @param remote    guidance behind wires; nullptr: ours
void step(const SimulationModel& model, SimulationState& state, Plant& plant, EventList& events,
          ExternalAutopilot* external = nullptr, RemoteGuidance* remote = nullptr);

}  // namespace limpet
