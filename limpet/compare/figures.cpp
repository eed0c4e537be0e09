// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "limpet/compare/report.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::compare {
namespace {

constexpr double kPanel_px = 200.0;
constexpr double kColumn_px = 720.0;
/// Two flights of one scenario may do the same a sample or two apart; of a force that jumps such a
/// shift makes as large a difference as the jump.
constexpr double kShift_s = 0.02;

/// Less than this of a unit is of no interest, least of all the last bits of a number that is 0.
struct LeastSpan {
    std::string_view unit;
    double span;
};
constexpr LeastSpan kLeastSpans[] = {
    {"hPa", 2.0}, {"N", 0.5},    {"N m", 0.05},  {"mm", 0.5}, {"deg", 0.2}, {"deg/s", 1.0},
    {"m", 0.01},  {"m/s", 0.02}, {"rad/s", 2.0}, {"V", 0.05}, {"A", 0.2},   {"share", 0.01}};

double least_span(const FlightChannel& channel) {
    const LeastSpan* found =
        std::find_if(std::begin(kLeastSpans), std::end(kLeastSpans),
                     [&](const LeastSpan& one) { return one.unit == channel.unit; });
    return found == std::end(kLeastSpans) ? 0.0 : found->span;
}

/// They differ in lightness and in dashes, not in hue alone.
constexpr std::array kOtherColours = {draw::colours::kOrange, draw::colours::kGreen,
                                      draw::colours::kPlum, draw::colours::kBlue};

/// Groups in the order of the files; "others" hold other programs' topics.
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

std::vector<draw::ChartLine> phase_lines(const record::Recording& recording) {
    std::vector<draw::ChartLine> lines;
    for (const record::RecordedEvent& event : recording.events) {
        lines.push_back({event.time_s, record::words(event.name)});
    }
    return lines;
}

/// Whether there is anything to see: a valve that stays closed fills no panel.
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

/// What a state's values mean, in whichever flight they occur.
std::vector<draw::ChartLine> names_of_values(const FlightChannel& channel,
                                             const std::vector<FlightTrace>& others) {
    std::map<double, std::string> names = channel.names;
    std::set<double> occurring(channel.values.begin(), channel.values.end());
    for (const FlightTrace& other : others) {
        if (const FlightChannel* same = find_named(other.channels, channel.name)) {
            names.insert(same->names.begin(), same->names.end());
            occurring.insert(same->values.begin(), same->values.end());
        }
    }
    std::vector<draw::ChartLine> lines;
    for (const auto& [value, name] : names) {
        if (occurring.count(value) > 0) {
            lines.push_back({value, name});
        }
    }
    return lines;
}

/// The two panels of a channel.
std::array<draw::ChartPanel, 2> channel_panels(const FlightChannel& channel,
                                               const FlightTrace& reference,
                                               const std::vector<FlightTrace>& others,
                                               const std::vector<FlightComparison>& comparisons,
                                               const record::Window& whole) {
    draw::ChartPanel overlay{.title = channel.title,
                             .x_label = "time of the reference  [s]",
                             .y_label = channel.unit.empty() ? channel.name : channel.unit,
                             .moments = phase_lines(*reference.recording),
                             .y_names = names_of_values(channel, others),
                             .x_range = draw::Range{whole.from_s, whole.to_s},
                             .least_span = least_span(channel),
                             .height_px = kPanel_px};
    draw::ChartPanel difference = overlay;
    difference.title =
        fmt::format("{}: difference beyond a shift of {:.0f} ms", channel.title, 1e3 * kShift_s);
    const bool state = channel.kind == ChannelKind::state;
    if (state) {
        difference.title = channel.title + ": alike or not";
        difference.y_names = {{0.0, "alike"}, {1.0, "not alike"}};
        difference.y_range = draw::Range{-0.1, 1.1};
    }
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
        Differences all = beyond_shift(channel, *other, comparisons[k].pieces, kShift_s);
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
                               const std::filesystem::path& folder, const Work& work) {
    const draw::gnuplot::TemporaryFolder scratch;
    const record::Window whole = whole_flight(*reference.recording);
    draw::Pictures pictures;
    for (const char* group : kGroups) {
        work.say(fmt::format("drawing {}", group));
        draw::Chart chart{.title = fmt::format("{}: {}", reference.label, group),
                          .subtitle =
                              "left: flights over each other, events laid on events; right: how "
                              "far off the reference",
                          .columns = 2,
                          .column_px = kColumn_px};
        for (const FlightChannel& channel : reference.channels) {
            if (channel.group == group && worth_drawing(channel, comparisons)) {
                auto panels = channel_panels(channel, reference, others, comparisons, whole);
                bool named = chart.panels.empty();  // over the first alone
                for (draw::ChartPanel& panel : panels) {
                    for (draw::ChartLine& moment : panel.moments) {
                        moment.label = named ? moment.label : "";
                    }
                    named = false;
                }
                chart.panels.insert(chart.panels.end(), panels.begin(), panels.end());
            }
        }
        if (!chart.panels.empty()) {
            const draw::Pictures drawn =
                draw_chart(chart, fmt::format("compare_{}", group), scratch.path() / "drawn");
            pictures.files.insert(pictures.files.end(), drawn.files.begin(), drawn.files.end());
        }
    }
    work.say();
    return {draw::publish(pictures.files, folder), {}};
}

}  // namespace limpet::compare
