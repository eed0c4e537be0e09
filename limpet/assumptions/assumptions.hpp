// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/scenario/loader.hpp"
#include "limpet/why/trial.hpp"

namespace limpet::assumptions {

/// A value that no measurement stands behind.
struct Assumption {
    std::string key;  ///< "suction.seal_wear_1_N"
    std::string unit = {};
    double value = 0.0;
    std::string description = {};
    std::string source = {};
    std::string measurement =
        {};  ///< what would settle it, in a user's terms; empty: nothing simple
    std::vector<double> neighbours = {};  ///< below and above it, within its range
};

/// Those of a scenario: not zero, and not derived from others.
/// @param share  by which a neighbour is off: 0.1 is 10 %
[[nodiscard]] std::vector<Assumption> assumed(scenario::Scenario scenario, double share);
/// The same of every value, whatever its source.
[[nodiscard]] std::vector<Assumption> turnable(scenario::Scenario scenario, double share);

/// What settles the keys that begin so.
struct Measurement {
    std::string_view of;
    std::string_view by;
};
[[nodiscard]] std::span<const Measurement> measurements();

/// Whether that is a measurement: of a choice there is none.
[[nodiscard]] bool is_measured(std::string_view by);

/// What would settle a key; empty: nothing that a user measures.
[[nodiscard]] std::string_view measurement_of(std::string_view key);

/// An effect's name: 1 of a flight that is a success (is_success()), else 0; over seeds their
/// share.
inline constexpr std::string_view kSuccess = "success";

/// How a figure moves with a value: mean of half the difference between its upper and its lower
/// neighbour, over seeds, each against the same seed.
struct Effect {
    std::string_view metric;  ///< simulation::metric_table(), attempts, simulated_s, kSuccess
    double base = 0.0;        ///< mean over the seeds, as it is
    double change = 0.0;      ///< with `share` more of the value, in the metric's unit
    double error = 0.0;       ///< standard error of it, by the scatter over seeds
    std::size_t seeds = 0;    ///< of which all three flights have the figure
};

/// A flight that ends otherwise with one value turned.
struct Flip {
    std::uint64_t seed = 1;
    double to = 0.0;      ///< the value
    std::string outcome;  ///< "crashed (fallen)"
};

struct Weighed {
    Assumption assumption;
    std::vector<Effect> effects = {};
    std::vector<Flip> flips = {};
    std::size_t flights = 0;
};

struct Register {
    std::string scenario;
    double share = 0.1;
    std::vector<std::uint64_t> seeds;
    std::vector<std::string> outcomes = {};  ///< as it is, by seed
    std::vector<Weighed> values = {};        ///< in the order of the sections
    std::size_t flights = 0;
    double wall_s = 0.0;
};

struct RegisterOptions {
    double share = 0.1;
    std::vector<std::uint64_t> seeds = {1};
    /// What each seed's flights have otherwise, values turned or not: one list a seed, or none.
    std::vector<std::vector<why::Change>> draws = {};
    int jobs = 1;
    const std::atomic<bool>* stop = nullptr;
};

/// Flies each seed as it is, and with each assumed value at both neighbours. The same for any
/// number of jobs.
/// @throws InputError when the scenario cannot be flown; Interrupted
[[nodiscard]] Register weigh(const scenario::ScenarioText& text, const std::string& name,
                             const RegisterOptions& options);

/// The values with the largest change of a figure beyond twice its error, largest first.
/// @param most  so many at most
[[nodiscard]] std::vector<const Weighed*> that_move(const Register& all, std::string_view metric,
                                                    std::size_t most);

/// How much of a figure a measurement would settle.
struct Settled {
    std::string_view by;  ///< "a ruler"
    double share = 0.0;   ///< of the sum of the squared changes of all values that move it
};
/// Were each value as uncertain as the next, by the same share of itself. Values that no
/// measurement settles count in the sum alone.
/// @return largest share first; empty where nothing moves the figure
[[nodiscard]] std::vector<Settled> settled_by(const Register& all, std::string_view metric);

/// Of a value, how the figure moves with it.
/// @throws InternalError for a figure that there is not
[[nodiscard]] const Effect& effect_of(const Weighed& weighed, std::string_view metric);

/// "0.09: crashed (fallen) in 1 of 4; 0.11: ..."; empty where none ends otherwise
[[nodiscard]] std::string flip_text(const Weighed& weighed);

/// For people: what flips the outcome, then the five that move each figure most, with what would
/// settle them.
[[nodiscard]] std::string register_text(const Register& all);
/// Of one flight: "this outcome hangs on: ..." with a line a value, or on none.
[[nodiscard]] std::string hangs_on_text(const Register& all);
/// One JSON object: every value with all its effects.
[[nodiscard]] std::string register_json(const Register& all);

}  // namespace limpet::assumptions
