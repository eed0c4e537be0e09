// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/frames.hpp"
#include "limpet/core/rotor_list.hpp"
#include "limpet/measured/measured.hpp"
#include "limpet/suction/pneumatics.hpp"
#include "limpet/suction/pressure.hpp"
#include "limpet/vehicle/nearness.hpp"
#include "limpet/vehicle/rotor.hpp"
#include "limpet/vehicle/wall_aerodynamics.hpp"

namespace limpet::measured {
namespace {

double given(const Numbers& numbers, const char* name, double otherwise) {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
}

/// A law that looks at one x alone.
template <class Value>
std::vector<double> each(std::span<const double> x, Value value) {
    std::vector<double> said;
    said.reserve(x.size());
    for (const double at : x) {
        said.push_back(value(at));
    }
    return said;
}

// --- air ----------------------------------------------------------------------------------------

/// Mean over rotors of a radius of 1 m, whose middle is x above the ground; tilted as a whole.
std::vector<double> ground_of(const RotorList<vehicle::Rotor>& rotors, bool neighbours,
                              const Numbers& numbers, std::span<const double> x) {
    vehicle::AirframeNumbers airframe;
    airframe.rotor.radius_m = 1.0;
    airframe.rotors = rotors;
    const vehicle::NearnessModel model = vehicle::make_nearness(
        {.ground_effect = true, .ground_neighbours = neighbours}, /*ground_z_W_m=*/0.0);
    Kinematics base;
    base.q_WF = quaternion_from_euler({.roll_rad = radians(given(numbers, "tilt_deg", 0.0))});
    return each(x, [&](double radii) {
        base.p_WF_m.z() = -radii;
        return vehicle::mean_thrust_gain(model, airframe, base);
    });
}

std::vector<double> ground(const Numbers& numbers, std::span<const double> x) {
    return ground_of({vehicle::Rotor{}}, false, numbers, x);
}

/// Rotors on a regular polygon whose sides are so long, with environment.ground_neighbours.
std::vector<double> ground_neighbours(const Numbers& numbers, std::span<const double> x) {
    RotorList<vehicle::Rotor> rotors(static_cast<std::size_t>(numbers.at("rotors")));
    const double step_rad = 2.0 * kPi / numbers.at("rotors");
    const double arm_radii = 0.5 * numbers.at("spacing_radii") / std::sin(0.5 * step_rad);
    for (std::size_t i = 0; i < rotors.size(); ++i) {
        const double at_rad = static_cast<double>(i) * step_rad;
        rotors[i].p_B_m = {arm_radii * std::sin(at_rad), arm_radii * std::cos(at_rad), 0.0};
    }
    return ground_of(rotors, true, numbers, x);
}

std::vector<double> ceiling(const Numbers& /*numbers*/, std::span<const double> x) {
    return each(x, vehicle::ceiling_gain);
}

std::vector<double> wall_force(const Numbers& /*numbers*/, std::span<const double> x) {
    return each(x, [](double radii) { return vehicle::wall_coefficients(radii).force; });
}

std::vector<double> wall_moment(const Numbers& /*numbers*/, std::span<const double> x) {
    return each(x, [](double radii) { return vehicle::wall_coefficients(radii).moment; });
}

// --- suction ------------------------------------------------------------------------------------

double vacuum_share(const suction::Surface& surface, double pressure_Pa) {
    return (kAtmosphere_Pa - pressure_Pa) / (kAtmosphere_Pa - surface.vacuum_pressure_Pa);
}

/// Eq. (5), as a share of the greatest vacuum; of a sensor that ends earlier, of what it shows.
std::vector<double> sealing_first_order(const Numbers& numbers, std::span<const double> x) {
    suction::Surface surface;
    surface.sealing_time_constant_s = numbers.at("tau_s");
    const double seen = given(numbers, "seen_share", 1.0);
    return each(x, [&](double t_s) {
        const double pressure_Pa =
            pressure_after(surface, {}, suction::Airflow::sealing, kAtmosphere_Pa, t_s);
        return std::min(1.0, vacuum_share(surface, pressure_Pa) / seen);
    });
}

/// Eq. (6), as a share of the vacuum at its beginning.
std::vector<double> leak_first_order(const Numbers& numbers, std::span<const double> x) {
    suction::Surface surface;
    surface.unsealing_time_constant_s = numbers.at("tau_s");
    return each(x, [&](double t_s) {
        return vacuum_share(surface, pressure_after(surface, {}, suction::Airflow::unsealing,
                                                    surface.vacuum_pressure_Pa, t_s));
    });
}

/// The shipped cup, pump and hose on metal, the pump by its speed, as a share of the vacuum that
/// the pump can reach.
std::vector<double> sealing_pneumatic(const Numbers& numbers, std::span<const double> x) {
    suction::PneumaticParameters parameters;
    parameters.pump_speed_L_min = numbers.at("pump_speed_L_min");
    parameters.pump_ultimate_Pa = given(numbers, "pump_ultimate_Pa", parameters.pump_ultimate_Pa);
    parameters.cup_gives_way = given(numbers, "cup_gives_way", 0.0);
    constexpr double kPress_N = 20.0;
    constexpr double kRadius_m = 0.04;
    const suction::Surface tight{
        .pore_volume_cm3 = 0.0, .leak_conductance_cm3_s = 0.0, .leak_clamping_exponent = 0.0};
    const suction::CupAir cup = sealed_cup(parameters, tight, kRadius_m, kPress_N, false);
    const suction::Pump pump = pump_of(parameters, true);
    double pressure_Pa = kAtmosphere_Pa;
    double now_s = 0.0;
    return each(x, [&](double t_s) {
        pressure_Pa = pressure_after(pump, cup, pressure_Pa, t_s - now_s);
        now_s = t_s;
        return (kAtmosphere_Pa - pressure_Pa) / (kAtmosphere_Pa - parameters.pump_ultimate_Pa);
    });
}

// --- motors -------------------------------------------------------------------------------------

/// A rotor's two time constants, one of them here: share of a step that is done.
std::vector<double> motor_first_order(const Numbers& numbers, std::span<const double> x) {
    vehicle::RotorParameters rotor;
    rotor.time_constant_up_s = numbers.at("tau_s");
    rotor.command_delay_s = 0.0;
    return each(x, [&](double t_s) {
        return t_s > 0.0 ? 1.0 - vehicle::make_lag(rotor, t_s).keep_up : 0.0;
    });
}

/// KV, resistance, torque and inertia: share of a step from one speed to another.
std::vector<double> motor_physical(const Numbers& numbers, std::span<const double> x) {
    const double inertia_kg_m2 = numbers.at("inertia_kg_m2");
    const vehicle::MotorLaw motor{
        .emf_1_s = numbers.at("damping_N_m_s") / inertia_kg_m2,
        .load_1_rad = numbers.at("torque_constant_N_m_s2") / inertia_kg_m2,
        .brakes = given(numbers, "brakes", 1.0) > 0.0};
    const double from = numbers.at("from_rad_s");
    const double to = numbers.at("to_rad_s");
    return each(x, [&](double t_s) {
        return (vehicle::speed_after_rad_s(motor, from, to, t_s) - from) / (to - from);
    });
}

constexpr Quantity kTilt = {.name = "tilt_deg", .from = -90.0, .to = 90.0};

const std::array<Law, 10> kLaws = {{
    {.name = "ground", .needs = {}, .allows = {kTilt}, .without = 1.0, .say = ground},
    {.name = "ground_neighbours",
     .needs = {{.name = "rotors", .from = 2.0, .to = kMaxRotors, .whole = true}},
     .allows = {kTilt},
     .without = 1.0,
     .fits = "spacing_radii",
     .fits_from = 2.0,
     .fits_to = 20.0,
     .say = ground_neighbours},
    {.name = "ceiling", .needs = {}, .allows = {}, .without = 1.0, .say = ceiling},
    {.name = "wall_force", .needs = {}, .allows = {}, .without = 0.0, .say = wall_force},
    {.name = "wall_moment", .needs = {}, .allows = {}, .without = 0.0, .say = wall_moment},
    {.name = "sealing_first_order",
     .needs = {},
     .allows = {{.name = "seen_share", .from = 0.01, .to = 1.0}},
     .fits = "tau_s",
     .fits_from = 0.02,
     .fits_to = 50.0,
     .say = sealing_first_order},
    {.name = "leak_first_order",
     .needs = {},
     .allows = {},
     .fits = "tau_s",
     .fits_from = 0.02,
     .fits_to = 100.0,
     .say = leak_first_order},
    {.name = "sealing_pneumatic",
     .needs = {},
     .allows = {{.name = "pump_ultimate_Pa", .from = 100.0, .to = 1e5},
                {.name = "cup_gives_way", .to = 1.0}},
     .fits = "pump_speed_L_min",
     .fits_from = 0.3,
     .fits_to = 60.0,
     .say = sealing_pneumatic},
    {.name = "motor_first_order",
     .needs = {},
     .allows = {{.name = "from_rad_s"}, {.name = "to_rad_s"}},
     .fits = "tau_s",
     .fits_from = 1e-3,
     .fits_to = 1.0,
     .say = motor_first_order},
    {.name = "motor_physical",
     .needs = {{.name = "damping_N_m_s"},
               {.name = "torque_constant_N_m_s2"},
               {.name = "from_rad_s"},
               {.name = "to_rad_s"}},
     .allows = {{.name = "brakes", .to = 1.0, .whole = true}},
     .fits = "inertia_kg_m2",
     .fits_from = 1e-8,
     .fits_to = 1e-3,
     .say = motor_physical},
}};

}  // namespace

std::span<const Law> laws() {
    return kLaws;
}

}  // namespace limpet::measured
