// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/time.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::scenario {
namespace {

/// Fails where the key is written, or for the whole file when it is not.
[[noreturn]] void fail_at(const YamlNode& root, const std::string& path, std::string_view what) {
    const YamlNode* node = &root;
    for (std::size_t begin = 0; node != nullptr && begin <= path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        node = node->find(std::string_view(path).substr(begin, end - begin));
        begin = end + 1;
    }
    if (node != nullptr) {
        fail(*node, what);
    }
    throw InputError(fmt::format("{}: {}: {}", root.place, path, what));
}

bool is_whole(double value) {
    return std::abs(value - std::round(value)) < 1e-6;
}

void check_mission(const Scenario& scenario, const YamlNode& root) {
    const bool flies = scenario.mount == vehicle::Mount::free;
    if (flies && scenario.mission == Mission::hover) {
        return;
    }
    const char* key = flies ? "mission" : "mount";
    const std::string word(flies ? to_string(scenario.mission) : to_string(scenario.mount));
    if (!scenario.wall.present) {
        fail_at(root, key, word + " needs a wall, and there is none");
    }
    if (!scenario.airframe.has_cup) {
        fail_at(root, key,
                fmt::format("{} needs a cup, and {} has none", word, scenario.airframe.name));
    }
    const double lip_x_m = scenario.airframe.cup.joint_x_m + scenario.airframe.cup.lip_offset_m;
    if (flies && scenario.simulation.start_distance_m <= lip_x_m) {
        fail_at(root, "simulation.start_distance_m",
                fmt::format("{} is too close, the lip is {} m ahead of the centre of mass",
                            scenario.simulation.start_distance_m, number_text(lip_x_m)));
    }
}

void check_compliance(const Scenario& scenario, const YamlNode& root) {
    if (scenario.wall.compliance_m_N > 0.0 && scenario.engine == &plant::kMujocoEngine) {
        fail_at(root, "wall.compliance_m_N",
                "MuJoCo's contacts are no springs, allowed with simulation.engine reduced");
    }
}

/// A motor that the battery cannot bring to where the vehicle hovers.
void check_motor(const Scenario& scenario, const YamlNode& root) {
    const vehicle::RotorParameters& rotor = scenario.airframe.rotor;
    if (rotor.motor_kv_rpm_V <= 0.0) {
        return;
    }
    const double top_rad_s = top_speed_rad_s(rotor, rotor.nominal_voltage_V);
    const double hover_rad_s = hover_speed_rad_s(scenario.airframe);
    if (!(top_rad_s > hover_rad_s)) {
        fail_at(root, "vehicle.rotor.motor_kv_rpm_V",
                fmt::format("{:.6g} rpm/V turn the propeller by {:.6g} rad/s on {:.6g} V, allowed "
                            "is more than the {:.6g} of a hover",
                            rotor.motor_kv_rpm_V, top_rad_s, rotor.nominal_voltage_V, hover_rad_s));
    }
}

/// An empty pack has no voltage for rotors whose speed follows it.
void check_battery(const Scenario& scenario, const YamlNode& root) {
    if (!(vehicle::hover_drive_share(scenario.airframe) > 0.0)) {
        fail_at(root, "vehicle.battery.initial_charge",
                "0 leaves rotors whose speed follows the voltage without any, allowed above 0");
    }
}

/// What the estimator can only run with.
void check_aiding(const Scenario& scenario, const YamlNode& root) {
    if (scenario.autopilot.EKF2_EV_CTRL == 0 && scenario.autopilot.EKF2_GPS_CTRL == 0) {
        fail_at(root, "autopilot.EKF2_EV_CTRL",
                "0 leaves no position, allowed only with EKF2_GPS_CTRL above 0");
    }
}

/// A hull follows the water, which falls no faster than free.
void check_swell(const vehicle::SwellParameters& swell, const YamlNode& root) {
    const double turn_rad_s = 2.0 * kPi / swell.swell_period_s;
    const double most_m_s2 =
        turn_rad_s * turn_rad_s *
        Vector3(swell.swell_into_wall_m, swell.swell_along_wall_m, swell.swell_up_m).norm();
    if (most_m_s2 >= kGravity_m_s2) {
        fail_at(root, "environment.swell_period_s",
                fmt::format("{:.6g} s for so far a swell is {:.6g} m/s^2, allowed is less than "
                            "{:.6g}",
                            swell.swell_period_s, most_m_s2, kGravity_m_s2));
    }
}

void check_environment(const Environment& environment, const YamlNode& root) {
    check_swell(environment.swell, root);
    if (environment.wind.gust_sigma_m_s > 0.0 && environment.wind.gust_wind_m_s > 0.0) {
        fail_at(root, "environment.gust_sigma_m_s",
                "gusts are given by gust_wind_m_s already, one of the two must be 0");
    }
}

void check_ceiling(const Scenario& scenario, const YamlNode& root) {
    const double ceiling_m = scenario.environment.nearness.ceiling_height_m;
    const double top_m = scenario.simulation.start_height_m + scenario.airframe.rotor.height_m;
    if (ceiling_m > 0.0 && top_m >= ceiling_m) {
        fail_at(
            root, "environment.ceiling_height_m",
            fmt::format("{:.6g} is not above the rotors at the start, {:.6g} m", ceiling_m, top_m));
    }
}

/// It hangs, and does not lie there, when the flight begins.
void check_payload(const Scenario& scenario, const YamlNode& root) {
    const vehicle::PayloadParameters& payload = scenario.airframe.payload;
    const double free_m = scenario.simulation.start_height_m - payload.hook_z_m;
    if (payload.mass_kg > 0.0 && payload.cable_length_m >= free_m) {
        fail_at(root, "vehicle.payload.cable_length_m",
                fmt::format("{:.6g} m reach the ground at the start, allowed is less than {:.6g}",
                            payload.cable_length_m, free_m));
    }
}

/// Vacuum begins below the pressure of the air.
void check_vacuum(const Scenario& scenario, const YamlNode& root) {
    const double ambient_Pa = scenario.cup.ambient_Pa;
    for (const auto& [path, pressure_Pa] :
         {std::pair("suction.attachment_pressure_Pa", scenario.cup.attachment_pressure_Pa),
          std::pair("guidance.land_pressure_Pa", scenario.guidance.land_pressure_Pa),
          std::pair("guidance.detach_pressure_Pa", scenario.guidance.detach_pressure_Pa)}) {
        if (pressure_Pa > ambient_Pa) {
            fail_at(root, path,
                    fmt::format("{:.6g} is above the pressure of the air at {:.6g} m, {:.6g} Pa",
                                pressure_Pa, scenario.environment.air.altitude_m, ambient_Pa));
        }
    }
}

void check_steps(const SimulationParameters& simulation, const YamlNode& root) {
    if (!is_whole(kTick_s / simulation.step_s)) {
        fail_at(root, "simulation.step_s",
                fmt::format("{} does not divide the tick of {} s", number_text(simulation.step_s),
                            number_text(kTick_s)));
    }
    if (!is_whole(simulation.longest_step_s / kTick_s)) {
        fail_at(root, "simulation.longest_step_s",
                fmt::format("{} is not whole ticks of {} s", number_text(simulation.longest_step_s),
                            number_text(kTick_s)));
    }
    if (!is_whole(simulation.step_s / simulation.touch_step_s)) {
        fail_at(root, "simulation.touch_step_s",
                fmt::format("{} does not divide step_s, {} s", number_text(simulation.touch_step_s),
                            number_text(simulation.step_s)));
    }
}

/// Longest step in which a spring and damper taken as they stand do not ring: h^2 k / m + 2 h c / m
/// = 4.
double longest_step_s(double k, double c, double m) {
    return (std::sqrt(c * c + 4.0 * k * m) - c) / k;
}

/// Ropes and clamp act as they stand at a step's beginning, on the base; all else acts within the
/// step.
void check_mount(const Scenario& scenario, const YamlNode& root) {
    if (scenario.mount == vehicle::Mount::free) {
        return;
    }
    const vehicle::BodyInertia base = base_inertia(scenario.airframe);
    const vehicle::Airframe& airframe = scenario.airframe;
    double longest_s = 0.0;
    if (scenario.mount == vehicle::Mount::press_rig) {
        const vehicle::Clamp held = clamp(scenario.press_rig, airframe);
        longest_s = longest_step_s(held.stiffness_N_m, held.damping_N_s_m, base.mass_kg);
        for (int axis = 0; axis < 3; ++axis) {
            longest_s = std::min(longest_s, longest_step_s(held.turn_stiffness_N_m_rad,
                                                           held.turn_damping_N_m_s_rad[axis],
                                                           base.inertia_kg_m2(axis, axis)));
        }
    } else {
        const vehicle::Pendulum ropes =
            hang(scenario.pendulum, airframe, Vector3::Zero(), Quaternion::Identity());
        constexpr double kAll = vehicle::kRopes;
        longest_s =
            longest_step_s(kAll * ropes.stiffness_N_m, kAll * ropes.damping_N_s_m, base.mass_kg);
        for (const int axis : {0, 1}) {  // rolls and pitches on its hooks
            double arms_m2 = 0.0;
            for (const Vector3& hook_m : ropes.hook_B_m) {
                arms_m2 += hook_m[1 - axis] * hook_m[1 - axis];
            }
            longest_s = std::min(longest_s, longest_step_s(arms_m2 * ropes.stiffness_N_m,
                                                           arms_m2 * ropes.damping_N_s_m,
                                                           base.inertia_kg_m2(axis, axis)));
        }
    }
    if (scenario.simulation.step_s > longest_s) {
        fail_at(root, "simulation.step_s",
                fmt::format(
                    "{} s is unstable for this vehicle on mount {}, allowed up to {:.2g} s; or "
                    "a softer mount",
                    number_text(scenario.simulation.step_s), to_string(scenario.mount), longest_s));
    }
}

/// A vehicle may be such that what follows from it is out of range: too heavy to hover.
void check_derived(const Scenario& scenario, const std::vector<Section>& sections,
                   const YamlNode& root) {
    for (const Section& section : sections) {
        for (const BoundParameter& row : section.rows) {
            if (!row.allows(row.value.get()) && derived(section.name, row.name, scenario)) {
                const bool too_heavy = row.name == "hover_thrust" && row.value.get() > 1.0;
                fail_at(root, "vehicle",
                        fmt::format("{}.{} follows from it as {:.4g}, allowed {}{}", section.name,
                                    row.name, row.value.get(), allowed_text(row),
                                    too_heavy ? ": its rotors do not lift it" : ""));
            }
        }
    }
}

void check_order(const YamlNode& root, const std::string& section, std::string_view low_name,
                 double low, std::string_view high_name, double high) {
    if (!(low < high)) {
        fail_at(
            root, fmt::format("{}.{}", section, low_name),
            fmt::format("{} must be below {}, {}", number_text(low), high_name, number_text(high)));
    }
}

}  // namespace

void check(const Scenario& scenario, const YamlNode& root) {
    check_aiding(scenario, root);
    Scenario bound = scenario;  // sections bind to what may be written
    const std::vector<Section> sections = scenario_sections(bound);
    check_battery(scenario, root);
    check_derived(scenario, sections, root);
    check_mission(scenario, root);
    check_compliance(scenario, root);
    check_motor(scenario, root);
    check_environment(scenario.environment, root);
    check_vacuum(scenario, root);
    check_ceiling(scenario, root);
    check_payload(scenario, root);
    check_steps(scenario.simulation, root);
    check_mount(scenario, root);
    check_order(root, "guidance", "land_pressure_Pa", scenario.guidance.land_pressure_Pa,
                "detach_pressure_Pa", scenario.guidance.detach_pressure_Pa);
    check_order(root, "sensors", "lidar_range_min_m", scenario.sensors.lidar_range_min_m,
                "lidar_range_max_m", scenario.sensors.lidar_range_max_m);
    const vehicle::WallAirParameters& wall_air = scenario.environment.wall_air;
    check_order(root, "environment", "recirculation_full_radii", wall_air.recirculation_full_radii,
                "recirculation_none_radii", wall_air.recirculation_none_radii);
    check_order(root, "autopilot", "MPC_THR_MIN", scenario.autopilot.MPC_THR_MIN, "MPC_THR_HOVER",
                scenario.autopilot.MPC_THR_HOVER);
    check_order(root, "autopilot", "MPC_THR_HOVER", scenario.autopilot.MPC_THR_HOVER, "MPC_THR_MAX",
                scenario.autopilot.MPC_THR_MAX);
}

}  // namespace limpet::scenario
