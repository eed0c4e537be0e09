// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/wall_aerodynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace limpet::vehicle {
namespace {

struct Point {
    double radii;
    WallCoefficients coefficients;
};

/// facts.md section 5 (JINT 110, 2024), 12 in propellers: |C_F| as given for both facilities
/// together, C_M the mean of TerraXcube and DU2SRI; the last row is assumed.
constexpr std::array<Point, 6> kPublished = {{
    {1.0, {.0035, 0.5 * (.0080 + .0023)}},
    {1.5, {.0025, 0.5 * (.0048 + .0017)}},
    {2.0, {.0020, 0.5 * (.0000 + .0014)}},
    {2.5, {.0015, 0.5 * (.0000 + .0011)}},
    {3.0, {.0005, 0.5 * (.0000 + .0010)}},
    {4.0, {.0000, .0000}},
}};

/// Mean of the squares, in revolutions per second.
double mean_square_rev_s(const RotorsState& rotors) {
    double sum = 0.0;
    for (const double speed_rad_s : rotors.speed_rad_s) {
        sum += speed_rad_s * speed_rad_s;
    }
    return sum / static_cast<double>(rotors.speed_rad_s.size()) / (4.0 * kPi * kPi);
}

/// 1 up to `full`, 0 from `none` on, straight between.
double closeness(const WallAirParameters& parameters, double radii) {
    const double width = parameters.recirculation_none_radii - parameters.recirculation_full_radii;
    return std::clamp((parameters.recirculation_none_radii - radii) / width, 0.0, 1.0);
}

}  // namespace

const ParameterTable<WallAirParameters>& wall_air_table() {
    using W = WallAirParameters;
    static const ParameterTable<W> table = {
        {"wall_aerodynamics", "switch", 0.0, 1.0, &W::wall_aerodynamics,
         "steady force and pitching moment of the air near the wall",
         "paper: its simulation has none"},
        {"wall_force_scale", "-", -10.0, 10.0, &W::wall_force_scale,
         "of the published mean; > 0 towards the wall",
         "assumed: two facilities disagree on the sign, facts.md section 5"},
        {"wall_moment_scale", "-", -10.0, 10.0, &W::wall_moment_scale,
         "of the published mean, 0.45 to 1.55 span the two facilities at d/R = 1; > 0 the wall's "
         "side goes down",
         "assumed: facts.md section 5 gives no sign"},
        {"recirculation_moment_rms_N_m", "N m", 0.0, 10.0, &W::recirculation_moment_rms_N_m,
         "wandering pitching moment of the wake at the wall, at hover thrust",
         "assumed: facts.md section 5, 0.05 to 0.1; paper: none"},
        {"recirculation_correlation_s", "s", 0.01, 100.0, &W::recirculation_correlation_s,
         "correlation time of it", "assumed: facts.md section 5"},
        {"recirculation_full_radii", "-", 0.0, 10.0, &W::recirculation_full_radii,
         "closest motor axis to the wall in propeller radii at which it is full",
         "assumed: full when attached, at 1.7 to 1.9, facts.md section 5"},
        {"recirculation_none_radii", "-", 0.1, 20.0, &W::recirculation_none_radii,
         "and from which there is none", "assumed: as the steady part ends, facts.md section 5"},
    };
    return table;
}

WallCoefficients wall_coefficients(double radii) {
    if (radii <= kPublished.front().radii) {
        return kPublished.front().coefficients;
    }
    for (std::size_t i = 1; i < kPublished.size(); ++i) {
        const Point& low = kPublished[i - 1];
        const Point& high = kPublished[i];
        if (radii < high.radii) {
            const double share = (radii - low.radii) / (high.radii - low.radii);
            const auto between = [share](double a, double b) { return a + share * (b - a); };
            return {.force = between(low.coefficients.force, high.coefficients.force),
                    .moment = between(low.coefficients.moment, high.coefficients.moment)};
        }
    }
    return {};
}

WallAirModel make_wall_air(const WallAirParameters& parameters, double rotor_radius_m,
                           double dt_s) {
    const double r = dt_s / parameters.recirculation_correlation_s;
    return {.parameters = parameters,
            .keep = std::exp(-r),
            .kick = std::sqrt(-std::expm1(-2.0 * r)),
            .reach_m = rotor_radius_m *
                       std::max(kPublished.back().radii, parameters.recirculation_none_radii),
            .diameter_4_m4 = std::pow(2.0 * rotor_radius_m, 4)};
}

WallAirState start(const WallAirModel& model, const RandomStream& random) {
    WallAirState state;
    state.random = random;
    if (model.parameters.recirculation_moment_rms_N_m > 0.0) {
        state.swirl = state.random.normal();
    }
    return state;
}

void step(const WallAirModel& model, WallAirState& state) {
    if (model.parameters.recirculation_moment_rms_N_m > 0.0) {
        state.swirl = model.keep * state.swirl + model.kick * state.random.normal();
    }
}

bool acts(const WallAirModel& model) {
    return model.parameters.wall_aerodynamics ||
           model.parameters.recirculation_moment_rms_N_m > 0.0;
}

Wrench wall_air_wrench_W(const WallAirModel& model, const WallAirState& state,
                         const AirframeNumbers& airframe, const RotorsState& rotors,
                         double thrust_N, const Quaternion& q_WB, double distance_m,
                         const Vector3& x_T_W) {
    const WallAirParameters& parameters = model.parameters;
    const double radii = std::max(0.0, distance_m) / airframe.rotor.radius_m;
    const Vector3 axis_W = q_WB * Vector3::UnitZ();
    const double along = axis_W.dot(x_T_W);
    const double level = std::sqrt(std::max(0.0, 1.0 - along * along));
    Wrench wrench;
    if (parameters.wall_aerodynamics) {
        const WallCoefficients c = wall_coefficients(radii);
        const double diameter_m = 2.0 * airframe.rotor.radius_m;
        const double unit_N = level * kAirDensity_kg_m3 * airframe.rotor.density_ratio *
                              mean_square_rev_s(rotors) * model.diameter_4_m4;
        wrench.force_N = parameters.wall_force_scale * c.force * unit_N * x_T_W;
        // Turning from the axis that points down towards the wall's normal lifts the wall's side.
        wrench.moment_N_m = -parameters.wall_moment_scale * c.moment * unit_N * diameter_m *
                            axis_W.cross(x_T_W).normalized();
    }
    const double share = level * closeness(parameters, radii) * std::max(0.0, thrust_N) /
                         (airframe.mass_kg * kGravity_m_s2);
    wrench.moment_N_m +=
        parameters.recirculation_moment_rms_N_m * state.swirl * share * (q_WB * Vector3::UnitY());
    return wrench;
}

}  // namespace limpet::vehicle
