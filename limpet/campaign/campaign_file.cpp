// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "limpet/campaign/campaign.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::campaign {
namespace {

using scenario::YamlNode;

constexpr double kHuge = 1e300;
constexpr std::uint64_t kMostRuns = 1'000'000'000;
constexpr std::size_t kMostOverrides = 1000;
constexpr std::uint64_t kMostPoints = 1'000'000;
constexpr std::uint64_t kLargestSeed = 9'223'372'036'854'775'807U;  ///< what SQLite can hold
constexpr double kLeastShare = 1e-3;

double number(const YamlNode& node, double minimum = -kHuge, double maximum = kHuge) {
    double value = 0.0;
    return read_number(node, {{}, "-", minimum, maximum, &value, {}, {}});
}

const YamlNode& section(const YamlNode& node, std::string_view example) {
    if (node.kind != YamlNode::Kind::map) {
        fail(node, fmt::format("must be written as {}", example));
    }
    return node;
}

bool is_name(const YamlNode& node) {
    const std::string& text = node.text;
    const bool begins_as_number = !text.empty() && text.find_first_of("0123456789+-.") == 0;
    return node.kind == YamlNode::Kind::scalar && (node.quoted || !begins_as_number);
}

/// All numbers, or all names: a column of the results is one or the other.
std::vector<SampledValue> read_values(const YamlNode& list) {
    const auto& items = read_list(list, "a list of values, as in [0.8, 1.0, 1.2]", 1);
    const bool names = is_name(items.front());
    std::vector<SampledValue> values;
    std::set<SampledValue> seen;
    for (const YamlNode& item : items) {
        if (names && !is_name(item)) {
            fail(item, fmt::format("{} is a number among names", scenario::shown(item.text)));
        }
        SampledValue value = names ? SampledValue(read_text(item)) : SampledValue(number(item));
        if (!seen.insert(value).second) {
            fail(item, fmt::format("{} stands in the list twice", scenario::shown(item.text)));
        }
        values.push_back(std::move(value));
    }
    return values;
}

/// 0.7 for 0.7000000000000001: what a person would have written into the list.
double plain(double value) {
    return std::stod(fmt::format("{:.12g}", value));
}

void read_range(const YamlNode& node, VariedKey& key) {
    check_keys(section(node, "{from: 0.2, to: 1.6, count: 15}"), {"from", "to", "count"});
    const double from = number(needed(node, "from"));
    const double to = number(needed(node, "to"), from);
    const auto points = read_count_within(needed(node, "count"), 1, kMostPoints);
    if ((points > 1) != (to > from)) {
        fail(node, "a single point needs from = to, several need from < to");
    }
    for (std::uint64_t i = 0; i < points; ++i) {
        const double share =
            points == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(points - 1);
        key.values.emplace_back(plain((1.0 - share) * from + share * to));
    }
}

void read_uniform(const YamlNode& node, VariedKey& key) {
    const auto& ends = read_list(node, "two ends, as in [0.8, 1.2]", 2, 2);
    key.first = number(ends[0]);
    key.second = number(ends[1], key.first);
}

/// normal: {mean, sigma} and lognormal: {median, sigma}, each with from, to.
void read_bell(const YamlNode& node, std::string_view middle, double least, VariedKey& key) {
    const std::string example = fmt::format("{{{}: 1.0, sigma: 0.1}}", middle);
    check_keys(section(node, example), {middle, "sigma", "from", "to"});
    key.first = number(needed(node, middle), least);
    key.second = number(needed(node, "sigma"), 1e-300);
    for (auto [end, name] : {std::pair(&key.from, "from"), std::pair(&key.to, "to")}) {
        if (const YamlNode* given = node.find(name)) {
            *end = number(*given);
        }
    }
    if (!(share_within(key) >= kLeastShare)) {
        fail(node, "hardly ever falls between from and to");
    }
}

VariedKey read_key(const YamlNode& node) {
    section(node, "{grid: [0.8, 1.0, 1.2]}");
    check_keys(node, {"grid", "range", "uniform", "normal", "lognormal", "choice"});
    if (node.children.size() != 1) {
        fail(node, "needs exactly one of grid, range, uniform, normal, lognormal, choice");
    }
    VariedKey key;
    key.key = node.key;
    key.place = node.place;
    const YamlNode& spread = node.children.front();
    if (spread.key == "grid" || spread.key == "choice") {
        key.spread = spread.key == "grid" ? Spread::grid : Spread::choice;
        key.values = read_values(spread);
    } else if (spread.key == "range") {
        read_range(spread, key);
    } else if (spread.key == "uniform") {
        key.spread = Spread::uniform;
        read_uniform(spread, key);
    } else if (spread.key == "normal") {
        key.spread = Spread::normal;
        read_bell(spread, "mean", -kHuge, key);
    } else {
        key.spread = Spread::lognormal;
        read_bell(spread, "median", 1e-300, key);
    }
    return key;
}

std::vector<VariedKey> read_keys(const YamlNode* node) {
    std::vector<VariedKey> keys;
    if (!is_section(node)) {
        return keys;
    }
    for (const YamlNode& child : node->children) {
        if (child.key == "seed" || child.key == "description") {
            fail(child, "cannot vary; every run has its own random numbers as it is");
        }
        keys.push_back(read_key(child));
        if (grid_points(keys) > kMostPoints) {
            fail(child, fmt::format("makes more than {} grid points", kMostPoints));
        }
    }
    return keys;
}

/// `runs` counts all of them, `repeats` those at each point of the grids.
std::uint32_t read_runs(const YamlNode& root, std::uint64_t points) {
    const YamlNode* runs = root.find("runs");
    const YamlNode* repeats = root.find("repeats");
    if (runs != nullptr && repeats != nullptr) {
        fail(*repeats, "runs is given already; give one of them");
    }
    if (runs != nullptr) {
        return static_cast<std::uint32_t>(read_count_within(*runs, 1, kMostRuns));
    }
    if (repeats != nullptr) {
        return static_cast<std::uint32_t>(points *
                                          read_count_within(*repeats, 1, kMostRuns / points));
    }
    if (points == 1) {
        fail(root, "runs: is missing, as in `runs: 100`");
    }
    return static_cast<std::uint32_t>(points);
}

std::vector<Outcome> read_success(const YamlNode* node) {
    if (node == nullptr) {
        return {Outcome::perched, Outcome::released};
    }
    std::vector<Outcome> success;
    for (const YamlNode& item :
         read_list(*node, "a list of outcomes, as in [perched, released]", 1)) {
        success.push_back(scenario::read_enum<Outcome>(item));
    }
    return success;
}

/// It becomes a folder.
std::string read_name(const YamlNode& node) {
    const std::string name = read_text(node);
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (name.empty() || !plain) {
        fail(node, fmt::format("\"{}\" must be letters, digits, _ and -", scenario::shown(name)));
    }
    return name;
}

std::vector<std::string> read_overrides(const YamlNode* node) {
    std::vector<std::string> overrides;
    if (node != nullptr && node->kind != YamlNode::Kind::null) {
        for (const YamlNode& item : read_list(
                 *node, "a list of at most 1000, as in [guidance.attempts=1]", 0, kMostOverrides)) {
            overrides.push_back(read_text(item));
        }
    }
    return overrides;
}

}  // namespace

CampaignFile parse_campaign(const std::string& text, const std::string& place,
                            const std::string& name) {
    const YamlNode root = scenario::parse_yaml(text, place);
    if (!is_section(&root)) {
        fail(root, "is empty");
    }
    check_keys(root, {"name", "description", "scenario", "overrides", "runs", "repeats", "seed",
                      "success", "parameters"});
    CampaignFile file;
    Campaign& campaign = file.campaign;
    campaign.yaml = text;
    const YamlNode* named = root.find("name");
    campaign.name = named != nullptr ? read_name(*named) : name;
    read_given(root, "description", campaign.description);
    const YamlNode& scenario = needed(root, "scenario");
    file.scenario = read_text(scenario);
    file.scenario_place = scenario.place;
    const YamlNode* overrides = root.find("overrides");
    file.overrides = read_overrides(overrides);
    file.overrides_place = overrides != nullptr ? overrides->place : place;
    if (const YamlNode* seed = root.find("seed")) {
        campaign.seed = read_count_within(*seed, 0, kLargestSeed);
    }
    campaign.success = read_success(root.find("success"));
    campaign.keys = read_keys(root.find("parameters"));
    campaign.runs = read_runs(root, grid_points(campaign.keys));
    return file;
}

}  // namespace limpet::campaign
