// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"
#include "limpet/simulation/stride.hpp"
#include "limpet/simulation/tick_report.hpp"

namespace limpet::simulation {

/// A stride of rigid-body truth: rotors, as they turn, and cup push, the plant moves.
/// @param report        what the steps saw is added
/// @param external_cup  nullptr: ours
void advance(const FlightModel& model, FlightState& state, plant::Plant& plant,
             const Stride& stride, TickReport& report, ExternalCup* external_cup = nullptr);

/// Where base and cup are now.
void see_motion(const FlightModel& model, Truth& truth, const plant::Plant& plant);

/// How far the lip is from the wall now: the cup's own status has the gap before its last step.
void see_gap(const FlightModel& model, Truth& truth);

}  // namespace limpet::simulation
