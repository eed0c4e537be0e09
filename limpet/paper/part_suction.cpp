// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/identification/identification.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/paper/paper_tables.hpp"
#include "limpet/paper/parallel.hpp"
#include "limpet/paper/study.hpp"
#include "limpet/record/story.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/suction/pneumatics.hpp"

namespace limpet::paper {
namespace {

/// One surface of Fig. 2 on the press rig, and what the log tells.
struct Press {
    std::string name;  ///< of the surface, for people
    std::string flight;
    suction::Surface surface = {};
    identification::PressureTrace trace = {};
    identification::PressureFit fit = {};
    identification::PressureFit pneumatic =
        {};  ///< of the same experiment with the pneumatic model
};

/// What the vehicle's sensor said, with its noise.
identification::PressureTrace trace_of(const record::Recording& recording) {
    const record::Table* table = find_table(recording, "/sensors/cup_pressure");
    const record::Column* pressure = table == nullptr ? nullptr : table->find("fluid_pressure");
    require(pressure != nullptr, "a cup pressure in the recording");
    return {.t_s = table->time_s, .pressure_Pa = pressure->values};
}

/// The pneumatic model's leak depends on the clamping; Table II was fitted at 20 N (0008).
const std::vector<std::string> kPneumatic = {"suction.pressure_model=pneumatic",
                                             "press_rig.press_N=20",
                                             "wall.surface.seal_threshold_median_N=10"};

Press fly_press(const TableTwo& column, const Study& study) {
    const std::string scenario = column.scenario;
    Press result{.name = column.name, .flight = scenario};
    const PaperFlight flight =
        fly_recorded({.name = scenario, .scenario = scenario}, study.folder / "flights");
    result.surface = scenario::load_scenario(scenario).wall.surface;
    result.trace = trace_of(flight.recording);
    result.fit = identify_pressure(result.trace);
    const std::string other = scenario + "_pneumatic";
    const PaperFlight pneumatic = fly_recorded(
        {.name = other, .scenario = scenario, .overrides = kPneumatic}, study.folder / "flights");
    result.pneumatic = identify_pressure(trace_of(pneumatic.recording));
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
    return fitted ? fitted->value : std::numeric_limits<double>::quiet_NaN();
}

void collect(const std::vector<Press>& presses, Evidence& evidence) {
    double worst_Pa = 0.0;
    for (const Press& press : presses) {
        evidence.set(press.flight + ".vacuum_hPa",
                     hectopascals(value_or_nan(true_vacuum_Pa(press.fit))));
        evidence.set(press.flight + ".tau_1_s", value_or_nan(press.fit.sealing_time_s));
        evidence.set(press.flight + ".tau_2_s", value_or_nan(press.fit.unsealing_time_s));
        worst_Pa = std::max(worst_Pa, press.fit.residual_Pa);
    }
    evidence.set("press.worst_residual_hPa", hectopascals(worst_Pa));
    // Concrete comes first; the others are to be faster and deeper.
    const auto rate_hPa_s = [](const Press& press) {
        return hectopascals(kAtmosphere_Pa - value_or_nan(true_vacuum_Pa(press.fit))) /
               value_or_nan(press.fit.sealing_time_s);
    };
    double next_rate = std::numeric_limits<double>::infinity(), next_vacuum_hPa = 0.0;
    for (std::size_t i = 1; i < presses.size(); ++i) {
        next_rate = std::min(next_rate, rate_hPa_s(presses[i]));
        next_vacuum_hPa =
            std::max(next_vacuum_hPa, hectopascals(value_or_nan(true_vacuum_Pa(presses[i].fit))));
    }
    evidence.set("press.slowest_margin_hPa_s", next_rate - rate_hPa_s(presses[0]));
    evidence.set("press.weakest_margin_hPa",
                 hectopascals(value_or_nan(true_vacuum_Pa(presses[0].fit))) - next_vacuum_hPa);
    evidence.set(
        "press.tau_1_cinder_less_concrete_s",
        value_or_nan(presses[1].fit.sealing_time_s) - value_or_nan(presses[0].fit.sealing_time_s));
}

report::PageFigure pressure_figure(const std::vector<Press>& presses, const Study& study) {
    draw::Chart chart{.title = "Fig. 2: pressure in the pressed cup",
                      .subtitle = "sensor on the simulated press rig, and the fit of eq. (5)",
                      .columns = 2};
    for (const Press& press : presses) {
        const double begin_s = value_or_nan(press.fit.sealing_begins_s);
        draw::ChartSeries sensor{
            .name = "sensor", .mark = draw::ChartSeries::Mark::points, .colour = "#9DB8CC"};
        draw::ChartSeries curve{
            .name = "fit of eq. (5)", .mark = draw::ChartSeries::Mark::dashes, .colour = "#D98E04"};
        constexpr double kBefore_s = 0.2, kShown_s = 2.5;
        for (std::size_t i = 0; i < press.trace.t_s.size(); ++i) {
            const double since_s = press.trace.t_s[i] - begin_s;
            if (since_s > -kBefore_s && since_s < kShown_s) {
                sensor.x.push_back(since_s);
                sensor.y.push_back(hectopascals(press.trace.pressure_Pa[i]));
                curve.x.push_back(since_s);
                curve.y.push_back(
                    hectopascals(mean_pressure_Pa(press.fit.curve, press.trace.t_s[i])));
            }
        }
        draw::ChartPanel panel{.title = press.name,
                               .x_label = "since sealing began  [s]",
                               .y_label = "pressure  [hPa]",
                               .series = {sensor, curve},
                               .y_range = draw::Range{200.0, 1060.0},
                               .height_px = 260.0};
        chart.panels.emplace_back(std::move(panel));
    }
    report::PageFigure figure = study.figure(
        chart, "fig2",
        "The vehicle clamped and pressed on four surfaces, pump on, as the paper's bench test. "
        "Dots "
        "are what its pressure sensor said, noise and ripple included.",
        "Pressure against time on porous concrete, cinder block, turbine blade and metal");
    figure.wide = true;
    return figure;
}

std::string with_interval(const std::optional<identification::Fitted>& fitted, double scale) {
    return fitted
               ? fmt::format("{:.4g} ± {:.2g}", scale * fitted->value, scale * fitted->half_width)
               : "not found";
}

report::PageTable table_two(const std::vector<Press>& presses) {
    report::PageTable table{
        .id = "table2",
        .title = "Table II: used, and recovered from the simulated logs",
        .columns = {"surface", "quantity", "paper", "used", "recovered (95 %)", "pneumatic model"},
        .caption =
            "Recovered as by `limpet identify` from the noisy sensor, its offset taken out by "
            "the log's head. The last column is the "
            "same experiment, pressed with 20 N on a spot that then seals, with one pump, volumes "
            "and leaks instead of "
            "eqs. (5), (6)."};
    const auto pm = [](double value, double tolerance) {
        return fmt::format("{:g} ± {:g}", value, tolerance);
    };
    for (std::size_t i = 0; i < presses.size(); ++i) {
        const Press& press = presses[i];
        const TableTwo& paper = kTableTwo[i];
        const suction::Surface& used = press.surface;
        table.rows.push_back({press.name, std::string("P_vac, hPa"),
                              fmt::format("{:g}", paper.vacuum_hPa),
                              hectopascals(used.vacuum_pressure_Pa),
                              with_interval(true_vacuum_Pa(press.fit), hectopascals(1.0)),
                              with_interval(true_vacuum_Pa(press.pneumatic), hectopascals(1.0))});
        table.rows.push_back(
            {press.name, std::string("tau_1, s"), pm(paper.tau_1_s, paper.tau_1_tolerance_s),
             used.sealing_time_constant_s, with_interval(press.fit.sealing_time_s, 1.0),
             with_interval(press.pneumatic.sealing_time_s, 1.0)});
        table.rows.push_back(
            {press.name, std::string("tau_2, s"), pm(paper.tau_2_s, paper.tau_2_tolerance_s),
             used.unsealing_time_constant_s, with_interval(press.fit.unsealing_time_s, 1.0),
             with_interval(press.pneumatic.unsealing_time_s, 1.0)});
    }
    return table;
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
report::PageTable beyond_the_exponential() {
    const scenario::Scenario scenario = scenario::load_scenario("press_concrete");
    const double radius_m = scenario.cup.lip.radius_m;
    constexpr double kPress_N = 20.0;
    suction::PneumaticParameters parameters = scenario.cup.pressure;
    report::PageTable table{
        .id = "pneumatic-predictions",
        .title = "What eqs. (5) and (6) cannot tell: porous concrete",
        .columns = {"seal", "steady pressure, hPa", "of the second cup, hPa"},
        .caption = "By the pneumatic model, a cup pressed with 20 N; P_land is 880 hPa."};
    const auto sealed = [&] {
        return sealed_cup(parameters, scenario.wall.surface, radius_m, kPress_N, false);
    };
    const std::string none = "–";
    for (const double area_mm2 : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        parameters.partial_seal_area_mm2 = area_mm2;
        table.rows.push_back({area_mm2 == 0.0 ? std::string("whole")
                                              : fmt::format("a gap of {} mm² at the lip", area_mm2),
                              steady_hPa(parameters, {sealed()})[0], none});
    }
    parameters.partial_seal_area_mm2 = 0.0;
    for (const double bore_mm : {1.5, 1.0, 0.5}) {
        parameters.hose_bore_mm = bore_mm;
        table.rows.push_back({fmt::format("whole, hose narrowed to {} mm", bore_mm),
                              steady_hPa(parameters, {sealed()})[0], none});
    }
    parameters = scenario.cup.pressure;
    const std::vector<double> both = steady_hPa(parameters, {sealed(), sealed()});
    table.rows.push_back({std::string("two cups on one pump, both whole"), both[0], both[1]});
    const std::vector<double> one = steady_hPa(
        parameters,
        {sealed(), cup_off_the_wall(parameters, scenario.cup.pressure.open_time_constant_s)});
    table.rows.push_back({std::string("two cups on one pump, one off the wall"), one[0], one[1]});
    return table;
}

void study_suction(Study& study) {
    study.say("press rig");
    std::vector<Press> presses(kTableTwo.size());
    for_each_index(presses.size(), study.jobs,
                   [&](std::size_t i) { presses[i] = fly_press(kTableTwo[i], study); });
    collect(presses, study.evidence);

    report::PageSection section{.id = "part-suction"};
    section.blocks.emplace_back(
        "The cup is pressed on each surface by a rig, the pump runs until the pressure is steady, "
        "then stops.");
    section.blocks.emplace_back(fmt::format(
        "**The paper contradicts itself here**: it calls concrete the slowest, while by its own "
        "Table II the cinder block has the larger tau_1. In hPa per second concrete is slower than "
        "the next by {:.0f}, because its vacuum is the weakest.",
        study.evidence.get("press.slowest_margin_hPa_s")));
    section.blocks.emplace_back(pressure_figure(presses, study));
    section.blocks.emplace_back(table_two(presses));
    section.blocks.emplace_back(beyond_the_exponential());
    study.sections.push_back(std::move(section));
}

}  // namespace

StudyPart suction_part() {
    StudyPart part{"suction",
                   "Suction cup: Table II and Fig. 2",
                   study_suction,
                   {"press.worst_residual_hPa", "press.slowest_margin_hPa_s",
                    "press.weakest_margin_hPa", "press.tau_1_cinder_less_concrete_s"}};
    for (const TableTwo& column : kTableTwo) {
        for (const char* value : {"vacuum_hPa", "tau_1_s", "tau_2_s"}) {
            part.measures.push_back(fmt::format("{}.{}", column.scenario, value));
        }
    }
    return part;
}

}  // namespace limpet::paper
