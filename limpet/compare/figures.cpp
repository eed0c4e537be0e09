// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "limpet/core/find_by.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"

namespace limpet::compare {
namespace {

constexpr double kPanel_px = 200.0;
/// Events closer than this share of the flight to the one before are not named a second time.
constexpr double kNameApart = 0.045;
/// Names so close to the end of the flight would not fit on the page.
constexpr double kLastName = 0.12;

/// Told apart by lightness and by dashes, not by hue alone.
constexpr std::array kOtherColours = {draw::colours::kOrange, draw::colours::kGreen,
                                      draw::colours::kPlum, draw::colours::kBlue};

/// Groups in the order of the files; "others" hold what is not ours.
constexpr std::array kGroups = {"cup",      "force",  "attitude", "rates",    "position", "speed",
                                "distance", "rotors", "battery",  "setpoint", "others"};

/// A flight on the reference's time, with a gap between the pieces.
draw::ChartSeries on_reference_time(const FlightChannel& channel,
                                    const std::vector<Piece>& pieces) {
    draw::ChartSeries curve;
    const auto& t = channel.time_s;
    for (const Piece& piece : pieces) {
        const auto first =
            std::lower_bound(t.begin(), t.end(), piece.window.from_s + piece.shift_s);
        for (auto i = static_cast<std::size_t>(first - t.begin());
             i < t.size() && t[i] - piece.shift_s < piece.window.to_s; ++i) {
            curve.x.push_back(t[i] - piece.shift_s);
            curve.y.push_back(channel.values[i]);
        }
    }
    return curve;
}

/// The reference's events, named where there is room: a name begins at its line and goes right.
std::vector<draw::ChartLine> phase_lines(const record::Recording& recording,
                                         const record::Window& whole) {
    std::vector<draw::ChartLine> lines;
    double last_s = -std::numeric_limits<double>::infinity();
    for (const record::RecordedEvent& event : recording.events) {
        if (event.time_s - last_s > kNameApart * whole.span_s()) {
            const bool fits = whole.to_s - event.time_s > kLastName * whole.span_s();
            lines.push_back({event.time_s, fits ? record::words(event.name) : ""});
            last_s = event.time_s;
        }
    }
    return lines;
}

/// Whether there is anything to see: a valve that nobody opens fills no panel.
bool worth_drawing(const FlightChannel& channel, const std::vector<FlightComparison>& comparisons) {
    const auto flat = [](const Extremes& e) { return !(e.highest > e.lowest); };
    return std::any_of(comparisons.begin(), comparisons.end(), [&](const FlightComparison& c) {
        return std::any_of(c.channels.begin(), c.channels.end(), [&](const ChannelDifference& d) {
            const bool still = d.kind == ChannelKind::state && d.largest == 0.0 &&
                               flat(d.reference) && flat(d.other);
            return d.name == channel.name && !still;
        });
    });
}

/// The two panels of a channel.
std::array<draw::ChartPanel, 2> channel_panels(const FlightChannel& channel,
                                               const FlightTrace& reference,
                                               const std::vector<FlightTrace>& others,
                                               const std::vector<FlightComparison>& comparisons,
                                               const record::Window& whole) {
    const std::string unit = channel.unit.empty() ? "" : fmt::format("  [{}]", channel.unit);
    draw::ChartPanel overlay{.title = channel.title,
                             .x_label = "time of the reference  [s]",
                             .y_label = channel.unit.empty() ? channel.name : channel.unit,
                             .moments = phase_lines(*reference.recording, whole),
                             .x_range = draw::Range{whole.from_s, whole.to_s},
                             .height_px = kPanel_px};
    draw::ChartPanel difference = overlay;
    difference.title = fmt::format("{}, difference", channel.title);
    const bool state = channel.kind == ChannelKind::state;
    overlay.series.push_back(
        {.name = reference.label,
         .mark = state ? draw::ChartSeries::Mark::steps : draw::ChartSeries::Mark::line,
         .x = channel.time_s,
         .y = channel.values,
         .colour = draw::colours::kDarkBlue});
    for (std::size_t k = 0; k < others.size(); ++k) {
        const FlightChannel* other = find_named(others[k].channels, channel.name);
        if (other == nullptr) {
            continue;
        }
        draw::ChartSeries series = on_reference_time(*other, comparisons[k].pieces);
        series.mark = state ? draw::ChartSeries::Mark::steps : draw::ChartSeries::Mark::dashes;
        Differences all = differences(channel, *other, comparisons[k].pieces);
        draw::ChartSeries off{.x = std::move(all.time_s), .y = std::move(all.values)};
        for (draw::ChartSeries* one : {&series, &off}) {
            one->name = others[k].label;
            one->colour = kOtherColours[k % kOtherColours.size()];
        }
        overlay.series.push_back(series);
        difference.series.push_back(off);
    }
    return {overlay, difference};
}

}  // namespace

draw::Pictures draw_comparison(const FlightTrace& reference, const std::vector<FlightTrace>& others,
                               const std::vector<FlightComparison>& comparisons,
                               const std::filesystem::path& folder) {
    const record::Window whole = whole_flight(*reference.recording);
    draw::Pictures pictures;
    for (const char* group : kGroups) {
        draw::Chart chart{
            .title = fmt::format("{}: {}", reference.label, group),
            .subtitle = "left: flights over each other; right: how far off the reference",
            .columns = 2};
        for (const FlightChannel& channel : reference.channels) {
            if (channel.group == group && worth_drawing(channel, comparisons)) {
                auto panels = channel_panels(channel, reference, others, comparisons, whole);
                for (draw::ChartPanel& panel : panels) {
                    for (draw::ChartLine& moment : panel.moments) {
                        moment.label = chart.panels.empty() ? moment.label : "";
                    }
                }
                chart.panels.insert(chart.panels.end(), panels.begin(), panels.end());
            }
        }
        if (!chart.panels.empty()) {
            const draw::Pictures drawn =
                draw_chart(chart, fmt::format("compare_{}", group), folder);
            pictures.files.insert(pictures.files.end(), drawn.files.begin(), drawn.files.end());
        }
    }
    return pictures;
}

}  // namespace limpet::compare
