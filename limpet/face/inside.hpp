// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/record/recording.hpp"
#include "limpet/scenario.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/simulation/flight.hpp"

/// What the public face stands on: Limpet's own types that have the same names.
namespace limpet {

using InnerScenario = scenario::Scenario;
using InnerFlight = simulation::Flight;
using InnerRecording = record::Recording;

struct Scenario::Inside {
    InnerScenario scenario;
    std::string yaml;
    std::string wanted;
    std::vector<std::string> changes;
};

}  // namespace limpet
