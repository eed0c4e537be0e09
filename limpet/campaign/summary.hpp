// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/campaign/results.hpp"
#include "limpet/statistics/shares.hpp"
#include "limpet/statistics/success_curve.hpp"

namespace limpet::campaign {

/// Runs that ended alike; `proportion` is of all runs.
struct EndingCount {
    std::string outcome;
    std::string reason;  ///< empty where outcomes alone are counted
    statistics::Proportion proportion;
};

/// Runs at one value of a key, or within low..high of it.
struct Group {
    std::string label;  ///< "1.1", "1.0..1.2", "metal"
    double low = 0.0;   ///< of numbers; equal to `high` where there is one value
    double high = 0.0;
    statistics::Proportion proportion;
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// Success against one varied key, over whatever the other keys were.
struct KeySummary {
    std::string key;
    bool named = false;
    std::vector<Group> groups = {};
    std::optional<statistics::LogisticFit> fit = {};  ///< of the runs themselves, not of the groups
    std::optional<statistics::Goodness> fit_goodness = {};
    std::optional<statistics::SuccessCurve> curve = {};  ///< with a plateau; where there is a fit
    /// The curve with a plateau is the one that the runs follow rather.
    [[nodiscard]] bool fit_rejected() const { return fit_goodness && fit_goodness->rejected(); }
    /// By the fit, or where that is rejected by the curve; there is a fit.
    [[nodiscard]] double probability(double x) const {
        return curve && fit_rejected() ? curve->probability(x) : fit->probability(x);
    }
};

struct MetricSummary {
    std::string name;
    std::uint32_t runs = 0;  ///< in which it came to pass
    double p05 = 0.0;
    double median = 0.0;
    double p95 = 0.0;
};

/// What a campaign has found so far.
struct CampaignSummary {
    std::string name;
    std::string description;
    std::string scenario;
    std::string version;                  ///< of the Limpet that flew it
    std::vector<std::string> autopilots;  ///< on PX4s: what they reported to be
    std::uint64_t seed = 0;
    std::uint32_t runs = 0;      ///< planned
    std::uint32_t finished = 0;  ///< flown
    std::vector<std::string> success_means;
    statistics::Proportion success;
    std::vector<EndingCount> outcomes;   ///< most frequent first
    std::vector<EndingCount> true_ends;  ///< by the truth, their names as outcomes
    std::vector<EndingCount> failures;   ///< outcome and reason of what is no success
    std::vector<KeySummary> keys;
    std::vector<MetricSummary> metrics;  ///< those that came to pass at all
};

[[nodiscard]] CampaignSummary summarise(Results& results);

/// "NAME: DESCRIPTION", the name alone where nothing is described.
[[nodiscard]] std::string headline(const std::string& name, const std::string& description);

/// For people: lines of at most a screen's width.
[[nodiscard]] std::string summary_text(const CampaignSummary& summary);
/// One JSON object.
[[nodiscard]] std::string summary_json(const CampaignSummary& summary);

/// Draws outcomes and success against each varied key, with 95 % intervals and fits, as summary.png
/// and summary.svg.
/// @param folder  made when it is not there
/// @return the files
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_summary(const CampaignSummary& summary,
                                                const std::filesystem::path& folder);

/// Writes cells.html: a table of what became of each cell of two grids, the last two of the
/// campaign's, one table for each combination of its other grids; a cell says its outcome, and
/// pressed why and the command that flies it again. One file that needs nothing else.
/// @param database  of the results, as the page's commands name it
/// @param folder    made when it is not there
/// @return nothing for a campaign without two grids, or whose grids are longer than a page
/// @throws InputError for an unwritable folder
[[nodiscard]] std::optional<std::filesystem::path> write_cells(
    Results& results, const std::filesystem::path& database, const std::filesystem::path& folder);

}  // namespace limpet::campaign
