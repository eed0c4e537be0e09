// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/rotor_bench.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::identification {
namespace {

/// Not those of Table I, so that nothing can be copied from a default.
vehicle::RotorParameters other_rotor() {
    vehicle::RotorParameters rotor;
    rotor.motor_constant_kg_m = 1.7e-5;
    rotor.moment_constant_m = 2.3e-2;
    rotor.drag_constant_kg = 5e-4;
    rotor.radius_m = 0.127;
    rotor.command_delay_s = 0.02;
    return rotor;
}

TEST(ThrustStand, MeasuresTheRotorsOwnConstantsByEquationsThreeAndFour) {
    const vehicle::RotorParameters rotor = other_rotor();
    const auto rows = static_thrust_stand(rotor, {2000.0, 4000.0, 6000.0});
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_NEAR(rows[1].coefficients.speed_rpm, 4000.0, 1e-6);
    EXPECT_NEAR(rows[1].thrust_N, 1.7e-5 * std::pow(4000.0 * kPi / 30.0, 2), 1e-9);
    EXPECT_NEAR(rows[1].torque_N_m, 2.3e-2 * rows[1].thrust_N, 1e-12);
    std::vector<PropellerRow> file;
    file.reserve(rows.size());
    for (const ThrustStandRow& row : rows) {
        file.push_back(row.coefficients);
    }
    const RotorConstants found = fitted_constants(file, 2.0 * rotor.radius_m, kAirDensity_kg_m3);
    EXPECT_NEAR(found.motor_constant_kg_m, 1.7e-5, 1e-12);
    EXPECT_NEAR(found.moment_constant_m, 2.3e-2, 1e-9);
}

TEST(ThrustStand, TableOneComesBackFromTheDefaultRotor) {
    const auto rows = static_thrust_stand({}, {5350.0});
    // facts.md section 1: C_T 0.0933, C_P 0.0366; hover 7.85 N, 0.149 N m at 560 rad/s
    EXPECT_NEAR(rows[0].coefficients.thrust_coefficient, 0.0933, 1e-4);
    EXPECT_NEAR(rows[0].coefficients.power_coefficient, 0.0366, 1e-4);
    EXPECT_NEAR(rows[0].thrust_N, 7.85, 0.01);
    EXPECT_NEAR(rows[0].torque_N_m, 0.149, 5e-4);
}

TEST(ThrustStand, ARotorThatCannotGoFasterSaysSo) {
    const auto rows = static_thrust_stand({}, {20000.0});
    EXPECT_NEAR(rows[0].speed_rad_s, vehicle::RotorParameters{}.speed_max_rad_s, 1e-6);
}

TEST(CrossWind, TheSlopeIsLambdaOne) {
    const CrossWindResult found = cross_wind_tunnel(other_rotor(), 5000.0, {-4.0, 2.0, 6.0});
    EXPECT_NEAR(found.drag_constant_kg, 5e-4, 1e-15);
    EXPECT_NEAR(found.rows[2].drag_N, 5e-4 * found.speed_rad_s * 6.0, 1e-9);
    EXPECT_NEAR(found.rows[0].drag_N, -found.rows[2].drag_N * 4.0 / 6.0, 1e-12);
    EXPECT_NEAR(found.speed_rad_s, 5000.0 * kPi / 30.0, 1e-6);
}

}  // namespace
}  // namespace limpet::identification
