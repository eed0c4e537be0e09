// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/atmosphere.hpp"

#include <gtest/gtest.h>

#include "limpet/core/frames.hpp"

namespace limpet {
namespace {

/// Rows of ICAO Doc 7488 (geopotential altitude), written down as printed there.
TEST(Atmosphere, IsThatOfTheStandardsTable) {
    struct Row {
        double altitude_m, temperature_K, pressure_Pa, density_kg_m3;
    };
    for (const Row& row :
         {Row{0.0, 288.15, 101325.0, 1.22500}, Row{1000.0, 281.65, 89874.6, 1.11164},
          Row{2000.0, 275.15, 79495.2, 1.00649}, Row{3000.0, 268.65, 70108.5, 0.909122},
          Row{5000.0, 255.65, 54019.9, 0.736116}, Row{11000.0, 216.65, 22632.1, 0.363918}}) {
        const Air air = air_at({.altitude_m = row.altitude_m});
        EXPECT_NEAR(air.temperature_K, row.temperature_K, 1e-9) << row.altitude_m;
        EXPECT_NEAR(air.pressure_Pa, row.pressure_Pa, 0.2) << row.altitude_m;
        EXPECT_NEAR(air.density_ratio * kAirDensity_kg_m3, row.density_kg_m3, 2e-5)
            << row.altitude_m;
    }
}

TEST(Atmosphere, AtSeaLevelOnAStandardDayIsExactlyTheConstants) {
    const Air air = air_at({});
    EXPECT_EQ(air.pressure_Pa, kAtmosphere_Pa);
    EXPECT_EQ(air.pressure_ratio, 1.0);
    EXPECT_EQ(air.density_ratio, 1.0);
    EXPECT_EQ(air.temperature_K, Air{}.temperature_K);
}

/// rho = P / (R T): 30 K more on 288.15 K thin the air by 9.4 % and leave its pressure.
TEST(Atmosphere, AWarmDayThinsTheAirAtTheSamePressure) {
    const Air warm = air_at({.air_temperature_offset_K = 30.0});
    EXPECT_EQ(warm.pressure_Pa, kAtmosphere_Pa);
    EXPECT_NEAR(warm.density_ratio, 288.15 / 318.15, 1e-12);
    const Air high = air_at({.altitude_m = 2000.0, .air_temperature_offset_K = 15.0});
    EXPECT_NEAR(high.density_ratio * kAirDensity_kg_m3, 79495.2 / (287.05287 * 290.15), 2e-5);
}

}  // namespace
}  // namespace limpet
