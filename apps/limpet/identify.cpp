// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/time.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/identification/identification.hpp"
#include "limpet/identification/pressure_log.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct IdentifyOptions {
    std::string log;
    std::string out;
    bool json = false;
    double atmosphere_hPa = hectopascals(kAtmosphere_Pa);
    identification::IdentificationOptions of_log;
};

/// A line of the table: what, in which unit, and Table II's if it has one.
struct Row {
    const char* name;
    const char* key;
    const char* unit;
    std::optional<identification::Fitted> fitted;
    double suction::Surface::*table_two = nullptr;

    /// How people read it: pressures in hPa.
    [[nodiscard]] double shown(double value) const {
        return unit == std::string_view("hPa") ? hectopascals(value) : value;
    }
};

/// The surface of Table II whose numbers are nearest, each as a ratio; none where one is off by
/// more than half.
std::optional<scenario::Surface> nearest_surface(const identification::PressureFit& fit) {
    std::optional<scenario::Surface> nearest;
    double least = 0.0;
    for (const char* name : {"porous_concrete", "cinder_block", "turbine_blade", "metal"}) {
        const scenario::Surface surface = scenario::load_surface(name, scenario::data_root());
        double distance = 0.0;
        bool near = true;
        for (const auto& [fitted, value] :
             {std::pair(fit.vacuum_Pa, surface.vacuum_pressure_Pa),
              std::pair(fit.sealing_time_s, surface.sealing_time_constant_s),
              std::pair(fit.unsealing_time_s, surface.unsealing_time_constant_s)}) {
            if (fitted) {
                const double off = std::log(fitted->value > 0.0 ? fitted->value / value : 1e9);
                distance += off * off;
                near = near && std::abs(off) < std::log(1.5);
            }
        }
        if (near && (!nearest || distance < least)) {
            nearest = surface;
            least = distance;
        }
    }
    return nearest;
}

std::vector<Row> rows_of(const identification::PressureFit& fit) {
    using S = suction::Surface;
    std::optional<identification::Fitted> offset = fit.atmosphere_Pa;
    if (offset) {
        offset->value -= kAtmosphere_Pa;
    }
    return {
        {"P_atm", "atmosphere_Pa", "hPa", fit.atmosphere_Pa},
        {"  - 1013.25", "atmosphere_offset_Pa", "hPa", offset},
        {"P_vac", "vacuum_pressure_Pa", "hPa", fit.vacuum_Pa, &S::vacuum_pressure_Pa},
        {"tau_1", "sealing_time_constant_s", "s", fit.sealing_time_s, &S::sealing_time_constant_s},
        {"tau_2", "unsealing_time_constant_s", "s", fit.unsealing_time_s,
         &S::unsealing_time_constant_s},
        {"sealing from", "sealing_begins_s", "s", fit.sealing_begins_s},
        {"unsealing from", "unsealing_begins_s", "s", fit.unsealing_begins_s},
        {"ripple", "ripple_Hz", "Hz", fit.ripple_Hz},
    };
}

/// Decimals that show two digits of an interval.
int decimals(double half_width) {
    constexpr int kMost = 9;
    return half_width > 0.0
               ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, kMost)
               : kMost;
}

std::string text_of(const identification::PressureFit& fit, const std::vector<Row>& rows,
                    const std::optional<scenario::Surface>& surface) {
    std::string text = fmt::format("{:<16}{:>12}    {:<15}{}\n", "", "value", "95 % interval",
                                   surface ? "Table II: " + surface->name : "");
    for (const Row& row : rows) {
        if (!row.fitted) {
            continue;
        }
        const double half = row.shown(row.fitted->half_width);
        const int digits = decimals(half);
        text += fmt::format("{:<16}{:>12.{}f} +- {:<9.{}f} {:<4}", row.name,
                            row.shown(row.fitted->value), digits, half, digits, row.unit);
        text += surface && row.table_two != nullptr
                    ? fmt::format("{:>6.4g}\n", row.shown((*surface).*row.table_two))
                    : "\n";
    }
    if (fit.ripple_Hz) {
        text += fmt::format("{:<16}{:>12.4g}              hPa\n", "  amplitude",
                            hectopascals(fit.ripple_Pa));
    }
    text +=
        fmt::format("{:<16}{:>12.4g}              hPa, of {} samples, correlated over {:.2g} s\n",
                    "residual", hectopascals(fit.residual_Pa), fit.samples, fit.memory_s);
    for (const std::string& note : fit.notes) {
        text += "note            " + note + "\n";
    }
    return text;
}

ordered_json json_of(const identification::PressureFit& fit, const std::vector<Row>& rows,
                     const std::optional<scenario::Surface>& surface, double origin_s) {
    ordered_json json;
    for (const Row& row : rows) {
        json[row.key] = nullptr;
        if (row.fitted) {
            json[row.key] = {{"value", row.fitted->value},
                             {"low", row.fitted->value - row.fitted->half_width},
                             {"high", row.fitted->value + row.fitted->half_width}};
        }
    }
    json["confidence"] = identification::kConfidence;
    json["ripple_Pa"] = fit.ripple_Pa;
    json["residual_Pa"] = fit.residual_Pa;
    json["residual_memory_s"] = fit.memory_s;
    json["samples"] = fit.samples;
    json["time_origin_s"] = origin_s;
    json["nearest_surface"] = surface ? ordered_json(surface->name) : ordered_json(nullptr);
    json["notes"] = fit.notes;
    return json;
}

/// What was measured and the curve, above what the curve leaves.
draw::Chart chart_of(const identification::PressureTrace& trace,
                     const identification::PressureFit& fit, const std::string& title) {
    using Mark = draw::ChartSeries::Mark;
    constexpr std::size_t kCrowd = 1000;  // from here on points hide one another
    const Mark mark = trace.t_s.size() > kCrowd ? Mark::line : Mark::points;
    draw::ChartSeries data{.name = "measured", .mark = mark};
    draw::ChartSeries rest{.mark = mark};
    const draw::Range times{trace.t_s.front(), trace.t_s.back()};
    constexpr std::size_t kMostDrawn = 10'000;
    const std::size_t stride = trace.t_s.size() / kMostDrawn + 1;
    for (std::size_t i = 0; i < trace.t_s.size(); i += stride) {
        const double curve_Pa = pressure_Pa(fit.curve, trace.t_s[i]);
        data.x.push_back(trace.t_s[i]);
        data.y.push_back(hectopascals(trace.pressure_Pa[i]));
        if (i >= fit.first_sample && i < fit.first_sample + fit.samples) {
            rest.x.push_back(trace.t_s[i]);
            rest.y.push_back(hectopascals(trace.pressure_Pa[i] - curve_Pa));
        }
    }
    draw::ChartSeries curve{.name = "eqs. (5), (6)", .mark = Mark::line};
    constexpr int kPoints = 2000;
    const double first_s = trace.t_s[fit.first_sample];
    const double last_s = trace.t_s[fit.first_sample + fit.samples - 1];
    for (int k = 0; k <= kPoints; ++k) {
        curve.x.push_back(first_s + (last_s - first_s) * k / kPoints);
        curve.y.push_back(hectopascals(mean_pressure_Pa(fit.curve, curve.x.back())));
    }
    std::vector<draw::ChartLine> moments;
    for (const auto& [begins_s, name] : {std::pair(fit.sealing_begins_s, "sealing"),
                                         std::pair(fit.unsealing_begins_s, "unsealing")}) {
        if (begins_s) {
            moments.push_back({begins_s->value, name});
        }
    }
    return {.title = title,
            .panels = {draw::ChartPanel{.y_label = "pressure  [hPa]",
                                        .series = {std::move(data), std::move(curve)},
                                        .moments = std::move(moments),
                                        .x_range = times},
                       draw::ChartPanel{.x_label = "time  [s]",
                                        .y_label = "left over  [hPa]",
                                        .series = {std::move(rest)},
                                        .x_range = times,
                                        .height_px = 140.0}}};
}

void require_sense(const identification::IdentificationOptions& options) {
    for (const auto& [name, value] :
         {std::pair("--pump-on", options.pump_on_s), std::pair("--pump-off", options.pump_off_s),
          std::pair("--from", options.from_s), std::pair("--to", options.to_s)}) {
        if (value && !std::isfinite(*value)) {
            throw InputError(fmt::format("{} {}: must be a time in s", name, *value));
        }
    }
    if (options.from_s && options.to_s && *options.from_s >= *options.to_s) {
        throw InputError(
            fmt::format("--from {}: must be before --to {}", *options.from_s, *options.to_s));
    }
}

void identify(IdentifyOptions options) {
    require_sense(options.of_log);
    options.of_log.atmosphere_Pa = 100.0 * options.atmosphere_hPa;
    const std::atomic<bool>* stop = stop_on_signals();
    const auto go_on = [stop](const char* written) {
        if (*stop) {
            throw Interrupted(fmt::format("interrupted; {} was written", written));
        }
    };
    const fs::path log = scenario::find_sample(options.log, ".csv");
    const identification::PressureTrace trace = identification::read_pressure_log(log);
    for (std::optional<double>* time_s : {&options.of_log.pump_on_s, &options.of_log.pump_off_s,
                                          &options.of_log.from_s, &options.of_log.to_s}) {
        if (*time_s) {
            *time_s = since_origin_s(**time_s, trace.origin_s);
        }
    }
    go_on("nothing");
    identification::PressureFit fit;
    try {
        fit = identify_pressure(trace, options.of_log);
    } catch (const InputError& error) {
        throw InputError(log.string() + ": " + error.what());
    }
    if (trace.origin_s > 0.0) {
        fit.notes.push_back(
            fmt::format("times are from the first sample, at {:.3f} s", trace.origin_s));
    }
    go_on("nothing");
    const std::optional<scenario::Surface> surface = nearest_surface(fit);
    const std::vector<Row> rows = rows_of(fit);
    const bool draws =
        !options.json || !options.out.empty();  // for a program: figures only on request
    const fs::path folder = options.out.empty() ? "out/identify" : options.out;
    if (draws) {
        (void)make_folder(folder);
    }
    fmt::print("{}", options.json
                         ? json_of(fit, rows, surface, trace.origin_s)
                                   .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
                               "\n"
                         : text_of(fit, rows, surface));
    if (!draws) {
        return;
    }
    const std::vector<fs::path> files = with_drawn({}, [&] {
        return draw_chart(chart_of(trace, fit, log.filename().string()), "identify", folder).files;
    });
    if (!options.json) {
        print_files(files);
    }
    go_on("all");
}

OptionList options_of(IdentifyOptions& options) {
    return {{"log CSV", &options.log,
             "CSV with columns t_s and pressure_Pa among any others, or the name of\n"
             "a sample (limpet list samples)"},
            {"--pump-on S", &options.of_log.pump_on_s, "when sealing begins (default: found)"},
            {"--pump-off S", &options.of_log.pump_off_s, "when unsealing begins (default: found)"},
            {"--from S", &options.of_log.from_s, "leave out what is before"},
            {"--to S", &options.of_log.to_s, "leave out what is after, as where the cup lets go"},
            {"--atmosphere HPA", &options.atmosphere_hPa,
             "where the log does not show it (default: 1013.25)", range(10.0, 1200.0)},
            {"--out DIR", &options.out, "folder of the figure (default: out/identify)"},
            {"--json", &options.json, "one JSON object, in SI; the figure only with --out"}};
}

}  // namespace

Verb identify_verb() {
    return verb<IdentifyOptions>(
        "identify", "Fit P_vac, tau_1, tau_2 of eqs. (5), (6) to a log of cup pressure", options_of,
        identify,
        "Columns t_s and pressure_Pa [Pa], in any order, between commas, semicolons or tabs; or\n"
        "those of a recording:\n"
        "  limpet csv flight.mcap && limpet identify csv/sensors_cup_pressure.csv\n"
        "A log may hold a sealing, an unsealing or both; what is missing is reported. Intervals "
        "are for\n"
        "95 % and hold for ripple and drift. Draws identify.png and identify.svg.\n");
}

}  // namespace limpet::app
