// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/derived.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "limpet/vehicle/rotor.hpp"

namespace limpet::scenario {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kDerived = {{
    {"guidance", "lidar_separation_m"},
    {"guidance", "lidar_x_m"},
    {"guidance", "joint_x_m"},
    {"guidance", "joint_z_m"},
    {"guidance", "hover_thrust"},
    {"guidance", "zero_thrust"},
    {"guidance", "drag_1_s"},
    {"autopilot", "MPC_THR_HOVER"},
    {"autopilot", "mag_field_north_gauss"},
    {"autopilot", "mag_field_east_gauss"},
    {"autopilot", "mag_field_down_gauss"},
    {"suction", "radius_m"},
    {"guidance", "valve_fitted"},
}};

void derive_from_vehicle(const vehicle::Airframe& airframe, Scenario& scenario) {
    const vehicle::RotorParameters& rotor = airframe.rotor;
    const double hover_thrust = hover_command(airframe);
    const double hover_speed_rad_s =
        rotor.speed_offset_rad_s + rotor.speed_scale_rad_s * hover_thrust;
    scenario.guidance.lidar_separation_m = airframe.lidar_separation_m;
    scenario.guidance.lidar_x_m = airframe.lidar_x_m;
    scenario.guidance.joint_x_m = airframe.cup.joint_x_m;
    scenario.guidance.joint_z_m = airframe.cup.joint_z_m;
    scenario.guidance.hover_thrust = hover_thrust;
    scenario.guidance.zero_thrust = -rotor.speed_offset_rad_s / rotor.speed_scale_rad_s;
    scenario.guidance.drag_1_s =
        kRotors * rotor.drag_constant_kg * hover_speed_rad_s / airframe.mass_kg;
    scenario.autopilot.MPC_THR_HOVER = hover_thrust;
    scenario.cup.lip.radius_m = airframe.cup.radius_m;
}

/// The world model that PX4 would look the field up in.
void derive_from_earth(const sensors::SensorParameters& sensors,
                       autopilot::AutopilotParameters& autopilot) {
    const double dip_rad = radians(sensors.mag_inclination_deg);
    const double east_of_x_rad = radians(sensors.mag_declination_deg);
    const double level_gauss = sensors.mag_field_gauss * std::cos(dip_rad);
    autopilot.mag_field_north_gauss = level_gauss * std::cos(east_of_x_rad);
    autopilot.mag_field_east_gauss = level_gauss * std::sin(east_of_x_rad);
    autopilot.mag_field_down_gauss = sensors.mag_field_gauss * std::sin(dip_rad);
}

}  // namespace

void derive(Scenario& scenario) {
    derive_from_vehicle(scenario.airframe, scenario);
    derive_from_earth(scenario.sensors, scenario.autopilot);
    derive_from_suction(scenario);
}

void derive_from_suction(Scenario& scenario) {
    scenario.guidance.valve_fitted = scenario.cup.valve_fitted;
}

bool is_derived(std::string_view section, std::string_view name) {
    return std::find(kDerived.begin(), kDerived.end(), std::pair(section, name)) != kDerived.end();
}

}  // namespace limpet::scenario
