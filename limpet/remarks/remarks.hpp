// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/scenario/scenario.hpp"

namespace limpet::remarks {

// What a scenario's numbers say before it flies. None of it stops a flight.

/// A sentence, with the key and what helps where it warns.
struct Note {
    bool warns = false;
    std::string text;
};

/// How often the cup carries the vehicle along the wall (makers_notes()), how far the springs of
/// its hinges are from peeling the lip, how hard the slider throws the vehicle back; a start from
/// which nobody sees the wall; what the vehicle's file leaves to the paper's vehicle.
[[nodiscard]] std::vector<Note> notes_of(const scenario::Scenario& scenario);

/// Those alone that warn.
[[nodiscard]] std::vector<std::string> warnings(const scenario::Scenario& scenario);

/// @param inherited  keys that the vehicle's file leaves to the paper's (Scenario::inherited)
/// @return what does not go with its mass and size
[[nodiscard]] std::vector<std::string> vehicle_remarks(const vehicle::Airframe& airframe,
                                                       const std::vector<std::string>& inherited);

// A scenario against the rules of makers of suction cups, a line each. None of it stops a flight.

/// All of it: how often the cup carries the vehicle along the wall and what they require, and
/// whether the wall is rounder than the lip follows. Empty without cup or wall.
[[nodiscard]] std::vector<std::string> makers_notes(const scenario::Scenario& scenario);

/// Only those that are not as makers require.
[[nodiscard]] std::vector<std::string> makers_warnings(const scenario::Scenario& scenario);

}  // namespace limpet::remarks
