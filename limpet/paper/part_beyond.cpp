// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "limpet/core/frames.hpp"
#include "limpet/paper/rigs.hpp"
#include "limpet/paper/study.hpp"

namespace limpet::paper {
namespace {

report::PageFigure release_figure(const std::vector<ReleaseTime>& times, const Study& study) {
    draw::ChartPanel panel{.x_label = "surface", .y_label = "from pump off to detached  [s]"};
    draw::ChartSeries without{.name = "without a valve", .mark = draw::ChartSeries::Mark::points};
    draw::ChartSeries with{.name = "with the valve", .mark = draw::ChartSeries::Mark::points};
    for (const ReleaseTime& time : times) {
        const auto x = static_cast<double>(panel.categories.size());
        panel.categories.push_back(time.surface);
        without.x.push_back(x);
        without.y.push_back(time.without_valve_s);
        with.x.push_back(x);
        with.y.push_back(time.with_valve_s);
    }
    panel.series = {without, with};
    panel.log_y = true;
    panel.y_range = draw::Range{0.05, 200.0};
    return study.figure(
        {.title = "A solenoid valve against none", .panels = {panel}}, "fig-valve",
        "Whole flights, a vehicle that waits as long as it takes. The paper proposes the valve in "
        "section V.B; its orifice of 2 mm is assumed.",
        "Release time on four surfaces with and without a valve, logarithmic");
}

report::PageTable release_table(const std::vector<ReleaseTime>& times) {
    report::PageTable table{.id = "release-table",
                            .title = "Release time",
                            .columns = {"surface", "without a valve, s", "with the valve, s"}};
    for (const ReleaseTime& time : times) {
        table.rows.push_back({time.surface, time.without_valve_s, time.with_valve_s});
    }
    return table;
}

report::PageFigure energy_figure(const std::vector<EnergyUse>& uses, const Study& study) {
    draw::ChartPanel panel{.y_label = "energy for an hour  [Wh]"};
    draw::ChartSeries bars{.mark = draw::ChartSeries::Mark::bars};
    for (const EnergyUse& use : uses) {
        bars.x.push_back(static_cast<double>(panel.categories.size()));
        bars.y.push_back(use.power_W);
        panel.categories.push_back(use.what);
    }
    panel.series = {bars};
    panel.y_range = draw::Range{0.0, 500.0};
    return study.figure(
        {.title = "An hour on the wall against an hour in the air", .panels = {panel}},
        "fig-energy",
        "From the battery, avionics included; motors off when perched. Drive efficiency, avionics "
        "and pump power are assumed (docs/parameters.md).",
        "Energy of an hour hovering and perched on four surfaces");
}

report::PageTable energy_table(const std::vector<EnergyUse>& uses) {
    report::PageTable table{
        .id = "energy-table",
        .title = "Power and endurance",
        .columns = {"what", "power, W", "an hour with getting there, Wh", "endurance, h"},
        .caption =
            "Getting there: approach and landing, of the same flight. Endurance "
            "by the power alone, on the full 6S 4000 mAh battery at its nominal "
            "voltage; an hour of hovering takes more than one battery."};
    for (const EnergyUse& use : uses) {
        table.rows.push_back(
            {use.what, use.power_W, use.power_W + use.getting_there_Wh, use.endurance_h});
    }
    return table;
}

report::PageTable break_off_table(const std::vector<BreakOff>& loads) {
    report::PageTable table{
        .id = "break-off-table",
        .title = "What breaks the cup off",
        .columns = {"surface", "pressure, hPa", "pull, N", "shear, N", "peel, N m",
                    "pull in weights"},
        .caption =
            "A sealed cup of 80 mm (assumed) moved away from the wall, along "
            "it, or tilted, each alone, until it lets go: at its best vacuum and "
            "at P_land. Closed forms: pull (P_atm - P) A, shear mu times that, "
            "peel that times R/2."};
    for (const BreakOff& load : loads) {
        table.rows.push_back({load.surface, limpet::hectopascals(load.pressure_Pa), load.pull_N,
                              load.shear_N, load.peel_N_m, load.pull_in_weights});
    }
    return table;
}

void study_beyond(Study& study) {
    report::PageSection section{.id = "part-beyond"};
    study.say("release times");
    const std::vector<ReleaseTime> times = release_times(study.jobs);
    section.blocks.emplace_back(
        "What the paper proposes or implies, and did not measure: a valve, the energy of resting "
        "on a wall, and what load breaks the cup off.");
    section.blocks.emplace_back(release_figure(times, study));
    section.blocks.emplace_back(release_table(times));
    study.evidence.set("release.valve_gain_metal",
                       times.back().without_valve_s / times.back().with_valve_s);
    study.say("energy");
    const std::vector<EnergyUse> uses = energy_use(study.evidence);
    section.blocks.emplace_back(energy_figure(uses, study));
    section.blocks.emplace_back(energy_table(uses));
    section.blocks.emplace_back(break_off_table(break_off_loads()));
    study.sections.push_back(std::move(section));
}

}  // namespace

StudyPart beyond_part() {
    return {"beyond",
            "Beyond the paper",
            study_beyond,
            {"release.valve_gain_metal", "energy.perched_share"}};
}

}  // namespace limpet::paper
