// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/scenario/scenario.hpp"

namespace limpet::remarks {

// What makers of suction cups would say of a scenario, a line each. None of it stops a flight.

/// All of it: how often the cup carries the vehicle along the wall and what they ask for, and
/// whether the wall is rounder than the lip follows. Empty without cup or wall.
[[nodiscard]] std::vector<std::string> makers_notes(const scenario::Scenario& scenario);

/// Those alone that are not as makers ask.
[[nodiscard]] std::vector<std::string> makers_warnings(const scenario::Scenario& scenario);

}  // namespace limpet::remarks
