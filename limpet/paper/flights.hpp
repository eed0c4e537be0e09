// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/paper/parts.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::paper {

/// A flight of the paper's experiments, recorded and read back.
struct PaperFlight {
    std::string name;  ///< the evidence's prefix and the recording's folder
    simulation::FlightResult result;
    record::Recording recording;
};

struct FlightOrder {
    std::string name;
    std::string scenario;
    std::vector<std::string> overrides = {};
};

/// Flies one order into FOLDER/NAME/flight.mcap.
[[nodiscard]] PaperFlight fly_recorded(const FlightOrder& order,
                                       const std::filesystem::path& folder);

/// Measures on a flight what the paper's text states of its figures: "NAME.spike_N" and so on.
/// Everything is read from the recording or from the flight's metrics; what did not come to pass is
/// NaN.
void measure(const PaperFlight& flight, Evidence& evidence);

}  // namespace limpet::paper
