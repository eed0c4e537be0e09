// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/campaign/workers.hpp"
#include "limpet/rare/rare_results.hpp"

namespace limpet::rare {

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
    std::uint32_t faults = 0;  ///< runs that broke off by a fault of ours, now and before
};

/// Flies a search to its end, on `jobs` threads, each with several runs side by side; runs whose
/// rows are there are not flown again.
/// @throws InputError as run_campaign(), and when a row is not the search's
[[nodiscard]] RareFlown fly_rare(campaign::Results& results, const RareSearch& search, int jobs,
                                 const RareWatch& watch = {});

}  // namespace limpet::rare
