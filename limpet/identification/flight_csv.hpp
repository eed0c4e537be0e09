// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/identification/flight_data.hpp"

namespace limpet::identification {

/// A flight's log as CSV, as read_flight() says.
/// @throws InputError one line: file:line, what is missing or cannot be read
[[nodiscard]] FlightData read_flight_csv(const std::filesystem::path& path);

}  // namespace limpet::identification
