// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/true_end.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/state.hpp"

namespace limpet::simulation {

/// For how long the truth must be so before a flight has come to its end.
inline constexpr double kStill_s = 0.5;
/// A flight that guidance has ended goes on for as long at most.
inline constexpr double kAfterGuidance_s = 10.0;

/// Since when the truth has been so, for how a flight ends; < 0: it is not so. No station reads it.
struct EndWatch {
    double slow_since_s = -1.0;    ///< slower than 0.5 m/s
    double sealed_since_s = -1.0;  ///< the cup
    double clear_since_s = -1.0;   ///< neither cup nor legs touch anything
    double borne_since_s = -1.0;   ///< the ground carries the weight
    Vector3 anchor_W_m = Vector3::Zero();
    double anchored_since_s = -1.0;  ///< within 0.25 m of that
    double guidance_ended_s = -1.0;  ///< when guidance ended the mission; < 0: it has not
};

/// After a tick.
void watch_end(EndWatch& watch, const FlightModel& model, const FlightState& state);

/// Where a vehicle in the air belongs at the end: a hover's start; of a perch the pre-position, by
/// the true wall, at the start's height.
[[nodiscard]] Vector3 place_W_m(const FlightModel& model);
/// Of the vehicle from there.
[[nodiscard]] double off_place_m(const FlightModel& model, const FlightState& state);
/// So far from it counts as there: 0.5 m, and twice GPS's own drift where that is flown by.
[[nodiscard]] double place_tolerance_m(const FlightModel& model);

/// What the flight has come to by the truth.
[[nodiscard]] TrueEnd true_end(const EndWatch& watch, const FlightModel& model,
                               const FlightState& state);

}  // namespace limpet::simulation
