// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/campaign/workers.hpp"
#include "limpet/rare/rare_event.hpp"
#include "limpet/rare/subset_simulation.hpp"

namespace limpet::rare {

/// What a search for a rare event looks for.
struct RareSearch {
    RareEvent event;
    std::uint32_t level_runs = 1000;
};

/// A search's results are a campaign's with two tables more:
///
///   rare       one row: event, falling, rising (the figure as it was given for an outcome, or
///              empty), level_runs
///   rare_runs  a row a run, with that of `runs`: run, level, chain, parent, distance (of its
///              inputs from their medians, in standard deviations), value (of the figure), event
///              (0 or 1), noise (as the scenario's key takes it)

/// @return what is searched for there; nullopt: it is a plain campaign
/// @throws InputError when the table is damaged
[[nodiscard]] std::optional<RareSearch> rare_search(campaign::Results& results);

/// Writes down what is searched for, or, where that is there, makes sure that it is the same.
/// @throws InputError when another thing was searched for, or the runs are a plain campaign's
void begin_rare(campaign::Results& results, const RareSearch& search, const RareGuide& guide);

/// @throws InputError when the results are a search's
void require_plain(campaign::Results& results);

/// A run of the search. Its row of `runs` makes it whole: one without is flown again.
void add_rare(campaign::Results& results, const RareEvent& event, const RareSample& sample,
              const campaign::RunRow& row);

/// @return noise of a run of a search; empty: the results are a plain campaign's
/// @throws InputError when it is damaged
[[nodiscard]] NoiseBlend rare_noise(campaign::Results& results, std::uint32_t run);

/// The search's levels as far as they are flown: the search once more, on the rows that are there.
/// @throws InputError when a row is not the one that the search would fly
[[nodiscard]] SubsetResult evaluate_rare(campaign::Results& results, const RareSearch& search);

/// Checks before anything flies that all that varies is drawn, and that the scenario is sound as
/// far out as a search draws.
/// @throws InputError one line: the key and what is wrong with it
void require_searchable(const campaign::Campaign& campaign);

/// How far a search has come.
struct RareProgress {
    std::uint32_t level = 0;
    std::uint32_t finished = 0;  ///< of the level
    std::uint32_t flown = 0;     ///< now
    std::uint32_t events = 0;    ///< now and before
    double probability = 1.0;    ///< of reaching the last level that is done
    double elapsed_s = 0.0;
};

/// Empty members do nothing.
struct RareWatch {
    std::function<void(const RareProgress&)> on_progress;  ///< as that of campaign::CampaignWatch
    const std::atomic<bool>* stop = nullptr;
};

struct RareFlown {
    SubsetResult result;
    std::uint32_t flown = 0;  ///< now
    double elapsed_s = 0.0;
};

/// Flies a search to its end, on `jobs` threads, each with several runs side by side; runs whose
/// rows are there are not flown again.
/// @throws InputError as run_campaign(), and when a row is not the search's
[[nodiscard]] RareFlown fly_rare(campaign::Results& results, const RareSearch& search, int jobs,
                                 const RareWatch& watch = {});

/// What a search for a rare event has found so far.
struct RareSummary {
    std::string name;
    std::string description;
    std::string scenario;
    std::string version;  ///< of the Limpet that flew it
    std::uint64_t seed = 0;
    RareEvent event;
    std::uint32_t level_runs = 0;
    std::uint32_t flown = 0;
    SubsetResult result;
    std::vector<std::string> keys;              ///< that vary
    std::optional<campaign::RunRow> likeliest;  ///< the event's run nearest to the medians, if any
};

[[nodiscard]] RareSummary summarise_rare(campaign::Results& results, const RareSearch& search);
/// The same where the search's result is known.
[[nodiscard]] RareSummary summarise_rare(campaign::Results& results, const RareSearch& search,
                                         const SubsetResult& result);

/// For people: lines of at most a screen's width.
[[nodiscard]] std::string rare_text(const RareSummary& summary);
/// One JSON object.
[[nodiscard]] std::string rare_json(const RareSummary& summary);

/// Draws probability against the figure over all levels, with 95 % intervals, as rare.png and
/// rare.svg.
/// @param folder  made when it is not there
/// @return the files; none before the first level is done
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_rare(const RareSummary& summary,
                                             const std::filesystem::path& folder);

}  // namespace limpet::rare
