// SPDX-License-Identifier: Apache-2.0
#include "flight_report.hpp"

#include "limpet/core/errors.hpp"

namespace limpet::app {

Outcome expected_outcome(const std::string& name) {
    const auto outcome = outcome_from(name);
    if (!outcome) {
        throw InputError("--expect " + name +
                         ": no such outcome; there are perched, released, failed_to_seal, "
                         "release_aborted, crashed, timed_out");
    }
    return *outcome;
}

std::vector<std::string> flight_summary(const simulation::FlightResult& result,
                                        const Terminal& terminal) {
    return limpet::simulation::flight_summary(
        result, [&terminal](const std::string& text) { return terminal.bold(text); });
}

}  // namespace limpet::app
