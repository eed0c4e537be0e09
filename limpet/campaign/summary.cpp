// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::campaign {
namespace {

constexpr std::size_t kMostValues = 30;  ///< of a grid; more are put into bins
constexpr std::size_t kMostBins = 10;
constexpr std::size_t kRunsABin = 8;  ///< of what is drawn, on average and at least

/// `outcome IN ('perched', 'released')`
std::string success_sql(const Campaign& campaign) {
    std::string list;
    for (const Outcome outcome : campaign.success) {
        list += fmt::format("{}'{}'", list.empty() ? "" : ", ", to_string(outcome));
    }
    return fmt::format("(outcome IN ({}))", list);
}

std::vector<EndingCount> count_endings(SQLite::Database& database, const std::string& sql,
                                       std::uint32_t finished) {
    std::vector<EndingCount> endings;
    SQLite::Statement select(database, sql);
    while (select.executeStep()) {
        const auto count = static_cast<std::uint32_t>(select.getColumn(2).getInt64());
        endings.push_back(
            {select.getColumn(0).getString(), select.getColumn(1).getString(), {count, finished}});
    }
    return endings;
}

/// Successes and runs at each value, ascending.
std::vector<Trials> trials_of(SQLite::Database& database, const std::string& key,
                              const std::string& success) {
    std::vector<Trials> trials;
    SQLite::Statement select(
        database, fmt::format("SELECT {0}, sum({1}), count(*) FROM runs GROUP BY {0} ORDER BY {0}",
                              sql_name(key), success));
    while (select.executeStep()) {
        trials.push_back({select.getColumn(0).getDouble(),
                          {static_cast<std::uint32_t>(select.getColumn(1).getInt64()),
                           static_cast<std::uint32_t>(select.getColumn(2).getInt64())}});
    }
    return trials;
}

std::vector<Group> groups_by_name(SQLite::Database& database, const std::string& key,
                                  const std::string& success) {
    std::vector<Group> groups;
    SQLite::Statement select(
        database, fmt::format("SELECT {0}, sum({1}), count(*) FROM runs GROUP BY {0} ORDER BY {0}",
                              sql_name(key), success));
    while (select.executeStep()) {
        groups.push_back(
            {.label = select.getColumn(0).getString(),
             .low = 0.0,
             .high = 0.0,
             .proportion = {static_cast<std::uint32_t>(select.getColumn(1).getInt64()),
                            static_cast<std::uint32_t>(select.getColumn(2).getInt64())}});
    }
    return groups;
}

std::vector<Group> groups_by_value(const std::vector<Trials>& trials) {
    std::vector<Group> groups;
    for (const Trials& t : trials) {
        groups.push_back({scenario::number_text(t.x), t.x, t.x, t.proportion});
    }
    return groups;
}

std::vector<Group> groups_by_bin(const std::vector<Trials>& trials) {
    const std::size_t bins = std::clamp<std::size_t>(trials.size() / kRunsABin, 1, kMostBins);
    const double low = trials.front().x;
    const double width = (trials.back().x - low) / static_cast<double>(bins);
    std::vector<Group> groups;
    for (std::size_t i = 0; i < bins; ++i) {
        const double from = low + static_cast<double>(i) * width;
        const double to = from + width;
        groups.push_back({fmt::format("{:.4g}..{:.4g}", from, to), from, to, {}});
    }
    for (const Trials& t : trials) {
        const double at = width > 0.0 ? (t.x - low) / width : 0.0;
        Proportion& sum = groups[std::min(static_cast<std::size_t>(at), bins - 1)].proportion;
        sum.runs += t.proportion.runs;
        sum.successes += t.proportion.successes;
    }
    return groups;
}

KeySummary summarise_key(SQLite::Database& database, const VariedKey& key,
                         const std::string& success) {
    KeySummary summary{.key = key.key, .named = is_named(key), .groups = {}, .fit = {}};
    if (summary.named) {
        summary.groups = groups_by_name(database, key.key, success);
        return summary;
    }
    const std::vector<Trials> trials = trials_of(database, key.key, success);
    const bool few = !key.values.empty() && trials.size() <= kMostValues;
    summary.groups = few ? groups_by_value(trials) : groups_by_bin(trials);
    summary.fit = fit_logistic(trials);
    if (summary.fit && std::abs(summary.fit->slope) < kNormal95 * summary.fit->slope_error) {
        summary.fit.reset();  // no trend: a curve would draw noise
    }
    return summary;
}

std::vector<MetricSummary> summarise_metrics(SQLite::Database& database) {
    std::vector<MetricSummary> summaries;
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        std::vector<double> values;
        SQLite::Statement select(
            database,
            fmt::format("SELECT {0} FROM runs WHERE {0} IS NOT NULL ORDER BY {0}", metric.name));
        while (select.executeStep()) {
            values.push_back(select.getColumn(0).getDouble());
        }
        if (!values.empty()) {
            summaries.push_back({std::string(metric.name),
                                 static_cast<std::uint32_t>(values.size()), quantile(values, 0.05),
                                 quantile(values, 0.5), quantile(values, 0.95)});
        }
    }
    return summaries;
}

}  // namespace

CampaignSummary summarise(Results& results) {
    return asking(results.database(), [&results] {
        const Campaign& campaign = results.campaign();
        SQLite::Database& database = results.database();
        const std::string success = success_sql(campaign);
        CampaignSummary summary;
        summary.name = campaign.name;
        summary.description = campaign.description;
        summary.scenario = campaign.scenario_name;
        summary.version = results.version();
        summary.seed = campaign.seed;
        summary.runs = campaign.runs;
        summary.finished = results.finished();
        for (const Outcome outcome : campaign.success) {
            summary.success_means.emplace_back(to_string(outcome));
        }
        summary.success = {
            static_cast<std::uint32_t>(
                database.execAndGet(fmt::format("SELECT count(*) FROM runs WHERE {}", success))
                    .getInt64()),
            summary.finished};
        summary.outcomes = count_endings(
            database,
            "SELECT outcome, '', count(*) AS n FROM runs GROUP BY outcome ORDER BY n DESC, 1",
            summary.finished);
        summary.failures = count_endings(
            database,
            fmt::format("SELECT outcome, reason, count(*) AS n FROM runs WHERE NOT {} "
                        "GROUP BY outcome, reason ORDER BY n DESC, 1, 2",
                        success),
            summary.finished);
        if (summary.finished > 0) {
            for (const VariedKey& key : campaign.keys) {
                summary.keys.push_back(summarise_key(database, key, success));
            }
        }
        summary.metrics = summarise_metrics(database);
        return summary;
    });
}

}  // namespace limpet::campaign
