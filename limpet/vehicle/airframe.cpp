// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/airframe.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::vehicle {
namespace {

constexpr double kRodRadius_m = 0.01;
constexpr double kCoaxial_m = 0.01;  ///< hubs no further apart share an axis, or a plane

void validate_rotors(const Airframe& airframe) {
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        const Rotor& rotor = airframe.rotors[i];
        const double z_m = rotor.below_m - airframe.rotor.height_m;
        if (!(std::abs(rotor.p_B_m.z() - z_m) <= 1e-9)) {
            throw InputError(fmt::format("{}: rotor {}: z_m is {}, must be below_m - height_m = {}",
                                         airframe.name, i, rotor.p_B_m.z(), z_m));
        }
        if (std::abs(rotor.direction) != 1) {
            throw InputError(fmt::format("{}: rotor {}: direction is {}, must be +1 or -1",
                                         airframe.name, i, rotor.direction));
        }
        for (std::size_t k = 0; k < i; ++k) {
            const Rotor& other = airframe.rotors[k];
            const Vector3 apart_m = rotor.p_B_m - other.p_B_m;
            if (apart_m.head<2>().norm() > kCoaxial_m) {
                continue;
            }
            if (std::abs(apart_m.z()) <= kCoaxial_m) {
                throw InputError(fmt::format(
                    "{}: rotors {} and {} are in one place; the lower of a coaxial pair needs "
                    "below_m > {:g}",
                    airframe.name, k, i, kCoaxial_m));
            }
            if (rotor.direction == other.direction) {
                throw InputError(
                    fmt::format("{}: rotors {} and {} are a coaxial pair and turn alike, must turn "
                                "against each other",
                                airframe.name, k, i));
            }
        }
    }
}

/// Inertia about the origin of B of a body whose own is about its centre (Steiner).
Matrix3 about_origin(const BodyInertia& body) {
    const Matrix3 arm = skew(body.centre_B_m);
    return body.inertia_kg_m2 - body.mass_kg * arm * arm;
}

}  // namespace

void require_physical(const std::string& what, double mass_kg, const Matrix3& inertia_kg_m2) {
    if (!(mass_kg > 0.0)) {
        throw InputError(fmt::format("{}: mass_kg is {}, must be > 0", what, mass_kg));
    }
    // Beyond these squares overflow, and the eigenvalues' solver does not end as it should.
    constexpr double kLargest = 1e100;
    if (!(mass_kg < kLargest) || !(inertia_kg_m2.cwiseAbs().maxCoeff() < kLargest) ||
        !inertia_kg_m2.allFinite()) {
        throw InputError(
            fmt::format("{}: mass and inertias must be finite numbers below {:g}", what, kLargest));
    }
    const Vector3 principal =
        Eigen::SelfAdjointEigenSolver<Matrix3>(inertia_kg_m2, Eigen::EigenvaluesOnly).eigenvalues();
    if (!(principal[0] > 0.0) || !(principal[0] + principal[1] >= principal[2])) {
        throw InputError(fmt::format(
            "{}: principal inertias are {:.4g}, {:.4g} and {:.4g} kg m2, must be > 0 and the two "
            "smaller ones together at least the largest",
            what, principal[0], principal[1], principal[2]));
    }
}

double pitch_on_legs_rad(const Airframe& airframe) {
    // In the vehicle's plane: the tip's surface is `reach` beyond the joint's distance to the wall,
    // below sin(pitch) - ahead cos(pitch) + reach = 0.
    const double ahead_m = airframe.cup.joint_x_m - airframe.legs.tip_x_m;
    const double below_m = airframe.legs.tip_z_m - airframe.cup.joint_z_m;
    const double reach_m = airframe.legs.tip_radius_m - airframe.cup.lip_offset_m;
    const double across_m = std::hypot(ahead_m, below_m);
    return std::atan2(ahead_m, below_m) - std::asin(std::clamp(reach_m / across_m, -1.0, 1.0));
}

void validate(const Airframe& airframe) {
    validate_rotors(airframe);
    require_physical(airframe.name, airframe.mass_kg, airframe.inertia_kg_m2.asDiagonal());
    if (!airframe.has_cup) {
        return;
    }
    const BodyInertia cup = cup_inertia(airframe);
    const BodyInertia carriage = carriage_inertia(airframe);
    require_physical(airframe.name + ": cup", cup.mass_kg, cup.inertia_kg_m2);
    require_physical(airframe.name + ": carriage", carriage.mass_kg, carriage.inertia_kg_m2);
    const BodyInertia base = base_inertia(airframe);
    require_physical(airframe.name + ": base (the whole less slider and cup)", base.mass_kg,
                     base.inertia_kg_m2);
}

double carried_mass_kg(const AirframeNumbers& airframe) {
    return airframe.mass_kg + airframe.payload.mass_kg;
}

double lifting_rotors(const AirframeNumbers& airframe) {
    double sum = 0.0;
    for (const Rotor& rotor : airframe.rotors) {
        sum += rotor.thrust_share;
    }
    return sum;
}

double hubs_reach_m(const AirframeNumbers& airframe) {
    double reach_m = 0.0;
    for (const Rotor& rotor : airframe.rotors) {
        reach_m = std::max(reach_m, rotor.p_B_m.norm());
    }
    return reach_m;
}

BodyInertia carriage_inertia(const Airframe& airframe) {
    if (airframe.cad) {
        return airframe.cad->carriage;
    }
    const double mass_kg = airframe.slider.mass_kg;
    const double length_m = 2.0 * airframe.slider.travel_m;
    const double along = 0.5 * mass_kg * kRodRadius_m * kRodRadius_m;
    const double across =
        mass_kg * (length_m * length_m / 12.0 + kRodRadius_m * kRodRadius_m / 4.0);
    return {.mass_kg = mass_kg,
            .centre_B_m = {airframe.cup.joint_x_m - 0.5 * length_m, 0.0, airframe.cup.joint_z_m},
            .inertia_kg_m2 = Vector3(along, across, across).asDiagonal()};
}

BodyInertia cup_inertia(const Airframe& airframe) {
    if (airframe.cad) {
        return cup_with_yoke(*airframe.cad);
    }
    const CupMountParameters& cup = airframe.cup;
    const double along = 0.5 * cup.mass_kg * cup.radius_m * cup.radius_m;
    const double across = 0.5 * along + cup.mass_kg * cup.lip_offset_m * cup.lip_offset_m / 12.0;
    return {.mass_kg = cup.mass_kg,
            .centre_B_m = {cup.joint_x_m + cup.mass_offset_m, 0.0, cup.joint_z_m},
            .inertia_kg_m2 = Vector3(along, across, across).asDiagonal()};
}

BodyInertia base_inertia(const Airframe& airframe) {
    if (airframe.cad) {
        return airframe.cad->base;
    }
    BodyInertia base{.mass_kg = airframe.mass_kg,
                     .centre_B_m = Vector3::Zero(),
                     .inertia_kg_m2 = airframe.inertia_kg_m2.asDiagonal()};
    if (!airframe.has_cup) {
        return base;
    }
    Vector3 moment_kg_m = Vector3::Zero();
    for (const BodyInertia& part : {carriage_inertia(airframe), cup_inertia(airframe)}) {
        base.mass_kg -= part.mass_kg;
        moment_kg_m -= part.mass_kg * part.centre_B_m;
        base.inertia_kg_m2 -= about_origin(part);
    }
    base.centre_B_m = moment_kg_m / base.mass_kg;
    const Matrix3 arm = skew(base.centre_B_m);
    base.inertia_kg_m2 += base.mass_kg * arm * arm;
    return base;
}

JointLaw slider_law(const SliderParameters& slider) {
    return {.stiffness = slider.stiffness_N_m,
            .damping = slider.damping_N_s_m,
            .rest = slider.preload_N / slider.stiffness_N_m,
            .lower = -slider.travel_m,
            .upper = 0.0,
            .stop_stiffness = slider.stop_stiffness_N_m,
            .stop_damping = slider.stop_damping_N_s_m};
}

JointLaw hinge_law(const CupMountParameters& mount) {
    constexpr double kBumper_N_m_rad = 20.0;  // assumed: gives by a degree under a leg's push
    constexpr double kBumper_N_m_s_rad = 0.05;
    const double range_rad = radians(mount.range_deg);
    return {.stiffness = mount.centring_stiffness_N_m_rad,
            .damping = mount.centring_damping_N_m_s_rad,
            .lower = -range_rad,
            .upper = range_rad,
            .stop_stiffness = kBumper_N_m_rad,
            .stop_damping = kBumper_N_m_s_rad};
}

BodyInertia cup_with_yoke(const CadBodies& cad) {
    BodyInertia both;
    both.mass_kg = cad.cup_yoke.mass_kg + cad.cup.mass_kg;
    both.centre_B_m =
        (cad.cup_yoke.mass_kg * cad.cup_yoke.centre_B_m + cad.cup.mass_kg * cad.cup.centre_B_m) /
        both.mass_kg;
    for (const BodyInertia& part : {cad.cup_yoke, cad.cup}) {
        const Matrix3 arm = skew(part.centre_B_m - both.centre_B_m);
        both.inertia_kg_m2 += part.inertia_kg_m2 - part.mass_kg * arm * arm;
    }
    return both;
}

Vector3 usual_inertia_kg_m2(const AirframeNumbers& airframe) {
    constexpr double kRollPitch = 0.25, kYaw = 0.45;
    const double reach_m = hubs_reach_m(airframe);
    const double own_kg_m2 = carried_mass_kg(airframe) * reach_m * reach_m;
    double ahead_kg_m2 = 0.0;
    if (airframe.has_cup) {
        ahead_kg_m2 = (airframe.slider.mass_kg + airframe.cup.mass_kg) * airframe.cup.joint_x_m *
                      airframe.cup.joint_x_m;
    }
    return {kRollPitch * own_kg_m2, kRollPitch * own_kg_m2 + ahead_kg_m2,
            kYaw * own_kg_m2 + ahead_kg_m2};
}

bool is_plausible_inertia(const AirframeNumbers& airframe, double inertia_kg_m2, int axis,
                          double factor) {
    const double usual = usual_inertia_kg_m2(airframe)[axis];
    return inertia_kg_m2 > usual / factor && inertia_kg_m2 < usual * factor;
}

}  // namespace limpet::vehicle
