// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/rare/rare_event.hpp"
#include "limpet/rare/subset_simulation.hpp"

namespace limpet::rare {

/// What a search for a rare event was asked.
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

/// @throws InputError when a row is not the run that the search asks for
void require_run_of(campaign::Results& results, const campaign::RunRow& row,
                    const RareSample& sample);

/// The search as the levels see it.
[[nodiscard]] SubsetPlan plan_of(const campaign::Campaign& campaign, const RareSearch& search);

}  // namespace limpet::rare
