// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/report/panels.hpp"

namespace limpet::report {
namespace {

constexpr double kWidth_px = 1400.0;

std::string subtitle_of(const record::Summary& summary) {
    std::string text =
        "outcome: " + (summary.outcome.empty() ? "unknown" : record::words(summary.outcome));
    if (!summary.reason.empty()) {
        text += fmt::format(" ({})", summary.reason);
    }
    if (!summary.seed.empty()) {
        text += fmt::format("  ·  seed {}", summary.seed);
    }
    return text;
}

}  // namespace

draw::Chart flight_chart(const record::Recording& recording, const record::Chapter& chapter) {
    const record::Summary facts = summary(recording);
    draw::Chart chart{
        .title = fmt::format("{}: {}", facts.scenario.empty() ? "flight" : facts.scenario,
                             chapter.title),
        .subtitle = subtitle_of(facts),
        .column_px = kWidth_px};
    if (!recording.damage.empty()) {
        // What closes a recording is its summary: where that is, the end is not what is missing.
        chart.warning =
            recording.attachment("summary.json") != nullptr
                ? "recording damaged"
                : fmt::format("recording cut at t = {:.2f} s", whole_flight(recording).to_s);
    }
    // Events and states stand over the first panel and run through all.
    for (draw::ChartPanel& panel : panels(recording, chapter.window)) {
        const bool first = chart.panels.empty();
        for (const record::RecordedEvent& event : recording.events) {
            if (chapter.window.holds(event.time_s)) {
                const auto name =
                    fmt::format("{}  {:.2f}", record::words(event.name), event.time_s);
                panel.moments.push_back({event.time_s, first ? name : ""});
            }
        }
        for (const auto& [state, window] : phases(recording)) {
            if (window.to_s > chapter.window.from_s && window.from_s < chapter.window.to_s) {
                panel.stretches.push_back(
                    {{window.from_s, window.to_s}, first ? record::words(state) : ""});
            }
        }
        chart.panels.emplace_back(std::move(panel));
    }
    return chart;
}

draw::Pictures plot(const record::Recording& recording, const std::filesystem::path& folder) {
    const draw::gnuplot::TemporaryFolder work;
    std::vector<std::filesystem::path> drawn;
    for (const record::Chapter& chapter : chapters(recording)) {
        if (chapter.window.span_s() > 0.0) {
            const draw::Chart chart = flight_chart(recording, chapter);
            if (!chart.panels.empty()) {
                const auto files = draw_chart(chart, chapter.file, work.path() / "drawn").files;
                drawn.insert(drawn.end(), files.begin(), files.end());
            }
        }
    }
    if (drawn.empty()) {
        throw InputError(fmt::format("{}: nothing to plot: {}", recording.path.string(),
                                     recording.damage.empty() ? "no pressure, pitch, force, thrust "
                                                                "or distance was recorded"
                                                              : recording.damage));
    }
    return {draw::publish(drawn, folder), missing_topics(recording)};
}

}  // namespace limpet::report
