// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "limpet/campaign/campaign.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostVariants = 2000;
constexpr std::uint32_t kDrawsLookedAt = 1'000'000;  ///< of spreads without ends; takes a second

using Sample = std::vector<SampledValue>;

/// An error that names `--set key=value` was written in the campaign's file: say where.
std::string placed_in_campaign(const CampaignFile& file, const std::string& message) {
    if (message.rfind(scenario::kSet, 0) != 0) {
        return message;
    }
    for (const VariedKey& key : file.campaign.keys) {
        const std::string assignment = fmt::format("{}{}=", scenario::kSet, key.key);
        if (message.rfind(assignment, 0) == 0) {
            const std::size_t colon =
                std::min(message.find(": ", assignment.size()), message.size());
            return fmt::format("{}: parameters.{}{}", key.place, key.key, message.substr(colon));
        }
    }
    return fmt::format("{}: overrides: {}", file.overrides_place,
                       message.substr(scenario::kSet.size()));
}

/// The file of the scenario that the campaign names; a relative path counts from the campaign's.
std::string scenario_file(const CampaignFile& file, const fs::path& folder, const fs::path& data) {
    const std::string& wanted = file.scenario;
    if (scenario::is_path(wanted)) {
        return (fs::path(wanted).is_relative() ? folder / wanted : fs::path(wanted)).string();
    }
    try {
        return scenario::find_file(wanted, "scenario", data / "scenarios").string();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: scenario: {}", file.scenario_place, error.what()));
    }
}

std::size_t variants(const CampaignFile& file) {
    std::size_t count = 1;
    for (const VariedKey& key : file.campaign.keys) {
        count *= is_named(key) ? key.values.size() : 1;
        if (count > kMostVariants) {
            throw InputError(
                fmt::format("{}: parameters.{}: makes more than {} combinations of names",
                            key.place, key.key, kMostVariants));
        }
    }
    return count;
}

/// Spells the scenario out, once for each combination of named values.
void resolve(CampaignFile& file, const fs::path& folder, const fs::path& data, const Work& work) {
    Campaign& campaign = file.campaign;
    const std::string path = scenario_file(file, folder, data);
    campaign.scenario_name = fs::path(path).stem().string();
    const std::size_t count = variants(file);
    for (std::size_t variant = 0; variant < count; ++variant) {
        work.say();
        scenario::LoadOptions options{.overrides = file.overrides,
                                      .seed = campaign.seed,
                                      .data_root = data,
                                      .folder = folder};
        std::size_t stride = count;  // variant_of() the other way round
        for (const VariedKey& key : campaign.keys) {
            if (is_named(key)) {
                stride /= key.values.size();
                const auto& value = key.values[variant / stride % key.values.size()];
                options.overrides.push_back(key.key + "=" + value_text(value));
            }
        }
        campaign.scenarios.emplace_back(to_yaml(load_scenario(path, options)),
                                        campaign.scenario_name);
    }
}

SampledValue middle(const VariedKey& key) {
    switch (key.spread) {
        case Spread::grid:
        case Spread::choice: return key.values.front();
        case Spread::uniform: return 0.5 * (key.first + key.second);
        case Spread::normal:
        case Spread::lognormal: return std::clamp(key.first, key.from, key.to);
    }
    throw InternalError("spread out of range");
}

/// Smallest and largest that each key is set to.
std::vector<std::pair<SampledValue, SampledValue>> extremes(const Campaign& campaign) {
    std::vector<std::pair<SampledValue, SampledValue>> ends;
    bool draws = false;
    for (const VariedKey& key : campaign.keys) {
        if (!key.values.empty()) {
            const auto [low, high] = std::minmax_element(key.values.begin(), key.values.end());
            ends.emplace_back(*low, *high);
        } else if (key.spread == Spread::uniform) {
            ends.emplace_back(key.first, key.second);
        } else {
            ends.emplace_back(middle(key), middle(key));
            draws = true;
        }
    }
    for (std::uint32_t run = 0; draws && run < std::min(campaign.runs, kDrawsLookedAt); ++run) {
        const Sample sample = draw(campaign.keys, campaign.seed, run);
        for (std::size_t i = 0; i < sample.size(); ++i) {
            ends[i] = {std::min(ends[i].first, sample[i]), std::max(ends[i].second, sample[i])};
        }
    }
    return ends;
}

/// A key that is set and varies is ambiguous.
void require_apart(const CampaignFile& file) {
    for (const std::string& one : file.overrides) {
        if (one.starts_with("seed=")) {
            throw InputError(fmt::format("{}: overrides: {} is the campaign's own, seed: {}",
                                         file.overrides_place, scenario::shown(one),
                                         one.substr(5)));
        }
        for (const VariedKey& key : file.campaign.keys) {
            if (one.substr(0, one.find('=')) == key.key) {
                throw InputError(fmt::format("{}: overrides: {} sets what varies, parameters.{}",
                                             file.overrides_place, scenario::shown(one), key.key));
            }
        }
    }
}

/// Loads the scenario with some more overrides, from where its data are.
using LoadAsWritten = std::function<void(const std::vector<std::string>& overrides)>;

/// Of what does not fit in the middle of everything: an end by itself that does not either, which
/// somebody wrote.
void look_for_end(const Campaign& campaign,
                  const std::vector<std::pair<SampledValue, SampledValue>>& ends,
                  const LoadAsWritten& load) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (const SampledValue& end : {ends[i].first, ends[i].second}) {
            load({campaign.keys[i].key + "=" + value_text(end)});
        }
    }
}

/// Loads the scenario in the middle of everything, then at the ends of each key.
void check_extremes(const Campaign& campaign, const LoadAsWritten& load) {
    Sample centre;
    std::vector<std::string> overrides;
    for (const VariedKey& key : campaign.keys) {
        centre.push_back(middle(key));
        overrides.push_back(key.key + "=" + value_text(centre.back()));
    }
    const auto ends = extremes(campaign);
    try {
        load(overrides);
    } catch (const InputError&) {
        look_for_end(campaign, ends, load);
        throw;
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (const SampledValue& end : {ends[i].first, ends[i].second}) {
            Sample sample = centre;
            sample[i] = end;
            (void)scenario_of(campaign, sample);
        }
    }
}

}  // namespace

Campaign load_campaign(const std::string& wanted, const fs::path& data, const Work& work) {
    const fs::path root = data.empty() ? scenario::data_root() : data;
    const fs::path path = scenario::find_file(wanted, "campaign", root / "campaigns");
    CampaignFile file = parse_campaign(scenario::read_yaml_text(path), scenario::shown_path(path),
                                       path.stem().string());
    try {
        require_apart(file);
        resolve(file, path.parent_path(), root, work);
        check_extremes(file.campaign, [&](const std::vector<std::string>& overrides) {
            scenario::LoadOptions options{.overrides = file.overrides,
                                          .seed = file.campaign.seed,
                                          .data_root = root,
                                          .folder = path.parent_path()};
            options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
            work.say();
            (void)load_scenario(scenario_file(file, path.parent_path(), root), options);
        });
    } catch (const InputError& error) {
        throw InputError(placed_in_campaign(file, error.what()));
    }
    return std::move(file.campaign);
}

Campaign restore_campaign(const std::string& yaml, const std::string& name,
                          std::vector<std::string> scenarios) {
    CampaignFile file = parse_campaign(yaml, name, name);
    file.campaign.scenario_name = fs::path(file.scenario).stem().string();
    for (std::string& text : scenarios) {
        file.campaign.scenarios.emplace_back(std::move(text), file.campaign.scenario_name);
    }
    return std::move(file.campaign);
}

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

scenario::Scenario scenario_of(const Campaign& campaign, const std::vector<SampledValue>& sample,
                               const NoiseBlend& noise) {
    // The text is spelled out: nothing is looked up in any folder of data.
    scenario::LoadOptions options{.overrides = {}, .seed = campaign.seed, .data_root = "."};
    for (std::size_t i = 0; i < sample.size(); ++i) {
        if (!is_named(campaign.keys[i])) {
            options.overrides.push_back(campaign.keys[i].key + "=" + value_text(sample[i]));
        }
    }
    if (!noise.empty()) {
        options.overrides.push_back("noise=" + scenario::noise_text(noise));
    }
    return campaign.scenarios[variant_of(campaign.keys, sample)].load(options);
}

}  // namespace limpet::campaign
