// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/rare/rare_summary.hpp"

namespace limpet::rare {

std::vector<std::filesystem::path> draw_rare(const RareSummary& summary,
                                             const std::filesystem::path& folder) {
    const SubsetResult& result = summary.result;
    if (result.curve.empty()) {
        return {};
    }
    const RareEvent& event = summary.event;
    draw::ChartSeries middle{.colour = draw::colours::kDarkBlue};
    draw::ChartSeries low{
        .name = "95 %", .mark = draw::ChartSeries::Mark::dashes, .colour = draw::colours::kOrange};
    draw::ChartSeries high{.mark = draw::ChartSeries::Mark::dashes,
                           .colour = draw::colours::kOrange};
    for (const RarePlace& place : result.curve) {
        const campaign::Interval interval = place.interval();
        const double x = event.value_at(place.fall);
        middle.add(x, place.probability);
        low.add(x, interval.low);
        high.add(x, interval.high);
    }
    draw::ChartPanel panel{.x_label = event.figure,
                           .y_label = fmt::format("probability of {} {}",
                                                  event.rising ? "more than" : "less than", "it"),
                           .series = {low, high, middle},
                           .log_y = true};
    if (result.ending == RareEnding::estimated) {
        panel.levels = {{result.probability(), event.text}};
    }
    if (!event.outcome) {
        panel.moments = {{event.limit, event.text}};
    }
    const draw::Chart chart{
        .title = summary.name + ": " + event.text,
        .subtitle =
            fmt::format("{} flights of {}, seed {}; {} level{}", summary.flown, summary.scenario,
                        summary.seed, result.levels.size(), result.levels.size() == 1 ? "" : "s"),
        .panels = {panel}};
    return draw_chart(chart, "rare", folder).files;
}

}  // namespace limpet::rare
