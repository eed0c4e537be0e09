// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"

namespace limpet {

/// One base tick of rigid-body truth, in one step of the plant or, around a touch, in several:
/// rotors, slider stops and cup push, the plant moves.
/// @param external_cup  nullptr: ours
void advance(const SimulationModel& model, SimulationState& state, Plant& plant, EventList& events,
             ExternalCup* external_cup = nullptr);

/// Where base and cup are now.
void see_motion(const SimulationModel& model, Truth& truth, const Plant& plant);

}  // namespace limpet
