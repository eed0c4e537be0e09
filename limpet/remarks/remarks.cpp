// SPDX-License-Identifier: Apache-2.0
#include "limpet/remarks/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "limpet/autopilot/allocation.hpp"
#include "limpet/remarks/digits.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/suction/force_law.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::remarks {
namespace {

struct MakersNote {
    bool warns = false;
    std::string text;
};

/// On the surface on which it is to rest.
MakersNote lateral(const scenario::Scenario& scenario) {
    const suction::Surface surface = surfaces_met(scenario).back();
    const double ambient_Pa = scenario.cup.ambient_Pa;
    const double has = lateral_safety(surface, scenario.cup.lip.radius_m,
                                      carried_mass_kg(scenario.airframe), ambient_Pa);
    const double required = safety_factor_asked(surface, *scenario.wall.condition);
    return {has < required,
            fmt::format("the cup carries {:.1f} times the weight along the wall (friction {:.3g}, "
                        "vacuum {:.0f} hPa); cup manufacturers require {:.2g}",
                        has, surface.friction,
                        hectopascals(ambient_Pa - surface.vacuum_pressure_Pa), required)};
}

std::vector<MakersNote> notes(const scenario::Scenario& scenario) {
    if (!scenario.wall.present || !scenario.airframe.has_cup) {
        return {};
    }
    std::vector<MakersNote> all = {lateral(scenario)};
    const suction::LipParameters& lip = scenario.cup.lip;
    if (!follows(lip, scenario.wall.geometry)) {
        all.push_back(
            {true, fmt::format("the wall's radius of {:.3g} m is less than the {:.3g} m that "
                               "a cup of {:.0f} mm seals on (suction.least_radius_m): no "
                               "touch will seal",
                               scenario.wall.radius_m, least_radius_m(lip), 2e3 * lip.radius_m)});
    }
    return all;
}

std::vector<std::string> texts(const scenario::Scenario& scenario, bool warnings_alone) {
    std::vector<std::string> lines;
    for (const MakersNote& note : notes(scenario)) {
        if (note.warns || !warnings_alone) {
            lines.push_back(note.text);
        }
    }
    return lines;
}

using scenario::Scenario;

constexpr double kLeastFactor =
    2.0;  ///< as makers require on what is critical (suction/condition.hpp)

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
        "pitched to {:.0f} deg the springs of the hinges bend the lip by {} N m; it peels "
        "beyond {} N m",
        scenario.guidance.perched_pitch_deg, about(bends_N_m), about(peels_N_m));
    if (bends_N_m > 0.0) {
        text += factor < 1.0 ? fmt::format(", {} times that", about(factor))
                             : fmt::format(", {:.1f} times that", factor);
    }
    if (factor >= kLeastFactor) {
        return {false, text};
    }
    return {true, fmt::format("{}, at least {:.0f} times are required: "
                              "vehicle.cup.centring_stiffness_N_m_rad is {:.3g}, some {} is right",
                              text, kLeastFactor, spring_N_m_rad,
                              about(peels_N_m / (kAim * pitch_rad), 1))};
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
    return Note{
        true,
        fmt::format("the slider throws the vehicle back at {:.0f} % of its speed, {:.0f} N "
                    "at the outer stop, of the {:.0f} N that the cup holds at most: "
                    "vehicle.slider.damping_N_s_m is {:.3g}, {} throws nothing back",
                    100.0 * back, pulls_N, holds_N, slider.damping_N_s_m, about(critical_N_s_m))};
}

/// How fast the rate loop turns the vehicle, against its motors and against the loop around it.
struct RateLoop {
    const char* axis;
    const char* gain;           ///< "MC_ROLLRATE"
    double scale = 0.0;         ///< MC_ROLLRATE_K or MC_PITCHRATE_K
    double proportional = 0.0;  ///< MC_ROLLRATE_P or MC_PITCHRATE_P
    double crossover_rad_s = 0.0;
    double attitude_1_s = 0.0;  ///< MC_ROLL_P or MC_PITCH_P
};

/// Roll and pitch around hover: a command's moment over the inertia, times the gains.
std::array<RateLoop, 2> rate_loops(const Scenario& scenario) {
    const vehicle::Airframe& airframe = scenario.airframe;
    const autopilot::AutopilotParameters& p = scenario.autopilot;
    const autopilot::Mixer mixer = autopilot::make_mixer(scenario::rotor_geometry(airframe));
    const double thrust_N = 2.0 * airframe.rotor.thrust_per_speed_2_kg_m() *
                            hover_speed_rad_s(airframe) * airframe.rotor.speed_scale_rad_s;
    double roll_N_m = 0.0, pitch_N_m = 0.0;
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        const vehicle::Rotor& rotor = airframe.rotors[i];
        const auto at = static_cast<Eigen::Index>(i);
        roll_N_m -= mixer.roll[at] * rotor.p_B_m.y() * rotor.thrust_share * thrust_N;
        pitch_N_m += mixer.pitch[at] * rotor.p_B_m.x() * rotor.thrust_share * thrust_N;
    }
    const Vector3& inertia = airframe.inertia_kg_m2;
    return {RateLoop{"roll", "MC_ROLLRATE", p.MC_ROLLRATE_K, p.MC_ROLLRATE_P,
                     p.MC_ROLLRATE_K * p.MC_ROLLRATE_P * roll_N_m / inertia.x(), p.MC_ROLL_P},
            RateLoop{"pitch", "MC_PITCHRATE", p.MC_PITCHRATE_K, p.MC_PITCHRATE_P,
                     p.MC_PITCHRATE_K * p.MC_PITCHRATE_P * pitch_N_m / inertia.y(), p.MC_PITCH_P}};
}

/// PX4's gains, which nobody has set, on a vehicle that they do not suit.
std::vector<Note> gains(const Scenario& scenario) {
    constexpr double kQuickest = 1.8, kSlowest = 1.2;  ///< times the lag; times the attitude's
    constexpr double kUsual_rad_s = 30.0;              ///< of the paper's vehicle and the Iris
    std::vector<Note> notes;
    if (scenario.mount != vehicle::Mount::free) {
        return notes;
    }
    const vehicle::RotorParameters& rotor = scenario.airframe.rotor;
    const double lag_s =
        rotor.motor_kv_rpm_V > 0.0
            ? 0.0
            : 0.5 * (rotor.time_constant_up_s + rotor.time_constant_down_s) + rotor.command_delay_s;
    for (const RateLoop& loop : rate_loops(scenario)) {
        if (!(loop.crossover_rad_s > 0.0)) {
            notes.push_back(
                {true,
                 fmt::format("by its gains the {} rate does not follow at all: autopilot.{}_K "
                             "is {:.3g}, {}_P {:.3g}",
                             loop.axis, loop.gain, loop.scale, loop.gain, loop.proportional)});
            continue;
        }
        const bool quick = loop.crossover_rad_s * lag_s > kQuickest;
        if (quick || loop.crossover_rad_s < kSlowest * loop.attitude_1_s) {
            notes.push_back(
                {true, fmt::format("by its gains the {} rate follows at {} rad/s, too {}: "
                                   "autopilot.{}_K is {:.3g}, some {} is right",
                                   loop.axis, about(loop.crossover_rad_s),
                                   quick ? fmt::format("fast for motors that lag by {} ms",
                                                       about(1e3 * lag_s))
                                         : fmt::format("slow for an attitude that needs {} 1/s",
                                                       about(loop.attitude_1_s)),
                                   loop.gain, loop.scale,
                                   about(loop.scale * kUsual_rad_s / loop.crossover_rad_s))});
        }
    }
    return notes;
}

/// Guidance looks for a wall that both LiDARs see near enough.
std::optional<Note> start(const Scenario& scenario) {
    const bool docks = scenario.mission != scenario::Mission::hover;
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
    const std::vector<Note> of_gains = gains(scenario);
    notes.insert(notes.end(), of_gains.begin(), of_gains.end());
    for (const std::string& text : vehicle_remarks(scenario.airframe, scenario.inherited)) {
        notes.push_back({true, text});
    }
    return notes;
}

std::vector<std::string> warnings(const Scenario& scenario) {
    std::vector<std::string> texts;
    for (const Note& note : notes_of(scenario)) {
        if (note.warns) {
            texts.push_back(note.text);
        }
    }
    return texts;
}

std::vector<std::string> makers_notes(const scenario::Scenario& scenario) {
    return texts(scenario, false);
}

std::vector<std::string> makers_warnings(const scenario::Scenario& scenario) {
    return texts(scenario, true);
}

}  // namespace limpet::remarks
