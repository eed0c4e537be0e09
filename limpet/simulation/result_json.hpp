// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

/// The object that `limpet fly --json` prints; figures that did not come to pass are null.
[[nodiscard]] std::string result_json(const FlightResult& result);

/// The same for the recording's attachment: without what depends on the machine (wall time,
/// real-time factor, path), so that the same flight gives the same bytes.
[[nodiscard]] std::string summary_json(const FlightResult& result);

}  // namespace limpet::simulation
