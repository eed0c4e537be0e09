// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/campaign.hpp"

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::campaign {

std::size_t variant_of(const std::vector<VariedKey>& keys,
                       const std::vector<SampledValue>& sample) {
    std::size_t variant = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (is_named(keys[i])) {
            const auto& values = keys[i].values;
            const auto found = std::find(values.begin(), values.end(), sample[i]);
            require(found != values.end(), "a sample holds one of its key's names");
            variant = variant * values.size() + static_cast<std::size_t>(found - values.begin());
        }
    }
    return variant;
}

scenario::Scenario scenario_of(const Campaign& campaign, const std::vector<SampledValue>& sample) {
    // The text is spelled out: nothing is looked up in any folder of data.
    scenario::LoadOptions options{.overrides = {}, .seed = campaign.seed, .data_root = "."};
    for (std::size_t i = 0; i < sample.size(); ++i) {
        if (!is_named(campaign.keys[i])) {
            options.overrides.push_back(campaign.keys[i].key + "=" + value_text(sample[i]));
        }
    }
    return load_scenario_text(campaign.scenarios[variant_of(campaign.keys, sample)],
                              campaign.scenario_name, options);
}

}  // namespace limpet::campaign
