// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "limpet/campaign/workers.hpp"
#include "limpet/px4/instance.hpp"

namespace limpet::campaign {

/// PX4s that fly a campaign at the same time.
struct Px4Crew {
    px4::Px4Instance first;            ///< the others are numbered on from it
    int instances = 1;                 ///< how many
    std::optional<std::string> start;  ///< of px4::Px4Process; none: the user starts them
    double wait_s = 60.0;              ///< longest wait for one, wall time
    bool only_px4 = false;             ///< the stand-in will not do

    /// @throws InputError when the last one's number is beyond PX4's
    void check() const;
};

/// run_campaign() on PX4s: each flight begins with a PX4 that has just started, since PX4 never
/// meets another simulator, and ends with it. A flight that a PX4 does not begin is tried once
/// more, then its row says kNoFlight and why. Rows do not come out the same twice.
/// @param results  of a campaign with Campaign::on_px4
/// @throws InputError when none comes or none can be started; what has landed is kept
Progress run_campaign_on_px4(Results& results, const Px4Crew& crew, const CampaignWatch& watch);

}  // namespace limpet::campaign
