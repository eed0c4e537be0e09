// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/campaign/workers.hpp"
#include "limpet/ranks/rank_link.hpp"

// One campaign, many processes. Rank 0, the coordinator, assigns runs, a few at a time on
// request, flies some itself, and alone writes the results. The other ranks, the workers, send it
// their rows. A faster worker requests more often. The rows do not depend on any of it.
namespace limpet::ranks {

/// Rank 0: waits for all to say what they were started for.
/// @param campaign  null: it could not be loaded, for `why_not`
/// @throws InputError that `why_not`, or naming the first rank that has another campaign or none
void gather_ranks(RankLink& link, const campaign::Campaign* campaign, const std::string& why_not);
/// Rank 0, after gather_ranks(), when it does not begin: shuts all ranks down. Leaves the link.
void dismiss_ranks(RankLink& link);

/// Rank 0, after gather_ranks(): run_campaign() with all ranks. Leaves the link.
campaign::Progress run_among_ranks(campaign::Results& results, int jobs,
                                   const campaign::CampaignWatch& watch, RankLink& link);

/// Any other rank: joins and flies the runs that rank 0 assigns until that shuts it down. Leaves
/// the link.
/// @param campaign  null: it could not be loaded, for `why_not`
void serve_rank_0(RankLink& link, const campaign::Campaign* campaign, const std::string& why_not,
                  int jobs, const std::atomic<bool>* stop);

}  // namespace limpet::ranks
