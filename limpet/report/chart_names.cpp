// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/chart_names.hpp"

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/report/axes.hpp"
#include "limpet/report/chart_parts.hpp"

namespace limpet {
namespace {

constexpr double kEntryGap_px = 22.0;
constexpr double kSlantSin = 0.643;  // of kSlant_deg

void check(const ChartPanel& panel) {
    for (const ChartSeries& s : panel.series) {
        require(s.x.size() == s.y.size(), "a series has as many x as y");
        require(s.low.size() == s.high.size() && (s.low.empty() || s.low.size() == s.x.size()),
                "a series has an interval for each point, or none");
    }
    for (const auto& range : {panel.x_range, panel.y_range}) {
        require(!range || range->low < range->high, "a range has a low end and a high end");
    }
    require((!panel.log_x || x_axis(panel).low > 0.0) && (!panel.log_y || y_axis(panel).low > 0.0),
            "a logarithmic axis is positive");
}

double legend_px(const ChartPanel& panel, double width_px) {
    const auto entries = legend(panel, width_px);
    return entries.empty() ? 0.0 : kLine_px * static_cast<double>(entries.back().row + 1) + 4.0;
}

}  // namespace

std::vector<LegendEntry> legend(const ChartPanel& panel, double width_px) {
    std::vector<LegendEntry> entries;
    double x = 0.0;
    std::size_t row = 0;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        if (panel.series[i].name.empty()) {
            continue;
        }
        const double wide = kSwatch_px + 8.0 + text_width_px(panel.series[i].name, kChartSmall_px);
        if (x > 0.0 && x + wide > width_px) {
            x = 0.0;
            ++row;
        }
        entries.push_back({i, x, row});
        x += wide + kEntryGap_px;
    }
    return entries;
}

bool moments_fit(const ChartPanel& panel, double width_px) {
    if (panel.log_x) {
        return false;
    }
    const Range x = x_axis(panel);
    std::vector<ChartLine> sorted = panel.moments;
    std::sort(sorted.begin(), sorted.end(),
              [](const ChartLine& a, const ChartLine& b) { return a.at < b.at; });
    const auto place_px = [&](double at) { return width_px * (at - x.low) / (x.high - x.low); };
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double end_px =
            place_px(sorted[i].at) + 10.0 + text_width_px(sorted[i].label, kChartSmall_px);
        const bool last = i + 1 == sorted.size();
        if (!sorted[i].label.empty() && end_px > (last ? width_px : place_px(sorted[i + 1].at))) {
            return false;
        }
    }
    return true;
}

double moments_px(const ChartPanel& panel, double width_px) {
    if (!panel.moments.empty() && moments_fit(panel, width_px)) {
        return kLine_px;
    }
    double longest = 0.0;
    for (const ChartLine& moment : panel.moments) {
        longest = std::max(longest, text_width_px(moment.label, kChartSmall_px));
    }
    return panel.moments.empty() ? 0.0 : kSlantSin * longest + kLeader_px + 14.0;
}

CategoryNames category_names(const ChartPanel& panel, double width_px) {
    CategoryNames names;
    const double slot = width_px / static_cast<double>(panel.categories.size()) - 8.0;
    double longest = 0.0;
    std::size_t most = 1;
    for (const std::string& name : panel.categories) {
        names.lines.push_back(wrapped(name, kChartSmall_px, slot));
        most = std::max(most, names.lines.back().size());
        longest = std::max(longest, text_width_px(name, kChartSmall_px));
        for (const std::string& line : names.lines.back()) {
            names.slanted = names.slanted || text_width_px(line, kChartSmall_px) > slot;
        }
    }
    names.height_px = names.slanted ? kSlantSin * longest + 14.0
                                    : 0.86 * kLine_px * static_cast<double>(most) + 6.0;
    return names;
}

Sides sides(const ChartPanel& panel) {
    check(panel);
    const Range y = y_axis(panel);
    double widest = 0.0;
    const double count = panel.height_px / 56.0;
    for (const double tick : panel.log_y ? log_ticks(y, count) : ticks(y, count)) {
        widest = std::max(widest, text_width_px(tick_label(tick), kChartFont_px));
    }
    double names = 0.0;
    for (const ChartLine& level : panel.levels) {
        for (const std::string& line : wrapped(level.label, kChartSmall_px, kLevelNames_px)) {
            names = std::max(names, text_width_px(line, kChartSmall_px));
        }
    }
    return {widest + 14.0, names > 0.0 ? names + 10.0 : 16.0};
}

double head_px(const ChartPanel& panel, double width_px) {
    return title_px(panel.title, width_px) + legend_px(panel, width_px) +
           (panel.y_label.empty() ? 0.0 : kLine_px) + moments_px(panel, width_px) + 8.0;
}

double foot_px(const ChartPanel& panel, double width_px) {
    const double names =
        panel.categories.empty() ? 30.0 : category_names(panel, width_px).height_px;
    return names + (panel.x_label.empty() ? 4.0 : 28.0);
}

}  // namespace limpet
