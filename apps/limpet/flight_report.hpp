// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/simulation/flight.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// The outcome of an option --expect.
/// @throws InputError naming all there are
[[nodiscard]] Outcome expected_outcome(const std::string& name);

/// Head of the table of events, and a line of it.
[[nodiscard]] std::string event_head();
[[nodiscard]] std::string event_line(const Event& event);

/// What a person wants to know of a flight, a line each.
[[nodiscard]] std::vector<std::string> flight_summary(const FlightResult& result,
                                                      const Terminal& terminal);

}  // namespace limpet::app
