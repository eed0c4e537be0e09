// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/nearness.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace limpet::vehicle {
namespace {

struct GainPoint {
    double radii, gain;
};
/// facts.md section 5 (JINT 110, 2024): the middle of 1.17 to 1.23 and of 1.08 to 1.11; 1.04; 1.
constexpr std::array<GainPoint, 4> kCeiling = {
    {{0.33, 1.20}, {1.0, 1.095}, {1.6, 1.04}, {2.3, 1.0}}};

/// Of the free thrust, what a rotor's own image takes from its inflow.
double own_share(double radii) {
    constexpr double kNearest = 0.54;
    const double root = 0.25 / std::max(radii, kNearest);
    return root * root;
}

/// Likewise the images of the rotors beside it; one on the same axis is in its own wake.
double neighbours_share(const NearnessModel& model, const AirframeNumbers& airframe,
                        const Kinematics& base, std::size_t rotor) {
    const double radius_m = airframe.rotor.radius_m;
    const Vector3 here_W_m = base.q_WF * airframe.rotors[rotor].p_B_m;
    double share = 0.0;
    for (const Rotor& other : airframe.rotors) {
        const Vector3 there_W_m = base.q_WF * other.p_B_m;
        const double beside_m = (there_W_m - here_W_m).head<2>().norm();
        if (beside_m < radius_m) {
            continue;
        }
        const double down_m = std::max(
            0.0, 2.0 * (model.ground_z_W_m - base.p_WF_m.z()) - here_W_m.z() - there_W_m.z());
        const double far_m = std::hypot(beside_m, down_m);
        share += 0.25 * radius_m * radius_m * down_m / (far_m * far_m * far_m);
    }
    return share;
}

}  // namespace

const ParameterTable<NearnessParameters>& nearness_table() {
    using N = NearnessParameters;
    static const ParameterTable<N> table = {
        {"ground_effect", "switch", 0.0, 1.0, &N::ground_effect,
         "rotors near the ground lift more at the same speed",
         "Cheeseman, Bennett, R&M 3021; paper: its simulation has none"},
        {"ground_neighbours", "switch", 0.0, 1.0, &N::ground_neighbours,
         "with ground_effect: and more for the rotors beside them",
         "images: Sanchez-Cuevas, Heredia, Ollero, doi 10.1155/2017/1823056, without its body; a "
         "pair of rotors lifts so, a quadrotor less (limpet validate)"},
        {"ceiling_height_m", "m", 0.0, 1000.0, &N::ceiling_height_m,
         "> 0: a ceiling so far above the ground; rotors below it lift more, one that meets it "
         "ends "
         "the flight",
         "JINT 110, 2024, facts.md section 5; paper: a hall, no ceiling near"},
    };
    return table;
}

double ground_gain(double radii) {
    return 1.0 / (1.0 - own_share(radii));
}

double ceiling_gain(double radii) {
    if (radii <= kCeiling.front().radii) {
        return kCeiling.front().gain;
    }
    for (std::size_t i = 1; i < kCeiling.size(); ++i) {
        const GainPoint& low = kCeiling[i - 1];
        const GainPoint& high = kCeiling[i];
        if (radii < high.radii) {
            return std::lerp(low.gain, high.gain, (radii - low.radii) / (high.radii - low.radii));
        }
    }
    return 1.0;
}

NearnessModel make_nearness(const NearnessParameters& parameters, double ground_z_W_m) {
    return {.parameters = parameters,
            .ground_z_W_m = ground_z_W_m,
            .ceiling_z_W_m = ground_z_W_m - parameters.ceiling_height_m};
}

RotorList<double> thrust_gains(const NearnessModel& model, const AirframeNumbers& airframe,
                               const Kinematics& base) {
    const double radius_m = airframe.rotor.radius_m;
    const double upright = std::max(0.0, (base.q_WF * Vector3::UnitZ()).z());
    RotorList<double> gains(airframe.rotors.size(), 1.0);
    for (std::size_t i = 0; i < gains.size(); ++i) {
        const double z_m = (base.p_WF_m + base.q_WF * airframe.rotors[i].p_B_m).z();
        double gain = 1.0;
        if (model.parameters.ground_effect) {
            const double beside = model.parameters.ground_neighbours
                                      ? neighbours_share(model, airframe, base, i)
                                      : 0.0;
            gain /= 1.0 - own_share((model.ground_z_W_m - z_m) / radius_m) - beside;
        }
        if (model.has_ceiling()) {
            gain *= ceiling_gain((z_m - model.ceiling_z_W_m) / radius_m);
        }
        gains[i] += upright * (gain - 1.0);
    }
    return gains;
}

double mean_thrust_gain(const NearnessModel& model, const AirframeNumbers& airframe,
                        const Kinematics& base) {
    if (!model.acts()) {
        return 1.0;
    }
    const RotorList<double> gains = thrust_gains(model, airframe, base);
    return std::accumulate(gains.begin(), gains.end(), 0.0) / static_cast<double>(gains.size());
}

AirframeNumbers lifting_by(AirframeNumbers airframe, const RotorList<double>& gains) {
    for (std::size_t i = 0; i < gains.size(); ++i) {
        airframe.rotors[i].thrust_share *= gains[i];
    }
    return airframe;
}

}  // namespace limpet::vehicle
