// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "px4_link.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// Options of the verbs that fly a scenario.
struct FlightOptions {
    std::string scenario;
    std::vector<std::string> overrides;
    std::string out;
    std::string expect;
    Px4LinkOptions px4;
    bool json = false;
    bool quiet = false;
    bool csv = false;
    bool no_figures = false;

    [[nodiscard]] Terminal::Voice voice() const;
    [[nodiscard]] bool figures() const { return !no_figures && !json && !quiet; }
    /// Where recording and figures go.
    [[nodiscard]] std::filesystem::path folder(const std::string& name) const;
};

/// The outcome of an option --expect; nothing when it is not given.
/// @throws InputError naming all there are
[[nodiscard]] std::optional<Outcome> expected_outcome(const std::string& name);
/// Reports an outcome that is not the expected one.
/// @param what  has ended: "flight"
[[nodiscard]] ExitCode judged(std::optional<Outcome> expected, const char* what, Outcome outcome,
                              const std::string& reason);

/// What is to be flown, for people.
void introduce(const scenario::Scenario& scenario, Terminal& terminal);
/// Prints events as they come, and the flight's state.
[[nodiscard]] simulation::FlightWatch watch(Terminal& terminal);
/// What a person wants to know of a flight.
void report(const simulation::FlightResult& result, Terminal& terminal);

/// Reports the result of a flight and its wires, draws it, lists the files written.
/// @throws Interrupted when `stop` is set, also while it draws
/// @param stop         where it was set the rest is left out
/// @param about, text  a further line; none without a text
/// @param px4          null: none was there
[[nodiscard]] ExitCode conclude(const FlightOptions& options,
                                const simulation::FlightResult& result,
                                const std::atomic<bool>& stop, const std::string& about,
                                const std::string& text, Px4Link* px4, Terminal& terminal);

}  // namespace limpet::app
