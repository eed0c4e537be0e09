// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/core/read_file.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/px4/console.hpp"
#include "output.hpp"
#include "px4_link.hpp"

namespace limpet::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr FileBound kConsole{"PX4's console", 256};

std::string milliseconds(double duration_s) {
    return fmt::format("{:.3g} ms", 1e3 * duration_s);
}

std::string quantiles(const wire::DurationHistogram& histogram) {
    return fmt::format("median {}, p99 {}, largest {}", milliseconds(histogram.quantile_s(0.5)),
                       milliseconds(histogram.quantile_s(0.99)),
                       milliseconds(histogram.largest_s()));
}

Json json_of(const wire::DurationHistogram& histogram) {
    Json bins = Json::array();
    for (std::size_t k = 0; k < wire::DurationHistogram::kBins; ++k) {
        if (histogram.bins()[k] > 0) {
            bins.push_back(
                {{"up_to_s", wire::DurationHistogram::edge_s(k)}, {"count", histogram.bins()[k]}});
        }
    }
    return {{"count", histogram.count()},
            {"mean_s", histogram.mean_s()},
            {"median_s", histogram.quantile_s(0.5)},
            {"p99_s", histogram.quantile_s(0.99)},
            {"largest_s", histogram.largest_s()},
            {"bins", bins}};
}

Json json_of(const mavlink::Link& link) {
    const mavlink::LinkCount count = link.count();
    return {{"wire", link.transport().describe()},
            {"sent", count.sent},
            {"not_sent", count.not_sent},
            {"received", count.received},
            {"lost", count.lost},
            {"damaged", count.damaged},
            {"refused_unsigned", count.refusals.total() - count.refusals.version_1},
            {"mavlink1", count.refusals.version_1},
            {"discarded_bytes", count.discarded_bytes}};
}

/// Counts over time on a logarithmic axis; an empty bin on either side shows where it ends.
draw::ChartPanel panel_of(const std::string& title, const std::string& what,
                          const wire::DurationHistogram& histogram) {
    draw::ChartPanel panel{.title = title, .x_label = what + "  [ms]", .y_label = "messages"};
    panel.log_x = true;
    draw::ChartSeries series{.mark = draw::ChartSeries::Mark::steps};
    std::size_t first = wire::DurationHistogram::kBins;
    std::size_t last = 0;
    for (std::size_t k = 0; k < wire::DurationHistogram::kBins; ++k) {
        if (histogram.bins()[k] > 0) {
            first = std::min(first, k);
            last = k;
        }
    }
    for (std::size_t k = first > 1 ? first - 1 : first; k <= last + 1; ++k) {
        series.x.push_back(1e3 * wire::DurationHistogram::edge_s(k) / std::exp2(0.25));
        series.y.push_back(
            k < wire::DurationHistogram::kBins ? static_cast<double>(histogram.bins()[k]) : 0.0);
    }
    panel.series.push_back(series);
    panel.moments.push_back({.at = 1e3 * histogram.quantile_s(0.5), .label = "median"});
    panel.moments.push_back({.at = 1e3 * histogram.quantile_s(0.99), .label = "99 %"});
    return panel;
}

Files draw(const mavlink::HilCount& hil, const std::filesystem::path& folder) {
    draw::Chart chart{.title = "What the link cost", .subtitle = "in wall time; logarithmic axis"};
    chart.panels.push_back(panel_of("From HIL_SENSOR to its answer", "round trip", hil.round_trip));
    if (hil.send_jitter.count() > 0) {
        chart.panels.push_back(panel_of("HIL_SENSOR off its time", "jitter", hil.send_jitter));
    }
    return draw_chart(chart, "link", folder).files;
}

}  // namespace

void Px4Link::report(const simulation::FlightPerformance& performance, Terminal& terminal) const {
    const mavlink::HilCount& hil = wires_->autopilot().count();
    terminal.line("sensors", fmt::format("{} sent, {} answered, {} missed", hil.sensors_sent,
                                         hil.answers, hil.unanswered));
    for (const auto& [name, link] : links()) {
        const mavlink::LinkCount count = link->count();
        terminal.line(name, fmt::format("{} messages sent, {} received, {} lost, {} damaged",
                                        count.sent, count.received, count.lost, count.damaged));
        if (const std::uint64_t frames = count.refusals.version_1; frames > 0) {
            terminal.line("", fmt::format("{} frames of MAVLink 1 were not read", frames));
        }
    }
    if (hil.round_trip.count() > 0) {
        terminal.line("round trip", quantiles(hil.round_trip));
    }
    if (hil.send_jitter.count() > 0) {
        terminal.line("jitter", quantiles(hil.send_jitter));
    }
    if (const auto own_share = performance.own_share()) {
        terminal.line("share",
                      fmt::format("{:.1f} % of the wall time was the simulator's, the rest was "
                                  "the autopilot's",
                                  100.0 * *own_share));
    }
}

std::vector<std::filesystem::path> Px4Link::write(const simulation::FlightPerformance& performance,
                                                  const std::filesystem::path& folder, bool figures,
                                                  Terminal& terminal) {
    const mavlink::HilCount& hil = wires_->autopilot().count();
    Json json = Json::object();
    for (const auto& [name, link] : links()) {
        json["wires"][name] = json_of(*link);
    }
    json["sensors"] = hil.sensors_sent;
    json["answers"] = hil.answers;
    json["unanswered"] = hil.unanswered;
    json["strays"] = hil.strays;
    json["round_trip"] = json_of(hil.round_trip);
    json["send_jitter"] = json_of(hil.send_jitter);
    json["wall_s"] = performance.wall_s;
    json["waited_for_autopilot_s"] = performance.waited_s;
    json["parameters_that_differ"] = differences_;
    if (const auto own_share = performance.own_share()) {
        json["own_share"] = *own_share;
    }
    std::vector<std::filesystem::path> files = {folder / "link.json"};
    write_file(files.front(), json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    const auto logs = keep_logs(folder);
    files.insert(files.end(), logs.begin(), logs.end());
    if (!logs.empty()) {
        const px4::Px4Console console = px4::read_px4_console(read_file(logs.front(), kConsole));
        if (const std::string text = console_text(console); !text.empty()) {
            terminal.line("px4.log", text);
        }
        for (const std::string& line : console.lines) {
            terminal.line("", line);
        }
    }
    if (figures) {
        files = with_drawn(std::move(files), [&] { return draw(hil, folder); });
    }
    if (wire_log_) {
        wire_finished_ = true;
        wire_log_->finish();
        files.push_back(wire_log_->path());
    }
    return files;
}

}  // namespace limpet::app
