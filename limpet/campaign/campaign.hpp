// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limpet/campaign/sampling.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/core/work.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::campaign {

/// Many flights: a scenario, what differs from run to run, how many. Keys of the file are described
/// in data/campaigns/README.md. It stands for itself once it is loaded: its scenario is spelled
/// out, so that a run flies the same when vehicles, surfaces and scenarios have changed.
struct Campaign {
    std::string name;
    std::string description;
    std::string yaml;           ///< the file's text
    std::string scenario_name;  ///< "perch_concrete"
    std::uint64_t seed = 1;     ///< of every flight; the runs differ by their index
    std::uint32_t runs = 0;
    std::vector<Outcome> success;  ///< what counts as one, for the summary
    std::vector<VariedKey> keys;
    /// The scenario as YAML, one for each combination of values that are names (see variant_of());
    /// a single one where only numbers differ.
    std::vector<scenario::ScenarioText> scenarios;
    bool on_px4 = false;  ///< flown by PX4s, not by the built-in autopilot; not in the file
};

/// Reads a campaign and checks all that can be checked before anything flies: the scenario is
/// loaded at every value of each grid and choice, at the ends of what is uniform and at the extreme
/// draws of what is not bounded.
/// @param wanted  path of a file, or a name in campaigns/ of the data
/// @param data    folder of the data; empty: data_root()
/// @param work    asked between two scenarios: 1,300 of them take a second
/// @throws InputError one line: file:line, key, value, what is allowed
/// @throws Interrupted
[[nodiscard]] Campaign load_campaign(const std::string& wanted,
                                     const std::filesystem::path& data = {}, const Work& work = {});

/// The same from what a database of results holds: nothing else is read.
/// @param scenarios  the texts of Campaign::scenarios
[[nodiscard]] Campaign restore_campaign(const std::string& yaml, const std::string& name,
                                        std::vector<std::string> scenarios);

/// @return index into Campaign::scenarios
[[nodiscard]] std::size_t variant_of(const std::vector<VariedKey>& keys,
                                     const std::vector<SampledValue>& sample);

/// The scenario with what a run sets in it.
/// @param noise  that it flies with in the seed's place, if any
/// @throws InputError when the values do not fit each other
[[nodiscard]] scenario::Scenario scenario_of(const Campaign& campaign,
                                             const std::vector<SampledValue>& sample,
                                             const NoiseBlend& noise = {});

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
