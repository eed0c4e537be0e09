// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/rare/rare_results.hpp"

namespace limpet::rare {

/// What a search for a rare event has found so far.
struct RareSummary {
    std::string name;
    std::string description;
    std::string scenario;
    std::string version;  ///< of the Limpet that flew it
    std::uint64_t seed = 0;
    RareEvent event;
    std::uint32_t level_runs = 0;
    std::uint32_t flown = 0;
    SubsetResult result;
    std::vector<std::string> keys;              ///< that vary
    std::optional<campaign::RunRow> likeliest;  ///< the event's run nearest to the medians, if any
};

[[nodiscard]] RareSummary summarise_rare(campaign::Results& results, const RareSearch& search);
/// The same where the search's result is known.
[[nodiscard]] RareSummary summarise_rare(campaign::Results& results, const RareSearch& search,
                                         const SubsetResult& result);

/// For people: lines of at most a screen's width.
[[nodiscard]] std::string rare_text(const RareSummary& summary);
/// One JSON object.
[[nodiscard]] std::string rare_json(const RareSummary& summary);

/// Draws probability against the figure over all levels, with 95 % intervals, as rare.png and
/// rare.svg.
/// @param folder  made when it is not there
/// @return the files; none before the first level is done
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_rare(const RareSummary& summary,
                                             const std::filesystem::path& folder);

}  // namespace limpet::rare
