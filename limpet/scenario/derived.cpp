// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/derived.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "limpet/core/frames.hpp"
#include "limpet/sensors/magnetometer.hpp"
#include "limpet/vehicle/battery.hpp"
#include "limpet/vehicle/rotor.hpp"
#include "limpet/vehicle/standing.hpp"

namespace limpet::scenario {
namespace {

double zero_thrust(const Scenario& scenario) {
    const vehicle::RotorParameters& rotor = scenario.airframe.rotor;
    return -rotor.speed_offset_rad_s / rotor.speed_scale_rad_s;
}

double drag_1_s(const Scenario& scenario) {
    const vehicle::RotorParameters& rotor = scenario.airframe.rotor;
    const double hover_speed_rad_s =
        spinning(rotor, 1, hover_command(scenario.airframe), hover_drive_share(scenario.airframe))
            .speed_rad_s[0];
    return static_cast<double>(scenario.airframe.rotors.size()) * rotor.drag_constant_kg *
           rotor.density_ratio * hover_speed_rad_s / carried_mass_kg(scenario.airframe);
}

/// Within what guidance takes: a vehicle without a cup has legs of no meaning.
double perched_pitch_deg(const Scenario& scenario) {
    constexpr double kLeast_deg = 5.0, kMost_deg = 90.0;
    return std::clamp(degrees(vehicle::pitch_on_legs_rad(scenario.airframe)), kLeast_deg,
                      kMost_deg);
}

/// Docked with a lean across, the vehicle rests turned about its cup by 0.71 to 0.78 of it, as
/// flown with every vehicle that ships: the lip keeps it, the weight takes some back. Turned
/// farther than tipping_turn_rad() it falls over a leg.
double lean_across_share(const Scenario& scenario) {
    constexpr double kKept = 0.8, kLeast = 0.01;
    const double lean_limit_rad = radians(scenario.guidance.lean_limit_deg);
    const double across_rad = vehicle::tipping_turn_rad(scenario.airframe) / kKept;
    return std::max(kLeast,
                    std::tan(std::min(across_rad, lean_limit_rad)) / std::tan(lean_limit_rad));
}

/// A pressure with the vacuum, and so the force, that the same number has at sea level.
double of_same_vacuum_Pa(const Scenario& scenario, double at_sea_level_Pa) {
    return scenario.cup.ambient_Pa - (kAtmosphere_Pa - at_sea_level_Pa);
}

/// Of a diaphragm pump: its dead volume makes a ratio of pressures, not a difference.
double pump_Pa(const Scenario& scenario, double suction::PneumaticParameters::*pressure_Pa) {
    return suction::PneumaticParameters{}.*pressure_Pa * (scenario.cup.ambient_Pa / kAtmosphere_Pa);
}

using Pneumatic = suction::PneumaticParameters;
using S = const Scenario&;

struct DerivedKey {
    std::string_view section;
    std::string_view name;
    double (*value)(S scenario);
};

constexpr DerivedKey kDerived[] = {
    {"suction", "radius_m", [](S s) { return s.airframe.cup.radius_m; }},
    {"suction", "attachment_pressure_Pa",
     [](S s) { return of_same_vacuum_Pa(s, suction::CupParameters{}.attachment_pressure_Pa); }},
    {"suction", "pump_ultimate_Pa", [](S s) { return pump_Pa(s, &Pneumatic::pump_ultimate_Pa); }},
    {"suction", "pump_stop_Pa", [](S s) { return pump_Pa(s, &Pneumatic::pump_stop_Pa); }},
    {"suction", "pump_restart_Pa", [](S s) { return pump_Pa(s, &Pneumatic::pump_restart_Pa); }},
    {"guidance", "lidar_separation_m", [](S s) { return s.airframe.lidar_separation_m; }},
    {"guidance", "lidar_x_m", [](S s) { return s.airframe.lidar_x_m; }},
    {"guidance", "joint_x_m", [](S s) { return s.airframe.cup.joint_x_m; }},
    {"guidance", "joint_z_m", [](S s) { return s.airframe.cup.joint_z_m; }},
    {"guidance", "perched_pitch_deg", &perched_pitch_deg},
    {"guidance", "lean_across_share", &lean_across_share},
    {"guidance", "land_pressure_Pa",
     [](S s) { return of_same_vacuum_Pa(s, guidance::PerchingParameters{}.land_pressure_Pa); }},
    {"guidance", "detach_pressure_Pa",
     [](S s) { return of_same_vacuum_Pa(s, guidance::PerchingParameters{}.detach_pressure_Pa); }},
    {"guidance", "hover_thrust", [](S s) { return hover_command(s.airframe); }},
    {"guidance", "zero_thrust", &zero_thrust},
    {"guidance", "drag_1_s", &drag_1_s},
    {"guidance", "valve_fitted", [](S s) { return s.cup.valve_fitted ? 1.0 : 0.0; }},
    {"autopilot", "MPC_THR_HOVER", [](S s) { return hover_command(s.airframe); }},
    {"autopilot", "mag_field_north_gauss",
     [](S s) { return sensors::earth_field_W_gauss(s.sensors).x(); }},
    {"autopilot", "mag_field_east_gauss",
     [](S s) { return sensors::earth_field_W_gauss(s.sensors).y(); }},
    {"autopilot", "mag_field_down_gauss",
     [](S s) { return sensors::earth_field_W_gauss(s.sensors).z(); }},
};

}  // namespace

std::optional<double> derived(std::string_view section, std::string_view name,
                              const Scenario& scenario) {
    const auto found = std::find_if(
        std::begin(kDerived), std::end(kDerived),
        [&](const DerivedKey& key) { return key.section == section && key.name == name; });
    if (found != std::end(kDerived)) {
        return found->value(scenario);
    }
    // The default's are the table's own, which a recording spells out.
    if (section == "autopilot" && scenario.aiding != &autopilot::kMotionCaptureAiding) {
        return setting_of(*scenario.aiding, name);
    }
    return std::nullopt;
}

RotorList<autopilot::RotorGeometry> rotor_geometry(const vehicle::AirframeNumbers& airframe) {
    RotorList<autopilot::RotorGeometry> rotors(airframe.rotors.size());
    for (std::size_t i = 0; i < rotors.size(); ++i) {
        rotors[i] = {.p_B_m = airframe.rotors[i].p_B_m,
                     .direction = static_cast<double>(airframe.rotors[i].direction),
                     .moment_constant_m = airframe.rotor.moment_constant_m};
    }
    return rotors;
}

std::vector<suction::Surface> surfaces_met(const Scenario& scenario) {
    std::vector<suction::Surface> met(scenario.wall.first_touches.begin(),
                                      scenario.wall.first_touches.end());
    met.push_back(scenario.wall.surface);
    for (suction::Surface& surface : met) {
        surface = in_condition(surface, *scenario.wall.condition);
        surface.vacuum_pressure_Pa *= air_at(scenario.environment.air).pressure_ratio;
    }
    return met;
}

void take_air(Scenario& scenario) {
    const Air air = air_at(scenario.environment.air);
    scenario.airframe.rotor.density_ratio = air.density_ratio;
    scenario.airframe.rotor.nominal_voltage_V =
        vehicle::kRatedCellVoltage_V * scenario.airframe.battery.cells;
    scenario.cup.ambient_Pa = air.pressure_Pa;
}

void derive(const Section& section, const Scenario& scenario) {
    for (const BoundParameter& row : section.rows) {
        if (const auto value = derived(section.name, row.name, scenario)) {
            row.value.set(*value);
        }
    }
}

void derive(Scenario& scenario) {
    for (const Section& section : scenario_sections(scenario)) {
        derive(section, scenario);
    }
}

}  // namespace limpet::scenario
