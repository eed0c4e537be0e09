// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

/// Makes a word stand out, where the reader's terminal can.
using Emphasis = std::function<std::string(const std::string&)>;

/// Head of the table of events, and a line of it.
[[nodiscard]] std::string event_head();
[[nodiscard]] std::string event_line(const Event& event);

/// Who flew behind a wire: "PX4 1.15.1 of 1dacb4c9cd, airframe 22001, system 1".
[[nodiscard]] std::string who_text(const autopilot::AutopilotIdentity& who);

/// What a person wants to know of a flight, a line each.
[[nodiscard]] std::vector<std::string> flight_summary(const FlightResult& result,
                                                      const Emphasis& bold);

}  // namespace limpet::simulation
