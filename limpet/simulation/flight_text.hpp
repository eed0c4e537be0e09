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

/// The object that `limpet fly --json` prints; figures that did not come to pass are null.
[[nodiscard]] std::string result_json(const FlightResult& result);

/// The same for the recording's attachment: without what depends on the machine (wall time,
/// real-time factor, path), so that the same flight gives the same bytes.
[[nodiscard]] std::string summary_json(const FlightResult& result);

}  // namespace limpet::simulation
