// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "limpet/campaign/summary.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/record/story.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::campaign {
namespace {

using Mark = draw::ChartSeries::Mark;

constexpr std::size_t kMostPanels = 8;
constexpr int kFitPoints = 120;

void add(draw::ChartSeries& series, double x, const statistics::Proportion& proportion) {
    const statistics::Interval interval = proportion.interval();
    series.add(x, proportion.probability(), {interval.low, interval.high});
}

draw::ChartPanel outcomes(const CampaignSummary& summary) {
    draw::ChartPanel panel{
        .y_label = "share of the runs", .y_range = draw::Range{0.0, 1.0}, .height_px = 220.0};
    draw::ChartSeries shares{.mark = Mark::bars};
    for (const EndingCount& ending : summary.outcomes) {
        add(shares, panel.category(record::words(ending.outcome)), ending.proportion);
    }
    panel.series = {shares};
    return panel;
}

/// Of a key's row in the parameter tables; empty for what is no number there.
std::string_view unit_of(std::string_view section, std::string_view name) {
    scenario::Scenario defaults;
    for (const scenario::Section& one : scenario_sections(defaults)) {
        for (const BoundParameter& row : one.rows) {
            if (one.name == section && row.name == name) {
                return row.unit;
            }
        }
    }
    return {};
}

/// "impact speed  [m/s], pendulum" of pendulum.impact_speed_m_s.
std::string label_of(std::string_view key) {
    const std::size_t dot = key.rfind('.');
    const std::string_view section = dot == key.npos ? "" : key.substr(0, dot);
    std::string_view name = dot == key.npos ? key : key.substr(dot + 1);
    const std::string_view unit = unit_of(section, name);
    std::string ending = "_";  // "m/s^2" is _m_s2 in a name
    for (const char c : unit) {
        ending += c == '/' || c == ' ' ? "_" : c == '^' ? "" : std::string(1, c);
    }
    if (ending.size() > 1 && name.size() > ending.size() &&
        name.substr(name.size() - ending.size()) == ending) {
        name.remove_suffix(ending.size());
    }
    std::string place(section);
    std::replace(place.begin(), place.end(), '.', ' ');
    return record::words(name) + (unit.empty() || unit == "-" ? "" : fmt::format("  [{}]", unit)) +
           (place.empty() ? "" : ", " + record::words(place));
}

draw::ChartPanel success_against(const KeySummary& key) {
    draw::ChartPanel panel{.x_label = label_of(key.key),
                           .y_label = "probability of success",
                           .y_range = draw::Range{-0.02, 1.02}};
    draw::ChartSeries points{.mark = Mark::points, .colour = draw::colours::kDarkBlue};
    for (std::size_t i = 0; i < key.groups.size(); ++i) {
        const Group& group = key.groups[i];
        if (key.named) {
            panel.categories.push_back(group.label);
        }
        if (group.proportion.runs > 0) {
            add(points, key.named ? static_cast<double>(i) : group.middle(), group.proportion);
        }
    }
    if (!key.named) {
        const double low = key.groups.front().low, high = key.groups.back().high;
        const double air = high > low ? 0.04 * (high - low) : 0.5;
        panel.x_range = draw::Range{low - air, high + air};
        if (key.fit) {
            panel.series.push_back({.colour = draw::colours::kOrange});
            panel.series.back().add(*panel.x_range, kFitPoints,
                                    [&](double x) { return key.probability(x); });
        }
    }
    panel.series.push_back(points);
    return panel;
}

}  // namespace

std::vector<std::filesystem::path> draw_summary(const CampaignSummary& summary,
                                                const std::filesystem::path& folder) {
    if (summary.finished == 0) {
        return {};
    }
    draw::Chart chart{
        .title = headline(summary.name, summary.description),
        .subtitle =
            fmt::format("{} of {} runs of {}, seed {}; points and bars with 95 % Wilson intervals",
                        summary.finished, summary.runs, summary.scenario, summary.seed),
        .panels = {outcomes(summary)}};
    for (std::size_t i = 0; i < std::min(summary.keys.size(), kMostPanels); ++i) {
        chart.panels.push_back(success_against(summary.keys[i]));
    }
    return draw_chart(chart, "summary", folder).files;
}

}  // namespace limpet::campaign
