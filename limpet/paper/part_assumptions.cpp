// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "limpet/campaign/campaign.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

/// What a campaign's run draws, but for keys that a claim sets.
std::vector<why::Change> drawn(const campaign::Campaign& campaign, std::uint32_t run,
                               const std::vector<std::string>& set) {
    const std::vector<campaign::SampledValue> sample =
        campaign::draw(campaign.keys, campaign.seed, run);
    std::vector<why::Change> changes;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const std::string& key = campaign.keys[i].key;
        const double* number = std::get_if<double>(&sample[i]);
        const bool is_set = std::any_of(set.begin(), set.end(), [&key](const std::string& one) {
            return one.starts_with(key + "=");
        });
        if (number != nullptr && !is_set) {
            changes.push_back({.key = key, .unit = {}, .from = 0.0, .to = *number});
        }
    }
    return changes;
}

assumptions::Register weigh_claim(const ReadmeClaim& claim, const Study& study) {
    const scenario::Scenario scenario =
        scenario::load_scenario(claim.scenario, {.overrides = claim.set});
    constexpr int kQuickPart = 4, kFewest = 2;
    const int seeds = study.quick ? std::max(kFewest, claim.seeds / kQuickPart) : claim.seeds;
    assumptions::RegisterOptions how{.seeds = {}, .jobs = study.jobs, .stop = study.stop};
    std::optional<campaign::Campaign> draws;
    if (!claim.draws.empty()) {
        draws = campaign::load_campaign(claim.draws);
    }
    for (int k = 0; k < seeds; ++k) {
        how.seeds.push_back(scenario.seed + static_cast<std::uint64_t>(k));
        if (draws) {
            how.draws.push_back(drawn(*draws, static_cast<std::uint32_t>(k), claim.set));
        }
    }
    return assumptions::weigh({to_yaml(scenario), claim.scenario}, claim.scenario, how);
}

void study_readme(Study& study) {
    // Claims of the same flights share a register.
    std::map<std::tuple<std::string, std::vector<std::string>, std::string, int>,
             std::pair<assumptions::Register, std::string>>
        registers;
    TableRows moved, settled;
    std::vector<std::string> moved_links, settled_links;
    double flights = 0.0;
    std::filesystem::create_directories(study.folder / "assumptions");
    for (const ReadmeClaim& claim : load_readme_claims(readme_claims_file())) {
        const std::tuple key(claim.scenario, claim.set, claim.draws, claim.seeds);
        auto found = registers.find(key);
        if (found == registers.end()) {
            study.say("assumptions: " + claim.scenario +
                      (claim.set.empty() ? "" : ", " + claim.set.front()));
            const std::string file = "assumptions/" + claim.id + ".json";
            found = registers.emplace(key, std::pair(weigh_claim(claim, study), file)).first;
            flights += static_cast<double>(found->second.first.flights);
            if (!write_file(study.folder / file, register_json(found->second.first) + "\n")) {
                throw InputError(fmt::format("cannot write {}: is the disk full?",
                                             (study.folder / file).string()));
            }
        }
        const auto& [all, file] = found->second;
        for (auto& row : moved_rows(claim.says, claim.figure, all)) {
            moved.push_back(std::move(row));
            moved_links.push_back(file);
        }
        settled.push_back(settled_row(claim.says, claim.figure, all));
        settled_links.push_back(file);
    }
    study.evidence.set("assumptions.flights", flights);
    study.table("readme-moved", std::move(moved), moved_links);
    study.table("readme-settled", std::move(settled), settled_links);
}

}  // namespace

StudyPart assumptions_part() {
    return {"assumptions",
            "What README's claims hang on",
            study_readme,
            {"assumptions.flights"},
            {"readme-moved", "readme-settled"}};
}

}  // namespace limpet::paper
