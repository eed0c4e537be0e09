// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/report/figure_sketch.hpp"
#include "limpet/report/gnuplot.hpp"

namespace limpet {
namespace {

/// More points than this many times four cannot be told apart on the page.
constexpr std::size_t kBins = 1200;

std::string subtitle_of(const Summary& summary) {
    std::string text = "outcome: " + (summary.outcome.empty() ? "unknown" : words(summary.outcome));
    if (!summary.reason.empty()) {
        text += fmt::format(" ({})", summary.reason);
    }
    if (!summary.seed.empty()) {
        text += fmt::format("  ·  seed {}", summary.seed);
    }
    return text;
}

Figure make_figure(const Recording& recording, const Chapter& chapter) {
    const Summary facts = summary(recording);
    Figure figure;
    figure.title =
        fmt::format("{}: {}", facts.scenario.empty() ? "flight" : facts.scenario, chapter.title);
    figure.subtitle = subtitle_of(facts);
    if (!recording.damage.empty()) {
        // What closes a recording is its summary: where that is, the end is not what is missing.
        figure.warning =
            recording.attachment("summary.json") != nullptr
                ? "recording damaged"
                : fmt::format("recording cut at t = {:.2f} s", whole_flight(recording).to_s);
    }
    figure.window = chapter.window;
    figure.panels = panels(recording, chapter.window);
    for (Panel& panel : figure.panels) {
        for (Curve& curve : panel.curves) {
            curve = thinned(curve, chapter.window, kBins);
        }
    }
    for (const RecordedEvent& event : recording.events) {
        if (chapter.window.holds(event.time_s)) {
            figure.events.push_back(event);
        }
    }
    std::stable_sort(figure.events.begin(), figure.events.end(),
                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
    for (const Phase& phase : phases(recording)) {
        if (phase.window.to_s > chapter.window.from_s &&
            phase.window.from_s < chapter.window.to_s) {
            figure.phases.push_back(phase);
        }
    }
    return figure;
}

}  // namespace

Pictures plot(const Recording& recording, const std::filesystem::path& folder) {
    const gnuplot::TemporaryFolder work;
    std::vector<std::filesystem::path> drawn;
    for (const Chapter& chapter : chapters(recording)) {
        const Figure figure = make_figure(recording, chapter);
        if (figure.panels.empty() || chapter.window.span_s() <= 0.0) {
            continue;
        }
        for (const auto& file :
             draw(figure_sketch(figure), figure_data(figure), chapter.file, work.path())) {
            drawn.push_back(file);
        }
    }
    if (drawn.empty()) {
        throw InputError(fmt::format("{}: nothing to plot: {}", recording.path.string(),
                                     recording.damage.empty() ? "no pressure, pitch, force, thrust "
                                                                "or distance was recorded"
                                                              : recording.damage));
    }
    return {publish(drawn, folder), missing_topics(recording)};
}

}  // namespace limpet
