// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/campaign/campaign.hpp"

namespace limpet::campaign {

/// A campaign as it is written, before its scenario is looked at.
struct CampaignFile {
    Campaign campaign;  ///< without its scenarios
    std::string scenario;
    std::string scenario_place;
    std::vector<std::string> overrides;
    std::string overrides_place;
};

/// @param place  of the text in messages
/// @param name   of the campaign, when the text does not give one
/// @throws InputError one line: place:line, key, value, what is allowed
[[nodiscard]] CampaignFile parse_campaign(const std::string& text, const std::string& place,
                                          const std::string& name);

}  // namespace limpet::campaign
