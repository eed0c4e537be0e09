// SPDX-License-Identifier: Apache-2.0
#include "link_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/draw/chart.hpp"

namespace limpet::app {
namespace {

using Json = nlohmann::ordered_json;

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

Json json_of(const LinkReport::Wire& wire) {
    const mavlink::LinkCount& count = wire.count;
    return {{"wire", wire.where},
            {"sent", count.sent},
            {"not_sent", count.not_sent},
            {"received", count.received},
            {"lost", count.lost},
            {"damaged", count.damaged},
            {"refused_unsigned", count.unsigned_},
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

}  // namespace

std::vector<std::string> lines_of(const LinkReport& report, const Terminal& terminal) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& label, const std::string& text) {
        lines.push_back(terminal.bold(fmt::format("{:<11}", label)) + text);
    };
    add("sensors", fmt::format("{} sent, {} answered, {} missed", report.hil.sensors_sent,
                               report.hil.answers, report.hil.unanswered));
    for (const LinkReport::Wire& wire : report.wires) {
        add(wire.name,
            fmt::format("{} messages sent, {} received, {} lost, {} damaged", wire.count.sent,
                        wire.count.received, wire.count.lost, wire.count.damaged));
    }
    if (report.hil.round_trip.count() > 0) {
        add("round trip", quantiles(report.hil.round_trip));
    }
    if (report.hil.send_jitter.count() > 0) {
        add("jitter", quantiles(report.hil.send_jitter));
    }
    if (report.wall_s > 0.0 && !report.held_back) {
        add("share", fmt::format("{:.1f} % of the wall time was the simulator's own, the rest was "
                                 "the autopilot's",
                                 100.0 * (1.0 - report.waited_s / report.wall_s)));
    }
    return lines;
}

std::string json_of(const LinkReport& report) {
    Json json = Json::object();
    for (const LinkReport::Wire& wire : report.wires) {
        json["wires"][wire.name] = json_of(wire);
    }
    json["sensors"] = report.hil.sensors_sent;
    json["answers"] = report.hil.answers;
    json["unanswered"] = report.hil.unanswered;
    json["strays"] = report.hil.strays;
    json["round_trip"] = json_of(report.hil.round_trip);
    json["send_jitter"] = json_of(report.hil.send_jitter);
    json["wall_s"] = report.wall_s;
    json["waited_for_autopilot_s"] = report.waited_s;
    return json.dump(2);
}

std::vector<std::filesystem::path> draw(const LinkReport& report,
                                        const std::filesystem::path& folder) {
    draw::Chart chart{.title = "What the link cost", .subtitle = "in wall time; logarithmic axis"};
    chart.panels.push_back(
        panel_of("From HIL_SENSOR to its answer", "round trip", report.hil.round_trip));
    if (report.hil.send_jitter.count() > 0) {
        chart.panels.push_back(
            panel_of("HIL_SENSOR beside its time", "jitter", report.hil.send_jitter));
    }
    const draw::Pictures pictures = draw_chart(chart, "link", folder);
    return pictures.files;
}

}  // namespace limpet::app
