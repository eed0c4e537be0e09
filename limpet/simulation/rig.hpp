// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"

namespace limpet::simulation {

// Trials on a mount: motors off, and the bench stands in for guidance. It works the pump, sees the
// truth (it has instruments of its own) and says how the trial ended. It borrows guidance's states,
// so that loads, figures and recordings know the phases: approaching, holding, releasing.
//
//   pendulum   approaching ── touch ──► holding ── held for hold_s ──────────► perched
//              (pump on)                        └─ off the wall for hold_s ──► failed_to_seal
//
//   press_rig  approaching ── press_N ──► holding ── seal_s ──► releasing ── leak_s ──► released,
//              (clamp moves)             (pump on)        │     (pump off)              perched
//                                                         └─ not attached ──► failed_to_seal

/// Force and moment of the mount on the base about its origin, in W.
/// Only on a mount; a free vehicle has none.
[[nodiscard]] Wrench mount_wrench_W(const FlightModel& model, const FlightState& state);

/// Once a tick, in guidance's place.
void operate(const FlightModel& model, FlightState& state, guidance::EventList& events);

}  // namespace limpet::simulation
