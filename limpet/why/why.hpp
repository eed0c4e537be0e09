// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limpet/why/trial.hpp"

namespace limpet::why {

/// What can be turned without building another vehicle: springs and dampers of slider and joint,
/// the valve, guidance, the attitude and position loops. Of each key its neighbours: a third and
/// three times of it within its range, a switch the other way. What follows from other keys is left
/// out, and so are limits of time and the number of attempts.
[[nodiscard]] std::vector<Change> settings_turned(scenario::Scenario scenario);

/// What would have to be built otherwise: masses, places and sizes of the vehicle, half as much
/// again either way.
[[nodiscard]] std::vector<Change> parts_turned(scenario::Scenario scenario);

/// A key, and how far the flight came with it turned alone.
struct HelpfulKey {
    Change change;
    Trial alone;  ///< flown whole
    bool in_remedy = false;
};

/// What was found for a failed flight.
struct Found {
    std::string scenario;
    std::uint64_t seed = 1;
    Trial base;       ///< the flight as it is, whole
    HoldTrace trace;  ///< of it
    Stage goal = Stage::rested;
    std::vector<HelpfulKey>
        keys;             ///< at most three: those of the remedy, then by how far they help
    Trial remedy;         ///< fewest and smallest changes that reach the goal, whole
    bool mended = false;  ///< the remedy came as far as the goal, or further
    HoldTrace remedy_trace;
    /// A switch on top of the remedy, where that rests but does not finish the mission, that makes
    /// it do so; without changes: none.
    Trial and_then;
    std::vector<Trial>
        others;  ///< other pairs and single keys that reach the goal, mildest not sought
    std::vector<HelpfulKey> parts;    ///< of what is built: each reaches the goal alone
    std::vector<std::string> faults;  ///< of ours, each ended a flight
    std::size_t flights = 0;
    double wall_s = 0.0;
};

struct SearchOptions {
    int jobs = 1;
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string&)> tell = {};
};

/// Flies the scenario, and, where that is no success, what would help it: each setting by itself;
/// where none mends it, each together with those that help most. The same for any number of jobs.
/// @throws InputError when the scenario cannot be flown; Interrupted
[[nodiscard]] Found find_why(const scenario::ScenarioText& text, const SearchOptions& options);

/// The most informative hold: the one that came furthest, of several alike the last; null: none.
[[nodiscard]] const Hold* decisive_hold(const Trial& trial);

/// For people: what happened, what bore what, which keys help, each flown.
/// @param wanted  how the flight is named in the commands that fly it again
[[nodiscard]] std::string why_text(const Found& found, const std::string& wanted);
/// One JSON object.
[[nodiscard]] std::string why_json(const Found& found);
/// Margins of the decisive hold against time, of the flight as it is and with the remedy, as
/// why.png and why.svg.
/// @return the files; none where the cup never sealed
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_why(const Found& found,
                                            const std::filesystem::path& folder);

}  // namespace limpet::why
