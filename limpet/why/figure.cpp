// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

using Curve = std::vector<double> HoldTrace::*;

/// One curve of the trace from a hold's seal on.
draw::ChartSeries from_seal(const HoldTrace& trace, Curve curve, const Hold& hold, double for_s,
                            draw::ChartSeries series) {
    for (std::size_t i = 0; i < trace.time_s.size(); ++i) {
        const double since_s = trace.time_s[i] - hold.sealed_s;
        if (since_s >= 0.0 && since_s <= for_s) {
            series.add(since_s, (trace.*curve)[i]);
        }
    }
    return series;
}

/// How long is drawn: the hold and half as much again, that the remedy's goes on is to be seen; no
/// longer than there is something to draw.
double drawn_s(const Hold& hold, const HoldTrace& trace, const Hold* mended,
               const HoldTrace& mended_trace) {
    constexpr double kLeast_s = 0.5, kMost_s = 90.0;
    const double hold_s = std::isnan(hold.ended_s) ? kMost_s : 1.5 * (hold.ended_s - hold.sealed_s);
    const auto traced_s = [](const Hold* of, const HoldTrace& its) {
        return of == nullptr || its.time_s.empty() ? 0.0 : its.time_s.back() - of->sealed_s;
    };
    const double there_s = std::max(traced_s(&hold, trace), traced_s(mended, mended_trace));
    return std::max(kLeast_s, std::min(hold_s, there_s));
}

}  // namespace

std::vector<std::filesystem::path> draw_why(const Found& found,
                                            const std::filesystem::path& folder) {
    const Hold* hold = decisive_hold(found.base);
    if (hold == nullptr) {
        return {};
    }
    const Hold* mended = found.remedy.changes.empty() ? nullptr : decisive_hold(found.remedy);
    const double for_s = drawn_s(*hold, found.trace, mended, found.remedy_trace);
    const auto both = [&](draw::ChartPanel& panel, Curve curve, const char* name,
                          const char* colour) {
        panel.x_range = draw::Range{0.0, for_s};
        panel.series.push_back(
            from_seal(found.trace, curve, *hold, for_s, {.name = name, .colour = colour}));
        if (mended != nullptr) {
            panel.series.push_back(from_seal(found.remedy_trace, curve, *mended, for_s,
                                             {.name = std::string(name) + ", with the changes",
                                              .mark = draw::ChartSeries::Mark::dashes,
                                              .colour = colour}));
        }
        if (!std::isnan(hold->ended_s)) {
            panel.moments = {{hold->ended_s - hold->sealed_s, hold->let_go}};
        }
    };
    draw::ChartPanel margins{.y_label = "to spare  [N]", .levels = {{0.0, "lets go"}}};
    both(margins, &HoldTrace::pull_margin_N, "pull", draw::colours::kBlue);
    both(margins, &HoldTrace::shear_margin_N, "shear", draw::colours::kGreen);
    both(margins, &HoldTrace::peel_margin_N, "peel", draw::colours::kOrange);
    draw::ChartPanel pitch{.y_label = "pitch  [deg]"};
    both(pitch, &HoldTrace::pitch_deg, "pitch", draw::colours::kDarkBlue);
    draw::ChartPanel pressure{.x_label = "time since it sealed  [s]",
                              .y_label = "cup pressure  [hPa]"};
    both(pressure, &HoldTrace::pressure_hPa, "pressure", draw::colours::kDarkBlue);
    std::string changes;
    for (const Change& change : found.remedy.changes) {
        changes += (changes.empty() ? "dashes: " : ", ") + change.override_text();
    }
    return draw::draw_chart({.title = fmt::format("{}: {}: {}", found.scenario,
                                                  to_string(found.base.result.outcome),
                                                  found.base.result.reason),
                             .subtitle = changes,
                             .panels = {margins, pitch, pressure},
                             .column_px = 900.0},
                            "why", folder)
        .files;
}

}  // namespace limpet::why
