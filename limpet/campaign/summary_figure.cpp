// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "limpet/campaign/summary.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/record/story.hpp"

namespace limpet::campaign {
namespace {

using Mark = draw::ChartSeries::Mark;

constexpr std::size_t kMostPanels = 8;
constexpr int kFitPoints = 120;

void append(draw::ChartSeries& series, double x, const Proportion& proportion) {
    const Interval interval = proportion.interval();
    series.x.push_back(x);
    series.y.push_back(proportion.probability());
    series.low.push_back(interval.low);
    series.high.push_back(interval.high);
}

draw::ChartPanel outcomes(const CampaignSummary& summary) {
    draw::ChartPanel panel{
        .y_label = "share of the runs", .y_range = draw::Range{0.0, 1.0}, .height_px = 220.0};
    draw::ChartSeries shares{.mark = Mark::bars};
    for (const EndingCount& ending : summary.outcomes) {
        append(shares, static_cast<double>(panel.categories.size()), ending.proportion);
        panel.categories.push_back(record::words(ending.outcome));
    }
    panel.series = {shares};
    return panel;
}

draw::ChartSeries fitted(const LogisticFit& fit, const draw::Range& range) {
    draw::ChartSeries curve{.colour = draw::colours::kOrange};
    for (int i = 0; i <= kFitPoints; ++i) {
        curve.x.push_back(range.low + (range.high - range.low) * i / kFitPoints);
        curve.y.push_back(fit.probability(curve.x.back()));
    }
    return curve;
}

/// How keys end that carry a unit, the longest first, and how people write it.
constexpr std::pair<std::string_view, const char*> kUnits[] = {
    {"_kg_m2", "kg m²"}, {"_N_m_rad", "N m/rad"},
    {"_N_s_m", "N s/m"}, {"_m_s_s", "m/s²"},
    {"_m_s2", "m/s²"},   {"_rad_s", "rad/s"},
    {"_deg_s", "deg/s"}, {"_N_m", "N m"},
    {"_m_s", "m/s"},     {"_deg", "deg"},
    {"_rad", "rad"},     {"_Pa", "Pa"},
    {"_hPa", "hPa"},     {"_mm", "mm"},
    {"_Hz", "Hz"},       {"_ms", "ms"},
    {"_kg", "kg"},       {"_Wh", "Wh"},
    {"_N", "N"},         {"_m", "m"},
    {"_s", "s"},         {"_V", "V"},
    {"_A", "A"},         {"_W", "W"}};

/// "impact speed  [m/s], pendulum" of pendulum.impact_speed_m_s.
std::string label_of(std::string_view key) {
    const std::size_t dot = key.rfind('.');
    const std::string_view section = dot == key.npos ? "" : key.substr(0, dot);
    std::string_view name = dot == key.npos ? key : key.substr(dot + 1);
    std::string unit;
    for (const auto& [ending, written] : kUnits) {
        if (unit.empty() && name.size() > ending.size() &&
            name.substr(name.size() - ending.size()) == ending) {
            name.remove_suffix(ending.size());
            unit = fmt::format("  [{}]", written);
        }
    }
    std::string place(section);
    std::replace(place.begin(), place.end(), '.', ' ');
    return record::words(name) + unit + (place.empty() ? "" : ", " + record::words(place));
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
            append(points, key.named ? static_cast<double>(i) : group.middle(), group.proportion);
        }
    }
    if (!key.named) {
        const double low = key.groups.front().low, high = key.groups.back().high;
        const double air = high > low ? 0.04 * (high - low) : 0.5;
        panel.x_range = draw::Range{low - air, high + air};
        if (key.fit) {
            panel.series.push_back(fitted(*key.fit, *panel.x_range));
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
        .title = summary.name + ": " + summary.description,
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
