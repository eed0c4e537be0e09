// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/wall_aerodynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limpet::vehicle {
namespace {

const Vector3 kIntoWall = Vector3::UnitX();
constexpr double kHoverSpeed_rad_s = 560.0;
const double kRadius_m = Airframe().rotor.radius_m;
constexpr double kHover_N = 3.2 * kGravity_m_s2;

RotorsState spinning_at(double speed_rad_s) {
    RotorsState rotors = standing(4);
    rotors.speed_rad_s.fill(speed_rad_s);
    return rotors;
}

WallAirParameters steady() {
    WallAirParameters parameters;
    parameters.wall_aerodynamics = true;
    return parameters;
}

Wrench at(const WallAirModel& model, const WallAirState& state, double radii,
          double speed_rad_s = kHoverSpeed_rad_s, const Quaternion& q_WB = Quaternion::Identity()) {
    const Airframe airframe;
    const double share = speed_rad_s / kHoverSpeed_rad_s;
    return wall_air_wrench_W(model, state, airframe, spinning_at(speed_rad_s),
                             kHover_N * share * share, q_WB, radii * airframe.rotor.radius_m,
                             kIntoWall);
}

TEST(WallAir, NothingByDefault) {
    const WallAirModel model = make_wall_air({}, kRadius_m, 1e-3);
    WallAirState state = start(model, RandomStream(1, 0, Stream::wall_air));
    step(model, state);
    EXPECT_FALSE(acts(model));
    const Wrench wrench = at(model, state, 1.5);
    EXPECT_EQ(wrench.force_N, Vector3::Zero());
    EXPECT_EQ(wrench.moment_N_m, Vector3::Zero());
}

/// facts.md section 5: rho n^2 D^4 = 84 N and D^5: 25.6 N m at hover; F ~ 0.2 N and M 0.04 to
/// 0.12 N m where the vehicle is attached, d/R = 1.7.
TEST(WallAir, SteadyPartIsThatOfTheFactsWhereAttached) {
    const Wrench wrench = at(make_wall_air(steady(), kRadius_m, 1e-3), {}, 1.7);
    EXPECT_NEAR(wrench.force_N.x(), 84.0 * (0.0025 - 0.4 * 0.0005), 0.002);
    EXPECT_NEAR(wrench.moment_N_m.y(), -25.6 * (0.00325 - 0.4 * (0.00325 - 0.0007)), 0.001);
    EXPECT_NEAR(wrench.force_N.x(), 0.2, 0.05);
    EXPECT_GT(std::abs(wrench.moment_N_m.y()), 0.04);
    EXPECT_LT(std::abs(wrench.moment_N_m.y()), 0.12);
}

TEST(WallAir, GoesWithTheSquareOfTheSpeedAndEndsAtFourRadii) {
    const WallAirModel model = make_wall_air(steady(), kRadius_m, 1e-3);
    EXPECT_NEAR(at(model, {}, 1.5, 2.0 * kHoverSpeed_rad_s).force_N.x(),
                4.0 * at(model, {}, 1.5).force_N.x(), 1e-12);
    EXPECT_EQ(at(model, {}, 1.5, 0.0).force_N, Vector3::Zero());
    double before = 1e9;
    for (const double radii : {1.0, 1.2, 1.5, 1.9, 2.0, 2.5, 2.9, 3.0, 3.5, 3.9}) {
        const double force_N = at(model, {}, radii).force_N.x();
        EXPECT_LT(force_N, before) << radii;
        EXPECT_GT(force_N, 0.0) << radii;
        before = force_N;
    }
    EXPECT_EQ(at(model, {}, 4.0).force_N, Vector3::Zero());
    EXPECT_EQ(at(model, {}, std::numeric_limits<double>::infinity()).moment_N_m, Vector3::Zero());
    EXPECT_EQ(wall_coefficients(0.3).force, wall_coefficients(1.0).force);
}

/// The loop asks within reach_m alone.
TEST(WallAir, ThereIsNoneFromItsReachOnAndSomeBeforeIt) {
    for (const double none_radii : {3.0, 6.0}) {
        WallAirParameters both = steady();
        both.recirculation_moment_rms_N_m = 0.1;
        both.recirculation_none_radii = none_radii;
        const WallAirModel model = make_wall_air(both, kRadius_m, 1e-3);
        const double radii = model.reach_m / kRadius_m;
        const WallAirState swirls{.swirl = 1.0, .random = {}};
        EXPECT_EQ(at(model, swirls, radii).force_N, Vector3::Zero()) << none_radii;
        EXPECT_EQ(at(model, swirls, radii).moment_N_m, Vector3::Zero());
        EXPECT_GT(at(model, swirls, 0.99 * radii).moment_N_m.norm(), 0.0);
    }
}

TEST(WallAir, ScalesTurnTheSigns) {
    WallAirParameters turned = steady();
    turned.wall_force_scale = -1.0;
    turned.wall_moment_scale = -2.0;
    const Wrench plain = at(make_wall_air(steady(), kRadius_m, 1e-3), {}, 1.5);
    const Wrench other = at(make_wall_air(turned, kRadius_m, 1e-3), {}, 1.5);
    EXPECT_NEAR((other.force_N + plain.force_N).norm(), 0.0, 1e-15);
    EXPECT_NEAR((other.moment_N_m + 2.0 * plain.moment_N_m).norm(), 0.0, 1e-15);
}

/// A vehicle that stands with another side to the wall still dips that side.
TEST(WallAir, TheSideAtTheWallGoesDownWhateverTheHeading) {
    const WallAirModel model = make_wall_air(steady(), kRadius_m, 1e-3);
    const Wrench ahead = at(model, {}, 1.5);
    const Wrench turned =
        at(model, {}, 1.5, kHoverSpeed_rad_s, quaternion_from_euler({.yaw_rad = radians(90.0)}));
    EXPECT_LT(ahead.moment_N_m.y(), 0.0);
    EXPECT_NEAR((ahead.moment_N_m - turned.moment_N_m).norm(), 0.0, 1e-12);
}

WallAirParameters unsteady() {
    WallAirParameters parameters;
    parameters.recirculation_moment_rms_N_m = 0.05;
    return parameters;
}

TEST(Recirculation, IsGaussMarkovOfItsVarianceAndCorrelationTime) {
    constexpr std::uint32_t kRuns = 40000;
    constexpr int kSteps = 5;
    const WallAirModel model =
        make_wall_air(unsteady(), kRadius_m, 0.05);  // 0.25 s: half a time constant
    double square_before = 0.0;
    double square_after = 0.0;
    double product = 0.0;
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        WallAirState state = start(model, RandomStream(9, run, Stream::wall_air));
        const double before = at(model, state, 1.5).moment_N_m.y() / 0.05;
        for (int k = 0; k < kSteps; ++k) {
            step(model, state);
        }
        const double after = at(model, state, 1.5).moment_N_m.y() / 0.05;
        square_before += before * before;
        square_after += after * after;
        product += before * after;
    }
    EXPECT_NEAR(square_before / kRuns, 1.0, 0.03);
    EXPECT_NEAR(square_after / kRuns, 1.0, 0.03);
    EXPECT_NEAR(product / kRuns, std::exp(-0.5), 0.03);
}

TEST(Recirculation, FadesWithDistanceThrustAndTilt) {
    const WallAirModel model = make_wall_air(unsteady(), kRadius_m, 1e-3);
    const WallAirState state{.swirl = 1.0, .random = {}};
    const auto moment = [&](double radii, double speed, double pitch_deg = 0.0) {
        return at(model, state, radii, speed,
                  quaternion_from_euler({.pitch_rad = radians(pitch_deg)}))
            .moment_N_m.norm();
    };
    EXPECT_NEAR(moment(1.7, kHoverSpeed_rad_s), 0.05, 1e-12);
    EXPECT_NEAR(moment(2.0, kHoverSpeed_rad_s), 0.05, 1e-12);
    EXPECT_NEAR(moment(3.0, kHoverSpeed_rad_s), 0.025, 1e-12);
    EXPECT_EQ(moment(4.0, kHoverSpeed_rad_s), 0.0);
    EXPECT_EQ(moment(1.7, 0.0), 0.0);
    EXPECT_NEAR(moment(1.7, 0.5 * kHoverSpeed_rad_s), 0.0125, 1e-12);
    EXPECT_NEAR(moment(1.7, kHoverSpeed_rad_s, 60.0), 0.025, 1e-12);
}

}  // namespace
}  // namespace limpet::vehicle
