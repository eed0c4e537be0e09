// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/makers.hpp"
#include "limpet/suction/force_law.hpp"

namespace limpet::scenario {
namespace {

constexpr double kLeastFactor = 2.0;  ///< as makers ask on what is critical (suction/condition.hpp)

double vacuum_N(const Scenario& scenario) {
    const suction::Surface surface = surfaces_met(scenario).back();
    return suction::vacuum_force_N(surface.vacuum_pressure_Pa, scenario.cup.lip.radius_m,
                                   scenario.cup.ambient_Pa);
}

/// At rest the cup lies flat and the vehicle is pitched: the hinge's spring bends the lip.
Note peel(const Scenario& scenario) {
    constexpr double kAim = 3.0;
    const double pitch_rad = radians(scenario.guidance.perched_pitch_deg);
    const double spring_N_m_rad = scenario.airframe.cup.centring_stiffness_N_m_rad;
    const double peels_N_m = vacuum_N(scenario) * 0.5 * scenario.cup.lip.radius_m;
    const double bends_N_m = spring_N_m_rad * pitch_rad;
    const double factor = peels_N_m / std::max(bends_N_m, 1e-9);
    std::string text = fmt::format(
        "pitched to {:.0f} deg the springs of the hinges bend the lip by {:.2g} N m; it peels "
        "beyond {:.2g} N m",
        scenario.guidance.perched_pitch_deg, bends_N_m, peels_N_m);
    if (bends_N_m > 0.0) {
        text += fmt::format(", {:.1f} times that", factor);
    }
    if (factor >= kLeastFactor) {
        return {false, text};
    }
    return {true,
            fmt::format("{}, at least {:.0f} times are asked for: "
                        "vehicle.cup.centring_stiffness_N_m_rad is {:.3g}, some {:.1g} is right",
                        text, kLeastFactor, spring_N_m_rad, peels_N_m / (kAim * pitch_rad))};
}

/// The slider's spring gives back what it took, less its damper's share; at the outer stop the cup
/// holds what is left of the vehicle's speed.
std::optional<Note> rebound(const Scenario& scenario) {
    constexpr double kMostShare = 0.7;
    const vehicle::SliderParameters& slider = scenario.airframe.slider;
    const double mass_kg = carried_mass_kg(scenario.airframe);
    const double critical_N_s_m = 2.0 * std::sqrt(slider.stiffness_N_m * mass_kg);
    const double ratio = slider.damping_N_s_m / critical_N_s_m;
    if (scenario.mount != vehicle::Mount::free || ratio >= 1.0) {
        return std::nullopt;
    }
    const double back = std::exp(-kPi * ratio / std::sqrt(1.0 - ratio * ratio));
    const double pulls_N =
        back * scenario.guidance.dock_speed_m_s * std::sqrt(slider.stop_stiffness_N_m * mass_kg);
    const double holds_N = vacuum_N(scenario);
    if (pulls_N <= kMostShare * holds_N) {
        return std::nullopt;
    }
    return Note{true,
                fmt::format("the slider throws the vehicle back at {:.0f} % of its speed, {:.0f} N "
                            "at the outer stop, of the {:.0f} N that the cup holds at most: "
                            "vehicle.slider.damping_N_s_m is {:.3g}, {:.2g} throws nothing back",
                            100.0 * back, pulls_N, holds_N, slider.damping_N_s_m, critical_N_s_m)};
}

/// Guidance looks for a wall that both LiDARs see near enough.
std::optional<Note> start(const Scenario& scenario) {
    const bool docks = scenario.mission != Mission::hover;
    if (!docks || scenario.mount != vehicle::Mount::free) {
        return std::nullopt;
    }
    const vehicle::AirframeNumbers& airframe = scenario.airframe;
    const Quaternion q_WB = attitude(scenario.start);
    double sum_m = 0.0;
    for (const double side : {-0.5, 0.5}) {
        const Vector3 eye_B_m(airframe.lidar_x_m, side * airframe.lidar_separation_m,
                              airframe.lidar_z_m);
        const auto way_m =
            ray_to_wall_m(scenario.wall.geometry, scenario.start.p_WB_m + q_WB * eye_B_m,
                          q_WB * Vector3::UnitX());
        if (!way_m) {
            return Note{
                true, fmt::format("the {} LiDAR looks past the wall from the start: "
                                  "simulation.start_yaw_deg is {:.4g}, start_offset_m {:.4g}, "
                                  "start_distance_m {:.4g}, wall.width_m {:.4g}",
                                  side < 0.0 ? "left" : "right", scenario.simulation.start_yaw_deg,
                                  scenario.simulation.start_offset_m,
                                  scenario.simulation.start_distance_m, scenario.wall.width_m)};
        }
        sum_m += *way_m;
    }
    const double sees_m = 0.5 * sum_m;
    const double most_m =
        std::min(scenario.guidance.wall_near_limit_m, scenario.sensors.lidar_range_max_m);
    if (sees_m <= most_m) {
        return std::nullopt;
    }
    const bool range = scenario.sensors.lidar_range_max_m < scenario.guidance.wall_near_limit_m;
    return Note{
        true,
        fmt::format("the LiDARs see the wall at {:.3g} m from the start, guidance takes "
                    "none beyond {} {:.3g} for it: simulation.start_distance_m is {:.4g}",
                    sees_m, range ? "sensors.lidar_range_max_m" : "guidance.wall_near_limit_m",
                    most_m, scenario.simulation.start_distance_m)};
}

}  // namespace

std::vector<Note> notes_of(const Scenario& scenario) {
    std::vector<Note> notes;
    const std::vector<std::string> warnings = makers_warnings(scenario);
    for (const std::string& text : makers_notes(scenario)) {
        const bool warns = std::find(warnings.begin(), warnings.end(), text) != warnings.end();
        notes.push_back({warns, text});
    }
    if (scenario.wall.present && scenario.airframe.has_cup) {
        notes.push_back(peel(scenario));
        for (const auto& note : {rebound(scenario), start(scenario)}) {
            if (note) {
                notes.push_back(*note);
            }
        }
    }
    for (const std::string& text : vehicle_remarks(scenario.airframe, scenario.inherited)) {
        notes.push_back({true, text});
    }
    return notes;
}

std::vector<std::string> remarks(const Scenario& scenario) {
    std::vector<std::string> texts;
    for (const Note& note : notes_of(scenario)) {
        if (note.warns) {
            texts.push_back(note.text);
        }
    }
    return texts;
}

}  // namespace limpet::scenario
