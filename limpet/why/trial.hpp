// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "limpet/scenario/loader.hpp"
#include "limpet/why/hold.hpp"

namespace limpet::why {

/// One key of a scenario at another value.
struct Change {
    std::string key;
    std::string unit;
    double from = 0.0;
    double to = 0.0;
    bool is_switch = false;

    [[nodiscard]] std::string override_text() const;  ///< "KEY=VALUE", as --set takes it
};

/// How far a mission came by the truth; each includes those before it.
enum class Stage {
    nothing,   ///< the cup met no wall
    touched,   ///< it did not seal
    sealed,    ///< it did not come below the attachment threshold
    attached,  ///< it let go before guidance began to land
    landing,   ///< it let go on the way to the rest, or never came to rest
    rested,    ///< on the wall, motors off; but the rest of the mission failed
    done,      ///< a success
};
[[nodiscard]] inline std::string_view to_string(Stage stage) {
    return name_of(stage);
}

/// A flight and how far it came.
struct Trial {
    std::vector<Change> changes;
    bool flown = false;  ///< false: its values do not go together, or a fault ended it
    std::string fault;   ///< of ours, that ended it
    simulation::FlightResult result;
    std::vector<Hold> holds;
    Stage stage = Stage::nothing;
    /// Within the stage, 0..1: share of the press that seals, how long it held, share of the pitch
    /// at rest; of those that rested the least margin over the vacuum's force.
    double share = 0.0;
    double simulated_s = 0.0;
};
/// Whether `one` came further.
[[nodiscard]] bool further(const Trial& one, const Trial& other);

/// What a trial is flown for.
struct TrialOptions {
    /// One docking run, ended when the cup has let go or the vehicle rests on the wall; no
    /// recording and no trace of it.
    bool until_rest = false;
    bool traces = false;
    HoldTrace* trace = nullptr;
    const std::atomic<bool>* stop = nullptr;
};

/// Flies a scenario with changes.
[[nodiscard]] Trial fly_trial(const scenario::ScenarioText& text, std::vector<Change> changes,
                              const TrialOptions& options = {});

/// Many, on `jobs` threads, each several side by side; in the order of `trials`, whatever the
/// number of threads.
/// @throws Interrupted when it was stopped
[[nodiscard]] std::vector<Trial> fly_trials(const scenario::ScenarioText& text,
                                            std::vector<std::vector<Change>> trials,
                                            const TrialOptions& options, int jobs);

}  // namespace limpet::why
