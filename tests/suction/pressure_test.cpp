// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/suction.hpp"
#include "limpet/core/frames.hpp"
#include "surfaces.hpp"

namespace limpet::suction {
namespace {

class PressureOnSurface : public testing::TestWithParam<TableTwo> {};

TEST_P(PressureOnSurface, SealingIsEquationFive) {
    const Surface surface = surface_of(GetParam());
    double pressure_Pa = kAtmosphere_Pa;
    for (int k = 1; k <= 3000; ++k) {
        pressure_Pa = pressure_after(surface, {}, Airflow::sealing, pressure_Pa, 1e-3);
        const double exact_Pa = GetParam().vacuum_Pa + (kAtmosphere_Pa - GetParam().vacuum_Pa) *
                                                           std::exp(-k * 1e-3 / GetParam().tau_1_s);
        ASSERT_NEAR(pressure_Pa / exact_Pa, 1.0, 1e-6);
    }
}

TEST_P(PressureOnSurface, UnsealingIsEquationSix) {
    const Surface surface = surface_of(GetParam());
    double pressure_Pa = GetParam().vacuum_Pa;
    for (int k = 1; k <= 16000; ++k) {
        pressure_Pa = pressure_after(surface, {}, Airflow::unsealing, pressure_Pa, 1e-3);
        const double exact_Pa = kAtmosphere_Pa - (kAtmosphere_Pa - GetParam().vacuum_Pa) *
                                                     std::exp(-k * 1e-3 / GetParam().tau_2_s);
        ASSERT_NEAR(pressure_Pa / exact_Pa, 1.0, 1e-6);
    }
}

TEST_P(PressureOnSurface, TimeToTheLandingThreshold) {
    const double time_s =
        time_to_pressure_s(surface_of(GetParam()), {}, Airflow::sealing, kAtmosphere_Pa, 88000.0);
    EXPECT_NEAR(time_s, GetParam().time_to_880_s, 5e-4);
}

TEST_P(PressureOnSurface, InterruptedHalfWayItGoesOnFromWhereItIs) {
    const Surface surface = surface_of(GetParam());
    const double half_Pa = pressure_after(surface, {}, Airflow::sealing, kAtmosphere_Pa, 0.1);
    const double later_Pa = pressure_after(surface, {}, Airflow::unsealing, half_Pa, 0.2);
    EXPECT_NEAR(later_Pa,
                kAtmosphere_Pa - (kAtmosphere_Pa - half_Pa) * std::exp(-0.2 / GetParam().tau_2_s),
                1e-6);
}

INSTANTIATE_TEST_SUITE_P(TableII, PressureOnSurface, testing::ValuesIn(kTableTwo),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Pressure, StepDoesNotMatter) {
    const Surface surface;
    double fine_Pa = kAtmosphere_Pa;
    for (int k = 0; k < 4000; ++k) {
        fine_Pa = pressure_after(surface, {}, Airflow::sealing, fine_Pa, 2.5e-4);
    }
    EXPECT_NEAR(fine_Pa, pressure_after(surface, {}, Airflow::sealing, kAtmosphere_Pa, 1.0), 1e-6);
}

TEST(Pressure, ValveReleasesMetalInOrificeTime) {
    // facts.md item 20: a 2 mm orifice refills 60 cm^3 from 275 to 980 hPa in 0.12 s
    const Surface metal = surface_of(kTableTwo[3]);
    EXPECT_NEAR(time_to_pressure_s(metal, {}, Airflow::venting, 27500.0, 98000.0), 0.12, 0.01);
}

TEST(Pressure, UnreachablePressureTakesForEver) {
    EXPECT_TRUE(
        std::isinf(time_to_pressure_s(Surface{}, {}, Airflow::sealing, kAtmosphere_Pa, 60000.0)));
    EXPECT_TRUE(
        std::isinf(time_to_pressure_s(Surface{}, {}, Airflow::unsealing, 70000.0, 65000.0)));
    EXPECT_EQ(time_to_pressure_s(Surface{}, {}, Airflow::sealing, 70000.0, 70000.0), 0.0);
}

}  // namespace
}  // namespace limpet::suction
