// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/paper/oscillation.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

struct MissionCase {
    const char* key;
    const char* name;
    const char* scenario;
    Overrides overrides = {};
    SwingMissions missions = {};
};

const std::vector<MissionCase>& mission_cases() {
    static const std::vector<MissionCase> all = {
        {"gazebo_metal", "Gazebo's motors, still air, metal", kGazebo},
        {"gazebo_air_metal",
         "Gazebo's motors, air at the wall, metal",
         kGazebo,
         {"environment.wall_aerodynamics=1", "environment.recirculation_moment_rms_N_m=0.1"}},
        {"metal", "slow motors, air at the wall, metal", kSlow},
        {"valve", "the same with a valve", kSlow, {"suction.valve_fitted=1"}},
        {"concrete", "slow motors, air at the wall, concrete", "slow_motors_concrete"},
        {"gazebo_concrete", "Gazebo's motors, still air, concrete", "perch_concrete"},
    };
    return all;
}

/// Flies the missions of one.
void fly_case(MissionCase& one, const Study& study, int jobs) {
    // The swing shall be seen as it grows: the limit that ends a release does not count here.
    one.overrides.emplace_back("guidance.oscillation_limit_deg=60");
    one.missions = swing_missions(one.scenario, one.overrides, study.quick ? 24 : 200, jobs);
}

std::vector<MissionCase> fly_missions(const Study& study) {
    std::vector<MissionCase> all = mission_cases();
    for (MissionCase& one : all) {
        study.say(std::string("missions: ") + one.name);
        fly_case(one, study, study.jobs);
    }
    return all;
}

const SwingMissions& of(const std::vector<MissionCase>& cases, std::string_view key) {
    const MissionCase* found = find_by(cases, &MissionCase::key, key);
    require(found != nullptr, "missions of that name");
    return found->missions;
}

void measure_missions(const std::vector<MissionCase>& cases, Evidence& evidence) {
    for (const MissionCase& one : cases) {
        evidence.set(fmt::format("swing.{}_median_deg", one.key), one.missions.quantile(0.5));
        evidence.set(fmt::format("swing.{}_p95_deg", one.key), one.missions.quantile(0.95));
    }
    evidence.set("swing.concrete_more_deg", of(cases, "concrete").median_swing_deg() -
                                                of(cases, "gazebo_concrete").median_swing_deg());
    evidence.set("swing.metal_over_concrete",
                 of(cases, "metal").quantile(0.5) / of(cases, "concrete").quantile(0.5));
}

/// The missions in which a value is turned, the others as they were flown.
/// @return nothing where it is in none
Evidence measure_again(const Turn& turn, const Study& study,
                       const std::vector<MissionCase>& flown) {
    std::vector<MissionCase> turned = mission_cases();
    bool any = false;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        MissionCase& one = turned[i];
        const auto set =
            override_of(turn, scenario::load_scenario(one.scenario, {.overrides = one.overrides}));
        if (set) {
            one.overrides.push_back(*set);
            fly_case(one, study, 1);
            any = true;
        } else {
            one.missions = flown[i].missions;
        }
    }
    Evidence evidence;
    if (any) {
        measure_missions(turned, evidence);
    }
    return evidence;
}

/// The missions again: many flights each, so with the values alone that the statements name.
void turn_missions(Study& study, const std::vector<MissionCase>& flown) {
    const std::vector<std::string> measured = {
        "swing.concrete_more_deg", "swing.metal_over_concrete", "swing.metal_median_deg",
        "swing.gazebo_metal_p95_deg", "swing.gazebo_air_metal_median_deg"};
    do_again(study, {.name = "missions",
                     .evidence = measured,
                     .turns = turns_named(study, measured),
                     .measure = [&study, &flown](const Turn& turn) {
                         return measure_again(turn, study, flown);
                     }});
}

}  // namespace

void study_missions(Study& study) {
    const std::vector<MissionCase> cases = fly_missions(study);
    // Next to each other: distributions over each other hide those that coincide.
    draw::ChartPanel panel{.y_label = "largest pitch while waiting for the release  [deg]",
                           .levels = {{.at = 5.0, .label = "paper: 5 deg"}},
                           .log_y = true};
    draw::ChartSeries medians{.name = "median, and from 5 to 95 % of the missions",
                              .mark = draw::ChartSeries::Mark::points};
    TableRows rows;
    for (const MissionCase& one : cases) {
        const SwingMissions& missions = one.missions;
        const double median_deg = missions.quantile(0.5), most_deg = missions.quantile(0.95);
        medians.add(panel.category(one.name), median_deg, {missions.quantile(0.05), most_deg});
        rows.push_back({one.name, static_cast<double>(missions.runs),
                        static_cast<double>(missions.attached), missions.quantile(0.05), median_deg,
                        most_deg});
    }
    panel.series = {medians};
    study.draw("fig-swing", {.panels = {panel}, .column_px = 1000.0});
    study.table("swing-missions", rows);
    measure_missions(cases, study.evidence);
    turn_missions(study, cases);
}

}  // namespace limpet::paper
