// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limpet/why/trial.hpp"

namespace limpet::why {

/// A key, and how far the flight came with it turned alone.
struct HelpfulKey {
    Change change;
    Trial alone;  ///< flown whole
    bool in_remedy = false;
};

/// What a failed flight is told.
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
    /// A switch beside the remedy, where that rests but does not do what was asked, that makes it
    /// do so; without changes: none.
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
/// where none mends it, each beside those that help most. The same for any number of jobs.
/// @throws InputError when the scenario cannot be flown; Interrupted
[[nodiscard]] Found find_why(const scenario::ScenarioText& text, const SearchOptions& options);

/// The hold that tells most: the one that came furthest, of several alike the last; null: none.
[[nodiscard]] const Hold* telling_hold(const Trial& trial);

}  // namespace limpet::why
