// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/paper/oscillation.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

// --- the stability map ------------------------------------------------------------------------

std::vector<double> axis(double from, double to, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
        values.push_back(from + (to - from) * i / (count - 1));
    }
    return values;
}

/// As PX4 v1.15.1 works off its loop (docs/decisions/0039), and motors that act at once but for
/// their lag.
const Overrides kAsPx4 = {"autopilot.attitude_age_steps=2", "autopilot.dgyro_order=1",
                          "vehicle.rotor.command_delay_s=0"};

struct TitledMap {
    std::string title;
    stability::StabilityMap map = {};
};

std::vector<TitledMap> maps(const Study& study) {
    const std::vector<std::pair<const char*, Overrides>> cases = {
        {"PX4's default gains", {}},
        {"rate integrator off", {"autopilot.MC_PITCHRATE_I=0"}},
        {"rate P 0.20 instead of 0.15", {"autopilot.MC_PITCHRATE_P=0.2"}},
        {"all rate gains x 0.7", {"autopilot.MC_PITCHRATE_K=0.7"}},
    };
    std::vector<TitledMap> all;
    for (const auto& [title, gains] : cases) {
        study.say(fmt::format("stability map: {}", title));
        all.push_back({title,
                       {.scenario = kSlow,
                        .changes = joined(kAsPx4, gains),
                        .across = motor_lags(axis(0.010, 0.100, study.quick ? 10 : 28)),
                        .up = pivots(axis(0.40, 0.58, study.quick ? 7 : 19))}});
        fill(all.back().map, study.jobs);
    }
    return all;
}

/// A point of the map flown as a whole flight.
struct MapPoint {
    double lag_s = 0.0;
    double pivot_m = 0.0;
    double flown_1_s = 0.0;
    double linear_1_s = 0.0;
};

Overrides overrides_of(const MapPoint& at) {
    return stability::StabilityMap{
        .changes = kAsPx4, .across = motor_lags({at.lag_s}), .up = pivots({at.pivot_m})}
        .point(0);
}

/// By the built-in autopilot, kicked, without noise.
std::vector<MapPoint> fly_samples(const Study& study) {
    std::vector<MapPoint> all = {{0.030, 0.46}, {0.065, 0.46}, {0.050, 0.50}, {0.080, 0.44}};
    if (!study.quick) {
        all.insert(all.end(), {{0.020, 0.54}, {0.065, 0.42}, {0.045, 0.46}, {0.080, 0.50}});
    }
    for_each_index(all.size(), study.jobs, [&](std::size_t i) {
        all[i].flown_1_s = required(kicked_swing(kSlow, overrides_of(all[i])), kSwings).growth_1_s;
    });
    return all;
}

struct RecordedSamples {
    std::string by;
    std::vector<MapPoint> points;
};

/// By a real PX4, kicked: the mean of the flights at a place.
RecordedSamples recorded_samples() {
    const nlohmann::json recorded = read_recorded("px4_swing");
    RecordedSamples all;
    std::map<std::pair<double, double>, std::vector<double>> flown;
    try {
        const auto peer = recorded.at("peer").get<std::string>();
        all.by = peer.substr(0, peer.find(','));
        for (const nlohmann::json& one : recorded.at("swings")) {
            flown[{one.at("lag_s").get<double>(), one.at("pivot_m").get<double>()}].push_back(
                one.at("growth_1_s").get<double>());
        }
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("paper/recorded/px4_swing.json: {}", error.what()));
    }
    for (const auto& [at, growths_1_s] : flown) {
        const double sum = std::accumulate(growths_1_s.begin(), growths_1_s.end(), 0.0);
        all.points.push_back({at.first, at.second, sum / static_cast<double>(growths_1_s.size())});
    }
    return all;
}

draw::HeatPanel map_panel(const TitledMap& titled) {
    const stability::StabilityMap& map = titled.map;
    draw::HeatPanel panel{.title = titled.title,
                          .x_label = "time constant of the motors  [ms]",
                          .y_label = "pivot ahead of the centre of mass  [m]",
                          .z_label = "growth  [1/s]",
                          .y = map.up.values,
                          .z = map.growth_1_s,
                          .levels = {-0.4, -0.2, 0.2, 0.4},
                          .z_most = 0.6,
                          .height_px = 320.0};
    for (const double lag_s : map.across.values) {
        panel.x.push_back(1000.0 * lag_s);
    }
    return panel;
}

void study_map(Study& study) {
    draw::Chart chart{.subtitle =
                          "growth rate of the pitch mode, vehicle level on its cup; the loop "
                          "as PX4 v1.15.1 works it off",
                      .columns = 2};
    for (const TitledMap& map : maps(study)) {
        chart.panels.emplace_back(map_panel(map));
    }
    auto& defaults = std::get<draw::HeatPanel>(chart.panels.front());
    TableRows rows;
    double most_1_s = 0.0;
    const auto add = [&](const std::string& who, std::vector<MapPoint> points, bool drawn) {
        for (MapPoint& one : points) {
            one.linear_1_s =
                required(stability::linear_swing(kSlow, overrides_of(one)), kSwings).growth_1_s;
            const double lag_ms = 1000.0 * one.lag_s;
            rows.push_back({who, fmt::format("{:.0f}", lag_ms), one.pivot_m, one.linear_1_s,
                            one.flown_1_s, one.flown_1_s - one.linear_1_s});
            if (drawn) {
                defaults.points.push_back({.x = lag_ms,
                                           .y = one.pivot_m,
                                           .label = fmt::format("{:+.2f}", one.flown_1_s)});
                most_1_s = std::max(most_1_s, std::abs(one.flown_1_s - one.linear_1_s));
            }
        }
    };
    const RecordedSamples recorded = recorded_samples();
    add(recorded.by, recorded.points, true);
    add("built-in", fly_samples(study), false);
    study.draw("fig-map", chart);
    study.table("map-check", rows);
    study.evidence.set("swing.px4_apart_1_s", most_1_s);
}

// --- what cures it ----------------------------------------------------------------------------

/// One change of the vehicle with slow motors.
struct Change {
    std::string key;   ///< of its evidence
    std::string name;  ///< for people
    const char* scenario = kSlow;
    Overrides overrides = {};
    bool linear = true;   ///< the linearised loop knows of it
    bool traced = false;  ///< its pitch is drawn
    stability::Mode mode = {};
    KickedSwing kicked = {};
};

std::vector<Change> changes(const Study& study) {
    std::vector<Change> all = {
        {.key = "gazebo", .name = "Gazebo's motors", .scenario = kGazebo, .traced = true},
        {.key = "slow", .name = "slow motors", .traced = true},
        {.key = "rate_i_off",
         .name = "+ rate integrator off",
         .overrides = {"autopilot.MC_PITCHRATE_I=0"},
         .traced = true},
        {.key = "rate_p", .name = "+ rate P 0.20", .overrides = {"autopilot.MC_PITCHRATE_P=0.2"}},
        {.key = "altitude_hold",
         .name = "+ altitude hold",
         .overrides = {"guidance.altitude_hold=1"},
         .linear = false,
         .traced = true},
        {.key = "short_pivot",
         .name = "+ pivot at 0.40 m",
         .overrides = {"vehicle.cup.joint_x_m=0.40"}},
        {.key = "attitude_p", .name = "+ attitude P 8", .overrides = {"autopilot.MC_PITCH_P=8"}},
        {.key = "rate_i_more",
         .name = "+ rate I 0.30",
         .overrides = {"autopilot.MC_PITCHRATE_I=0.3"}},
    };
    for_each_index(all.size(), study.jobs, [&](std::size_t i) {
        Change& change = all[i];
        change.kicked = required(kicked_swing(change.scenario, change.overrides), kSwings);
        if (change.linear) {
            change.mode =
                required(stability::linear_swing(change.scenario, change.overrides), kSwings);
        }
    });
    return all;
}

/// The kicked flight that a statement is judged by.
void turn_growth(Study& study) {
    const std::string changed = "autopilot.MC_PITCHRATE_P=0.2";
    const scenario::Scenario slow = scenario::load_scenario(kSlow, {.overrides = {changed}});
    do_again(study, {.name = "kicked",
                     .evidence = {"swing.rate_p_growth_1_s"},
                     .turns = turns_of({slow}),
                     .measure = [&](const Turn& turn) {
                         Evidence evidence;
                         if (const auto set = override_of(turn, slow)) {
                             if (const auto swing = kicked_swing(kSlow, {changed, *set})) {
                                 evidence.set("swing.rate_p_growth_1_s", swing->growth_1_s);
                             }
                         }
                         return evidence;
                     }});
}

void study_changes(Study& study) {
    study.say("kicked flights");
    draw::ChartPanel traces{.title = "pitch after a kick",
                            .x_label = "since the kick  [s]",
                            .y_label = "pitch, less that without the kick  [deg]",
                            .y_range = draw::Range{-4.0, 4.0}};
    draw::ChartPanel bars{
        .title = "growth", .y_label = "growth  [1/s]", .y_range = draw::Range{-0.8, 0.6}};
    draw::ChartSeries linear{.name = "linearised", .mark = draw::ChartSeries::Mark::bars};
    draw::ChartSeries flown{.name = "kicked flight", .mark = draw::ChartSeries::Mark::bars};
    TableRows rows;
    for (const Change& change : changes(study)) {
        const auto& [growth_1_s, frequency_Hz, time_s, pitch_deg] = change.kicked;
        if (change.traced) {
            traces.series.push_back({.name = change.name, .x = time_s, .y = pitch_deg});
        }
        if (std::isfinite(growth_1_s)) {
            const double x = bars.category(change.name);
            if (change.linear) {
                linear.add(x, change.mode.growth_1_s);
            }
            flown.add(x, growth_1_s);
        }
        const auto linearised = [&](double value) {
            return change.linear ? number_or(value, "no swing left")
                                 : report::Quantity("not linearised");
        };
        rows.push_back(
            {change.name, linearised(change.mode.growth_1_s), linearised(change.mode.frequency_Hz),
             number_or(growth_1_s, "no swing left"), number_or(frequency_Hz, "no swing left")});
        study.evidence.set("swing." + change.key + "_growth_1_s", growth_1_s);
        study.evidence.set("swing." + change.key + "_frequency_Hz", change.mode.frequency_Hz);
    }
    bars.series = {linear, flown};
    turn_growth(study);
    study.draw("fig-cures", {.panels = {traces, bars}});
    study.table("cures", rows);
    study.evidence.set(
        "swing.long_pivot_frequency_Hz",
        required(stability::linear_swing(kSlow, {"vehicle.cup.joint_x_m=0.55"}), kSwings)
            .frequency_Hz);
}

/// A take-off of the slow vehicle, for Figs. 12 and 14.
void fly_slow(Study& study, const char* id, const char* name, const char* scenario) {
    const std::filesystem::path flights = study.folder / "flights";
    const PaperFlight flight = fly_recorded({.name = name, .scenario = scenario}, flights);
    (void)report::plot(flight.recording, flights / name);
    study.show(name);
    study.picture(id, name, "take_off");
}

void measure_candidate(Evidence& evidence) {
    const vehicle::Airframe airframe = scenario::load_scenario(kSlow).airframe;
    const double arm_m = airframe.cup.joint_x_m, free_kg_m2 = airframe.inertia_kg_m2.y();
    evidence.set("swing.pivot_m", arm_m);
    evidence.set("swing.inertia_ratio",
                 (free_kg_m2 + airframe.mass_kg * arm_m * arm_m) / free_kg_m2);
    evidence.set("swing.motor_lag_ms", 1000.0 * airframe.rotor.time_constant_up_s);
    evidence.set("swing.dead_time_ms", 1000.0 * airframe.rotor.command_delay_s);
    evidence.set("swing.slow_hover_tilt_deg", hover_tilt_deg(kSlow));
    evidence.set("swing.gazebo_hover_tilt_deg", hover_tilt_deg(kGazebo));
}

void study_oscillation(Study& study) {
    study_map(study);
    study_changes(study);
    study_missions(study);
    measure_candidate(study.evidence);
    fly_slow(study, "fig12-slow", "slow_concrete", "slow_motors_concrete");
    fly_slow(study, "fig14-slow", "slow_metal", "slow_motors_metal");
}

}  // namespace

StudyPart oscillation_part() {
    return {"oscillation",
            "The open question: why real flights swing",
            study_oscillation,
            {"swing.concrete_more_deg", "swing.metal_over_concrete", "swing.metal_median_deg",
             "swing.gazebo_metal_p95_deg", "swing.gazebo_air_metal_median_deg",
             "swing.rate_p_growth_1_s", "swing.px4_apart_1_s", "swing.valve_median_deg",
             "swing.pivot_m", "swing.inertia_ratio", "swing.motor_lag_ms", "swing.dead_time_ms",
             "swing.slow_hover_tilt_deg", "swing.gazebo_hover_tilt_deg",
             "swing.gazebo_frequency_Hz", "swing.slow_frequency_Hz",
             "swing.short_pivot_frequency_Hz", "swing.long_pivot_frequency_Hz"},
            {"fig-swing", "swing-missions", "fig12-slow", "fig14-slow", "fig-map", "map-check",
             "fig-cures", "cures"}};
}

}  // namespace limpet::paper
