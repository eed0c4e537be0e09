// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/campaign/rank_link.hpp"
#include "limpet/campaign/workers.hpp"

// One campaign, many processes. Rank 0 deals out the runs, a few at a time to whoever asks, flies
// some itself, and alone touches the results; the others bring their rows to it as they land. Who
// is faster asks more often. Nothing of it is in the rows.
namespace limpet::campaign {

/// Rank 0: waits for all to say what they were started for.
/// @param campaign  null: it could not be loaded, for `why_not`
/// @throws InputError that `why_not`, or naming the first rank that has another campaign or none
void muster_ranks(RankLink& link, const Campaign* campaign, const std::string& why_not);
/// Rank 0, after muster_ranks(), when it does not begin: sends all home. Leaves the link.
void dismiss_ranks(RankLink& link);

/// Rank 0, after muster_ranks(): run_campaign() with all ranks. Leaves the link.
Progress run_among_ranks(Results& results, int jobs, const CampaignWatch& watch, RankLink& link);

/// Any other rank: joins and flies what rank 0 deals until that says that it is over. Leaves the
/// link.
/// @param campaign  null: it could not be loaded, for `why_not`
void serve_rank_0(RankLink& link, const Campaign* campaign, const std::string& why_not, int jobs,
                  const std::atomic<bool>* stop);

}  // namespace limpet::campaign
