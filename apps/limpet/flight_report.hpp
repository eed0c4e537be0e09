// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/simulation/flight_text.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// The outcome of an option --expect.
/// @throws InputError naming all there are
[[nodiscard]] Outcome expected_outcome(const std::string& name);

/// What a person wants to know of a flight, a line each.
[[nodiscard]] std::vector<std::string> flight_summary(const simulation::FlightResult& result,
                                                      const Terminal& terminal);

}  // namespace limpet::app
