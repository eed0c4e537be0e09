// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/frames.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/paper/rigs.hpp"

namespace limpet::paper {
namespace {

void study_releases(Study& study) {
    study.say("release times");
    const std::vector<ReleaseTime> times = release_times(study.jobs);
    draw::ChartPanel panel{.x_label = "surface",
                           .y_label = "from pump off to detached  [s]",
                           .y_range = draw::Range{0.05, 200.0},
                           .log_y = true};
    draw::ChartSeries without{.name = "without a valve", .mark = draw::ChartSeries::Mark::points};
    draw::ChartSeries with{.name = "with the valve", .mark = draw::ChartSeries::Mark::points};
    TableRows rows;
    for (const ReleaseTime& time : times) {
        const double x = panel.category(time.surface);
        without.add(x, time.without_valve_s);
        with.add(x, time.with_valve_s);
        rows.push_back({time.surface, time.without_valve_s, time.with_valve_s});
    }
    panel.series = {without, with};
    study.draw("fig-valve", {.panels = {panel}});
    study.table("release-table", rows);
    study.evidence.set("release.valve_gain_metal",
                       times.back().without_valve_s / times.back().with_valve_s);
}

int spread_flights(const Study& study) {
    return study.quick ? 3 : 15;
}

void study_spread(Study& study) {
    study.say("spread of release times");
    study.evidence.set("release.valve_spread_ratio",
                       valve_spread_ratio(spread_flights(study), study.jobs));
}

void study_energy(Study& study) {
    study.say("energy");
    draw::ChartPanel panel{.y_label = "energy for an hour  [Wh]",
                           .y_range = draw::Range{0.0, 500.0}};
    draw::ChartSeries bars{.mark = draw::ChartSeries::Mark::bars};
    TableRows rows;
    for (const EnergyUse& use : energy_use(study.evidence)) {
        bars.add(panel.category(use.what), use.power_W);
        rows.push_back(
            {use.what, use.power_W, use.power_W + use.getting_there_Wh, use.endurance_h});
    }
    panel.series = {bars};
    study.draw("fig-energy", {.panels = {panel}});
    study.table("energy-table", rows);
}

/// The flights of two statements with every assumed value turned; the spread takes more flights: of
/// it those values that its statement names.
void turn_rigs(Study& study) {
    do_again(study, {.name = "rigs",
                     .evidence = {"release.valve_gain_metal", "energy.perched_share"},
                     .turns = turns_of(rig_scenarios()),
                     .measure = [](const Turn& turn) {
                         const ReleaseTime time = turned_release_time(turn);
                         Evidence evidence;
                         evidence.set("release.valve_gain_metal",
                                      time.without_valve_s / time.with_valve_s);
                         evidence.set("energy.perched_share", turned_perched_share(turn));
                         return evidence;
                     }});
    do_again(study, {.name = "spread",
                     .evidence = {"release.valve_spread_ratio"},
                     .turns = turns_named(study, {"release.valve_spread_ratio"}),
                     .measure = [&study](const Turn& turn) {
                         Evidence evidence;
                         evidence.set("release.valve_spread_ratio",
                                      valve_spread_ratio(spread_flights(study), 1, turn));
                         return evidence;
                     }});
}

void study_beyond(Study& study) {
    study_releases(study);
    study_spread(study);
    study_energy(study);
    turn_rigs(study);
    TableRows rows;
    for (const BreakOff& load : break_off_loads()) {
        rows.push_back({load.surface, hectopascals(load.pressure_Pa), load.pull_N, load.shear_N,
                        load.peel_N_m, load.pull_in_weights});
    }
    study.table("break-off-table", rows);
}

}  // namespace

StudyPart beyond_part() {
    return {"beyond",
            "Beyond the paper",
            study_beyond,
            {"release.valve_gain_metal", "release.valve_spread_ratio", "energy.perched_share"},
            {"fig-valve", "release-table", "fig-energy", "energy-table", "break-off-table"}};
}

}  // namespace limpet::paper
