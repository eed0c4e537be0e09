// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::report {
namespace {

constexpr double kWidth_px = 1100.0;  ///< wider, its letters would be specks on a phone

std::string subtitle_of(const record::Summary& summary, const record::Chapter& chapter) {
    std::string text = chapter.ending.empty()
                           ? "outcome: "
                           : fmt::format("ends: {}  ·  the whole flight: ", chapter.ending);
    text += record::ending_words(summary);
    if (!summary.reason.empty()) {
        text += fmt::format(" ({})", summary.reason);
    }
    if (!summary.seed.empty()) {
        text += fmt::format("  ·  seed {}", summary.seed);
    }
    return text;
}

/// Times count from the chapter's zero.
void shift(draw::ChartPanel& panel, const record::Chapter& chapter) {
    for (draw::ChartSeries& series : panel.series) {
        for (double& x : series.x) {
            x -= chapter.zero_s;
        }
    }
    panel.x_range =
        draw::Range{chapter.window.from_s - chapter.zero_s, chapter.window.to_s - chapter.zero_s};
    if (!panel.x_label.empty() && !chapter.zero.empty()) {
        panel.x_label = fmt::format("time since {}  [s]", chapter.zero);
    }
}

/// "impact  3.90", of a chapter "landing started  +0.50".
std::string name_of(const record::RecordedEvent& event, const record::Chapter& chapter) {
    return chapter.zero.empty() ? fmt::format("{}  {:.2f}", record::words(event.name), event.time_s)
                                : fmt::format("{}  {:+.2f}", record::words(event.name),
                                              event.time_s - chapter.zero_s);
}

/// Events and states run through a panel, named over the first one.
void add_story(draw::ChartPanel& panel, const record::Recording& recording,
               const record::Chapter& chapter, bool named) {
    for (const record::RecordedEvent& event : recording.events) {
        if (chapter.window.holds(event.time_s)) {
            panel.moments.push_back(
                {event.time_s - chapter.zero_s, named ? name_of(event, chapter) : ""});
        }
    }
    for (const auto& [state, window] : phases(recording)) {
        if (window.to_s > chapter.window.from_s && window.from_s < chapter.window.to_s) {
            panel.stretches.push_back(
                {{window.from_s - chapter.zero_s, window.to_s - chapter.zero_s},
                 named ? record::words(state) : ""});
        }
    }
}

}  // namespace

draw::Chart flight_chart(const record::Recording& recording, const record::Chapter& chapter) {
    const record::Summary facts = summary(recording);
    draw::Chart chart{
        .title = fmt::format("{}: {}", facts.scenario.empty() ? "flight" : facts.scenario,
                             chapter.title),
        .subtitle = subtitle_of(facts, chapter),
        .column_px = kWidth_px};
    if (!chapter.zero.empty()) {
        chart.subtitle += fmt::format("  ·  {} at {:.2f} s", chapter.zero, chapter.zero_s);
    }
    if (!recording.damage.empty()) {
        // What closes a recording is its summary: where that is, the end is not what is missing.
        chart.warning =
            recording.attachment("summary.json") != nullptr
                ? "recording damaged"
                : fmt::format("recording cut at t = {:.2f} s", whole_flight(recording).to_s);
    }
    for (draw::ChartPanel& panel : panels(recording, chapter.window)) {
        shift(panel, chapter);
        add_story(panel, recording, chapter, chart.panels.empty());
        chart.panels.emplace_back(std::move(panel));
    }
    return chart;
}

draw::Pictures plot(const record::Recording& recording, const std::filesystem::path& folder,
                    const Work& work) {
    const draw::gnuplot::TemporaryFolder scratch;
    std::vector<std::filesystem::path> drawn;
    for (const record::Chapter& chapter : chapters(recording)) {
        work.say("drawing " + chapter.file);
        if (chapter.window.span_s() > 0.0) {
            const draw::Chart chart = flight_chart(recording, chapter);
            if (!chart.panels.empty()) {
                const auto files = draw_chart(chart, chapter.file, scratch.path() / "drawn").files;
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
    work.say();
    return {draw::publish(drawn, folder), missing_topics(recording)};
}

void remove_figures(const std::filesystem::path& folder) {
    for (const char* name : record::kChapterFiles) {
        const std::filesystem::path png = folder / fmt::format("{}.png", name);
        const std::filesystem::path svg = folder / fmt::format("{}.svg", name);
        std::error_code ignored;
        if (is_regular_file(png, ignored) && is_regular_file(svg, ignored)) {
            remove(png, ignored);
            remove(svg, ignored);
        }
    }
}

}  // namespace limpet::report
