// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/identification/identification.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/record/story.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/suction/pneumatics.hpp"

namespace limpet::paper {
namespace {

/// A column of Table II: a scenario of the press rig, and its surface for people.
struct Column {
    const char* scenario;
    const char* name;
};
constexpr std::array<Column, 4> kColumns = {{
    {"press_concrete", "porous concrete"},
    {"press_cinder_block", "cinder block"},
    {"press_turbine_blade", "wind turbine blade"},
    {"press_metal", "metallic surface"},
}};

/// One surface of Fig. 2 on the press rig, and what its log gives.
struct Press {
    std::string name;
    std::string flight;
    suction::Surface surface = {};
    identification::PressureTrace trace = {};
    identification::PressureFit fit = {};
    /// Of the same experiment with the pneumatic model.
    identification::PressureFit pneumatic = {};
};

/// What the vehicle's sensor measured on a flight, with its noise.
identification::PressureTrace flown(const FlightOrder& order, const std::filesystem::path& folder) {
    const PaperFlight flight = fly_recorded(order, folder);
    const auto [time_s, values] =
        flight.recording.series("/sensors/cup_pressure", "fluid_pressure");
    return {.t_s = {time_s.begin(), time_s.end()}, .pressure_Pa = {values.begin(), values.end()}};
}

/// The pneumatic model's leak depends on the clamping; Table II was fitted at 20 N (0008).
const std::vector<std::string> kPneumatic = {"suction.pressure_model=pneumatic",
                                             "press_rig.press_N=20",
                                             "wall.surface.seal_threshold_median_N=10"};

/// Without the pneumatic model's.
/// @param set  of the scenario
Press fly_press(const Column& column, const std::vector<std::string>& set,
                const std::filesystem::path& folder) {
    const std::string scenario = column.scenario;
    Press result{
        .name = column.name,
        .flight = scenario,
        .surface = scenario::load_scenario(scenario, {.overrides = set}).wall.surface,
        .trace = flown({.name = scenario, .scenario = scenario, .overrides = set}, folder)};
    result.fit = identify_pressure(result.trace);
    return result;
}

/// P_vac below the log's own atmosphere, so that the sensor's offset does not count.
std::optional<identification::Fitted> true_vacuum_Pa(const identification::PressureFit& fit) {
    if (!fit.vacuum_Pa || !fit.atmosphere_Pa) {
        return fit.vacuum_Pa;
    }
    return identification::Fitted{
        .value = kAtmosphere_Pa - (fit.atmosphere_Pa->value - fit.vacuum_Pa->value),
        .half_width = std::hypot(fit.vacuum_Pa->half_width, fit.atmosphere_Pa->half_width)};
}

double value_or_nan(const std::optional<identification::Fitted>& fitted) {
    return fitted ? fitted->value : kNaN;
}

/// Of a surface, in the units of Table II; NaN where the log does not determine it.
double vacuum_hPa(const Press& press) {
    return hectopascals(value_or_nan(true_vacuum_Pa(press.fit)));
}

double tau_1_s(const Press& press) {
    return value_or_nan(press.fit.sealing_time_s);
}

void measure_suction(const std::vector<Press>& presses, Evidence& evidence) {
    double worst_Pa = 0.0;
    for (const Press& press : presses) {
        evidence.set(press.flight + ".vacuum_hPa", vacuum_hPa(press));
        evidence.set(press.flight + ".tau_1_s", tau_1_s(press));
        evidence.set(press.flight + ".tau_2_s", value_or_nan(press.fit.unsealing_time_s));
        worst_Pa = std::max(worst_Pa, press.fit.residual_Pa);
    }
    evidence.set("press.worst_residual_hPa", hectopascals(worst_Pa));
    // Concrete comes first; the others are to be faster and deeper.
    const auto rate_hPa_s = [](const Press& press) {
        return (hectopascals(kAtmosphere_Pa) - vacuum_hPa(press)) / tau_1_s(press);
    };
    double next_rate = std::numeric_limits<double>::infinity(), next_vacuum_hPa = 0.0;
    for (std::size_t i = 1; i < presses.size(); ++i) {
        next_rate = std::min(next_rate, rate_hPa_s(presses[i]));
        next_vacuum_hPa = std::max(next_vacuum_hPa, vacuum_hPa(presses[i]));
    }
    evidence.set("press.slowest_margin_hPa_s", next_rate - rate_hPa_s(presses[0]));
    evidence.set("press.weakest_margin_hPa", vacuum_hPa(presses[0]) - next_vacuum_hPa);
    evidence.set("press.tau_1_cinder_less_concrete_s", tau_1_s(presses[1]) - tau_1_s(presses[0]));
}

draw::ChartPanel pressure_panel(const Press& press) {
    const double begin_s = value_or_nan(press.fit.sealing_begins_s);
    draw::ChartSeries sensor{
        .name = "sensor", .mark = draw::ChartSeries::Mark::points, .colour = "#9DB8CC"};
    draw::ChartSeries curve{
        .name = "fit of eq. (5)", .mark = draw::ChartSeries::Mark::dashes, .colour = "#D98E04"};
    constexpr double kBefore_s = 0.2, kShown_s = 2.5;
    for (std::size_t i = 0; i < press.trace.t_s.size(); ++i) {
        const double time_s = press.trace.t_s[i], since_s = time_s - begin_s;
        if (since_s > -kBefore_s && since_s < kShown_s) {
            sensor.add(since_s, hectopascals(press.trace.pressure_Pa[i]));
            curve.add(since_s, hectopascals(mean_pressure_Pa(press.fit.curve, time_s)));
        }
    }
    return {.title = press.name,
            .x_label = "since sealing began  [s]",
            .y_label = "pressure  [hPa]",
            .series = {sensor, curve},
            .y_range = draw::Range{200.0, 1060.0},
            .height_px = 260.0};
}

/// All surfaces over each other, as eq. (5) or (6) fits them.
draw::ChartPanel together(const std::vector<Press>& presses, bool sealing) {
    draw::ChartPanel panel{
        .title = sealing ? "all four, pump on: eq. (5)" : "all four, pump off: eq. (6)",
        .x_label = sealing ? "since sealing began  [s]" : "since the pump was off  [s]",
        .y_label = "pressure  [hPa]",
        .y_range = draw::Range{200.0, 1060.0},
        .height_px = 260.0};
    constexpr draw::ChartSeries::Mark kMarks[] = {draw::ChartSeries::Mark::line,
                                                  draw::ChartSeries::Mark::dashes};
    for (const Press& press : presses) {
        const auto& begins = sealing ? press.fit.sealing_begins_s : press.fit.unsealing_begins_s;
        if (!begins) {
            continue;
        }
        panel.series.push_back({.name = press.name, .mark = kMarks[panel.series.size() % 2]});
        panel.series.back().add({0.0, 2.5}, 250, [&](double since_s) {
            return hectopascals(mean_pressure_Pa(press.fit.curve, begins->value + since_s));
        });
    }
    return panel;
}

std::string with_interval(const std::optional<identification::Fitted>& fitted, double scale) {
    return fitted
               ? fmt::format("{:.4g} ± {:.2g}", scale * fitted->value, scale * fitted->half_width)
               : "not found";
}

/// Table II of a surface: the paper's, Limpet's, and what was recovered of the latter.
void add_rows(const Press& press, const Study& study, TableRows& rows) {
    const auto tau = [&](const char* name) {
        const auto [value, tolerance] = study.stated(press.flight + name);
        return fmt::format("{:g} ± {:g}", value, tolerance);
    };
    rows.push_back({press.name, "P_vac, hPa",
                    fmt::format("{:g}", study.stated(press.flight + ".vacuum_hPa").first),
                    hectopascals(press.surface.vacuum_pressure_Pa),
                    with_interval(true_vacuum_Pa(press.fit), hectopascals(1.0)),
                    with_interval(true_vacuum_Pa(press.pneumatic), hectopascals(1.0))});
    rows.push_back({press.name, "tau_1, s", tau(".tau_1_s"), press.surface.sealing_time_constant_s,
                    with_interval(press.fit.sealing_time_s, 1.0),
                    with_interval(press.pneumatic.sealing_time_s, 1.0)});
    rows.push_back({press.name, "tau_2, s", tau(".tau_2_s"),
                    press.surface.unsealing_time_constant_s,
                    with_interval(press.fit.unsealing_time_s, 1.0),
                    with_interval(press.pneumatic.unsealing_time_s, 1.0)});
}

/// Steady pressure of each cup that shares a pump, or of one alone.
std::vector<double> steady_hPa(const suction::PneumaticParameters& pump,
                               const std::vector<suction::CupAir>& cups) {
    constexpr double kLong_s = 20.0;
    std::vector<double> pressures_Pa(cups.size(), kAtmosphere_Pa);
    advance_network(pump_of(pump, true), cups, pressures_Pa, kLong_s);
    for (double& pressure : pressures_Pa) {
        pressure = hectopascals(pressure);
    }
    return pressures_Pa;
}

/// What the pneumatic model predicts where eqs. (5), (6) have nothing to say.
TableRows beyond_the_exponential() {
    const scenario::Scenario scenario = scenario::load_scenario("press_concrete");
    constexpr double kPress_N = 20.0;
    suction::PneumaticParameters parameters = scenario.cup.pressure;
    const auto sealed = [&] {
        return sealed_cup(parameters, scenario.wall.surface, scenario.cup.lip.radius_m, kPress_N,
                          false);
    };
    TableRows rows;
    for (const double area_mm2 : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        parameters.partial_seal_area_mm2 = area_mm2;
        rows.push_back({area_mm2 == 0.0 ? std::string("whole")
                                        : fmt::format("a gap of {} mm² at the lip", area_mm2),
                        steady_hPa(parameters, {sealed()})[0], "–"});
    }
    parameters.partial_seal_area_mm2 = 0.0;
    for (const double bore_mm : {1.5, 1.0, 0.5}) {
        parameters.hose_bore_mm = bore_mm;
        rows.push_back({fmt::format("whole, hose narrowed to {} mm", bore_mm),
                        steady_hPa(parameters, {sealed()})[0], "–"});
    }
    parameters = scenario.cup.pressure;
    const std::vector<double> both = steady_hPa(parameters, {sealed(), sealed()});
    rows.push_back({"two cups on one pump, both whole", both[0], both[1]});
    const std::vector<double> one = steady_hPa(
        parameters,
        {sealed(), cup_off_the_wall(parameters, scenario.cup.pressure.open_time_constant_s)});
    rows.push_back({"two cups on one pump, one off the wall", one[0], one[1]});
    return rows;
}

std::vector<std::string> names_of_presses() {
    std::vector<std::string> names = {"press.worst_residual_hPa", "press.slowest_margin_hPa_s",
                                      "press.weakest_margin_hPa",
                                      "press.tau_1_cinder_less_concrete_s"};
    for (const Column& column : kColumns) {
        for (const char* value : {"vacuum_hPa", "tau_1_s", "tau_2_s"}) {
            names.push_back(fmt::format("{}.{}", column.scenario, value));
        }
    }
    return names;
}

/// The press rig again, those logs in which the value is assumed.
void turn_presses(Study& study, const std::vector<Press>& presses) {
    std::vector<scenario::Scenario> scenarios;
    for (const Column& column : kColumns) {
        scenarios.push_back(scenario::load_scenario(column.scenario));
    }
    do_again(study, {.name = "presses",
                     .evidence = names_of_presses(),
                     .turns = turns_of(scenarios),
                     .measure = [&](const Turn& turn) {
                         const draw::gnuplot::TemporaryFolder scratch;
                         std::vector<Press> turned = presses;
                         for (std::size_t i = 0; i < turned.size(); ++i) {
                             if (const auto set = override_of(turn, scenarios[i])) {
                                 turned[i] = fly_press(kColumns[i], {*set}, scratch.path());
                             }
                         }
                         Evidence evidence;
                         measure_suction(turned, evidence);
                         return evidence;
                     }});
}

void study_suction(Study& study) {
    study.say("press rig");
    std::vector<Press> presses(kColumns.size());
    const std::filesystem::path flights = study.folder / "flights";
    for_each_index(presses.size(), study.jobs, [&](std::size_t i) {
        const std::string scenario = kColumns[i].scenario;
        presses[i] = fly_press(kColumns[i], {}, flights);
        presses[i].pneumatic = identify_pressure(
            flown({.name = scenario + "_pneumatic", .scenario = scenario, .overrides = kPneumatic},
                  flights));
    });
    measure_suction(presses, study.evidence);
    turn_presses(study, presses);

    draw::Chart chart{
        .subtitle = "sensor on the simulated press rig, and the fits of eqs. (5) and (6)",
        .columns = 2};
    TableRows rows;
    for (const Press& press : presses) {
        chart.panels.emplace_back(pressure_panel(press));
        add_rows(press, study, rows);
    }
    chart.panels.emplace_back(together(presses, true));
    chart.panels.emplace_back(together(presses, false));
    study.draw("fig2", chart);
    study.table("table2", rows);
    study.table("pneumatic-predictions", beyond_the_exponential());
}

}  // namespace

StudyPart suction_part() {
    return {"suction",
            "Suction cup: Table II and Fig. 2",
            study_suction,
            names_of_presses(),
            {"fig2", "table2", "pneumatic-predictions"}};
}

}  // namespace limpet::paper
