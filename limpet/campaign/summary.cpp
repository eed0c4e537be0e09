// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/find_by.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::campaign {
namespace {

constexpr std::size_t kMostValues = 30;  ///< of a grid; more are put into bins
constexpr std::size_t kMostBins = 10;
constexpr std::size_t kRunsABin = 8;  ///< of what is drawn, on average and at least

std::vector<EndingCount> count_endings(SQLite::Database& database, const std::string& sql,
                                       std::uint32_t finished) {
    std::vector<EndingCount> endings;
    SQLite::Statement select(database, sql);
    while (select.executeStep()) {
        endings.push_back({select.getColumn(0).getString(),
                           select.getColumn(1).getString(),
                           {select.getColumn(2).getUInt(), finished}});
    }
    return endings;
}

/// Calls each(value, successes and runs at it), values ascending.
template <class Each>
void for_each_value(SQLite::Database& database, const std::string& key, const std::string& success,
                    const Each& each) {
    SQLite::Statement select(
        database, fmt::format("SELECT {0}, sum({1}), count(*) FROM runs GROUP BY {0} ORDER BY {0}",
                              sql_name(key), success));
    while (select.executeStep()) {
        each(select.getColumn(0),
             statistics::Proportion{select.getColumn(1).getUInt(), select.getColumn(2).getUInt()});
    }
}

statistics::Interval range_of(SQLite::Database& database, const std::string& key) {
    SQLite::Statement select(database,
                             fmt::format("SELECT min({0}), max({0}) FROM runs", sql_name(key)));
    select.executeStep();
    return {select.getColumn(0).getDouble(), select.getColumn(1).getDouble()};
}

/// @param values  so many were drawn or listed
std::vector<Group> groups_by_bin(const std::vector<statistics::Trials>& trials,
                                 const statistics::Interval& range, std::size_t values) {
    const std::size_t bins = std::clamp<std::size_t>(values / kRunsABin, 1, kMostBins);
    const double low = range.low;
    const double width = (range.high - low) / static_cast<double>(bins);
    std::vector<Group> groups;
    for (std::size_t i = 0; i < bins; ++i) {
        const double from = low + static_cast<double>(i) * width;
        const double to = from + width;
        groups.push_back({fmt::format("{:.4g}..{:.4g}", from, to), from, to, {}});
    }
    for (const statistics::Trials& t : trials) {
        const double at = width > 0.0 ? (t.x - low) / width : 0.0;
        statistics::Proportion& sum =
            groups[std::min(static_cast<std::size_t>(at), bins - 1)].proportion;
        sum.runs += t.proportion.runs;
        sum.successes += t.proportion.successes;
    }
    return groups;
}

KeySummary summarise_key(SQLite::Database& database, const VariedKey& key,
                         const std::string& success, std::uint32_t finished) {
    KeySummary summary{.key = key.key, .named = is_named(key)};
    if (summary.named) {
        for_each_value(database, key.key, success,
                       [&](const auto& value, const statistics::Proportion& p) {
                           summary.groups.push_back({value.getString(), 0.0, 0.0, p});
                       });
        return summary;
    }
    const bool drawn = key.values.empty();
    const statistics::Interval range = range_of(database, key.key);
    statistics::TrialsAlong along(range, drawn ? finished : 0);
    for_each_value(database, key.key, success,
                   [&](const auto& value, const statistics::Proportion& p) {
                       along.add({value.getDouble(), p});
                   });
    const std::vector<statistics::Trials>& trials = along.all();
    if (drawn || trials.size() > kMostValues) {
        summary.groups = groups_by_bin(trials, range, drawn ? finished : trials.size());
    } else {
        for (const statistics::Trials& t : trials) {
            summary.groups.push_back({scenario::number_text(t.x), t.x, t.x, t.proportion});
        }
    }
    summary.fit = statistics::fit_logistic(trials);
    if (summary.fit &&
        std::abs(summary.fit->slope) < statistics::kNormal95 * summary.fit->slope_error) {
        summary.fit.reset();  // no trend: a curve would draw noise
    }
    if (summary.fit) {
        constexpr int kFitted = 2;
        summary.fit_goodness = statistics::goodness_of(
            trials, [&](double x) { return summary.fit->probability(x); }, kFitted);
        summary.curve = statistics::fit_success_curve(trials);
    }
    return summary;
}

std::vector<MetricSummary> summarise_metrics(SQLite::Database& database) {
    std::vector<MetricSummary> summaries;
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        const auto runs =
            database.execAndGet(fmt::format("SELECT count({}) FROM runs", metric.name)).getUInt();
        if (runs == 0) {
            continue;
        }
        SQLite::Statement select(
            database,
            fmt::format("SELECT {0} FROM runs WHERE {0} IS NOT NULL ORDER BY {0}", metric.name));
        const std::vector<double> at = statistics::quantiles(runs, {0.05, 0.5, 0.95}, [&select] {
            select.executeStep();
            return select.getColumn(0).getDouble();
        });
        summaries.push_back({std::string(metric.name), runs, at[0], at[1], at[2]});
    }
    return summaries;
}

std::vector<std::string> autopilots_of(Results& results) {
    std::vector<std::string> reported;
    if (results.campaign().on_px4) {
        SQLite::Statement select(results.database(),
                                 "SELECT DISTINCT autopilot FROM runs WHERE autopilot <> '' "
                                 "ORDER BY autopilot");
        while (select.executeStep()) {
            reported.push_back(select.getColumn(0).getString());
        }
    }
    return reported;
}

}  // namespace

std::string headline(const std::string& name, const std::string& description) {
    return description.empty() ? name : name + ": " + description;
}

CampaignSummary summarise(Results& results) {
    return asking(results.database(), [&results] {
        const Campaign& campaign = results.campaign();
        SQLite::Database& database = results.database();
        const std::vector<std::string> success_means =
            names_of(campaign.success, [](Outcome outcome) { return to_string(outcome); });
        const std::string success = success_sql(campaign);
        const std::uint32_t finished = results.finished();
        const auto successes =
            database.execAndGet(fmt::format("SELECT count(*) FROM runs WHERE {}", success))
                .getUInt();
        CampaignSummary summary{
            .name = campaign.name,
            .description = campaign.description,
            .scenario = campaign.scenario_name,
            .version = results.version(),
            .autopilots = autopilots_of(results),
            .seed = campaign.seed,
            .runs = campaign.runs,
            .finished = finished,
            .success_means = success_means,
            .success = {successes, finished},
            .outcomes = count_endings(
                database,
                "SELECT outcome, '', count(*) AS n FROM runs GROUP BY outcome ORDER BY n DESC, 1",
                finished),
            .true_ends =
                count_endings(database,
                              "SELECT true_end, '', count(*) AS n FROM runs WHERE true_end <> '' "
                              "GROUP BY true_end ORDER BY n DESC, 1",
                              finished),
            .failures = count_endings(
                database,
                fmt::format(
                    "SELECT outcome, CASE WHEN outcome IN ('{}') THEN reason || '; in truth '"
                    " || true_end ELSE reason END, count(*) AS n FROM runs WHERE NOT {} "
                    "GROUP BY 1, 2 ORDER BY n DESC, 1, 2",
                    fmt::join(success_means, "', '"), success),
                finished),
            .keys = {},
            .metrics = summarise_metrics(database)};
        if (finished > 0) {
            for (const VariedKey& key : campaign.keys) {
                summary.keys.push_back(summarise_key(database, key, success, finished));
            }
        }
        return summary;
    });
}

}  // namespace limpet::campaign
