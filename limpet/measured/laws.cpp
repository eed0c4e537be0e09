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

/// Two or four rotors so far apart, with environment.ground_neighbours.
std::vector<double> ground_neighbours(const Numbers& numbers, std::span<const double> x) {
    const double half = 0.5 * numbers.at("spacing_radii");
    const RotorList<vehicle::Rotor> two = {{{0.0, half, 0.0}}, {{0.0, -half, 0.0}}};
    const RotorList<vehicle::Rotor> four = {
        {{half, half, 0.0}}, {{half, -half, 0.0}}, {{-half, half, 0.0}}, {{-half, -half, 0.0}}};
    return ground_of(numbers.at("rotors") > 2.0 ? four : two, true, numbers, x);
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

/// Eq. (5), as a share of the greatest vacuum; of a sensor that ends earlier, of what it shows.
std::vector<double> sealing_first_order(const Numbers& numbers, std::span<const double> x) {
    const double tau_s = numbers.at("tau_s");
    const double seen = given(numbers, "seen_share", 1.0);
    return each(x,
                [=](double t_s) { return std::min(1.0, (1.0 - std::exp(-t_s / tau_s)) / seen); });
}

/// Eq. (6), as a share of the vacuum at its beginning.
std::vector<double> leak_first_order(const Numbers& numbers, std::span<const double> x) {
    const double tau_s = numbers.at("tau_s");
    return each(x, [tau_s](double t_s) { return std::exp(-t_s / tau_s); });
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
    const double tau_s = numbers.at("tau_s");
    return each(x, [tau_s](double t_s) { return 1.0 - std::exp(-t_s / tau_s); });
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

const std::array<Law, 10> kLaws = {{
    {.name = "ground", .needs = {}, .allows = {"tilt_deg"}, .without = 1.0, .say = ground},
    {.name = "ground_neighbours",
     .needs = {"rotors"},
     .allows = {"tilt_deg"},
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
     .allows = {"seen_share"},
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
     .allows = {"pump_ultimate_Pa", "cup_gives_way"},
     .fits = "pump_speed_L_min",
     .fits_from = 0.3,
     .fits_to = 60.0,
     .say = sealing_pneumatic},
    {.name = "motor_first_order",
     .needs = {},
     .allows = {"from_rad_s", "to_rad_s"},
     .fits = "tau_s",
     .fits_from = 1e-3,
     .fits_to = 1.0,
     .say = motor_first_order},
    {.name = "motor_physical",
     .needs = {"damping_N_m_s", "torque_constant_N_m_s2", "from_rad_s", "to_rad_s"},
     .allows = {"brakes"},
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
