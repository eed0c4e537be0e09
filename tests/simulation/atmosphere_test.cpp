// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"
#include "limpet/core/errors.hpp"

/// The same experiments where the air is thinner.
namespace limpet::simulation {
namespace {

std::vector<std::string> at(const char* altitude_m, std::vector<std::string> more = {}) {
    more.push_back(std::string("environment.altitude_m=") + altitude_m);
    return more;
}

TEST(Atmosphere, AtSeaLevelNothingChanges) {
    EXPECT_EQ(trace(model_of("perch_concrete", at("0"))).result.state_hash,
              flown("perch_concrete").result.state_hash);
}

/// What a pump keeps is its ratio of pressures, so that the vacuum goes with the air's pressure:
/// at 2000 m 795.0 of 1013.25 hPa (ICAO Doc 7488; the table of a maker of lifters has the same).
TEST(Atmosphere, TheGreatestVacuumFallsWithItsPressure) {
    for (const char* model : {"first_order", "pneumatic"}) {
        const auto vacuum_Pa = [&](const char* altitude_m, double ambient_Pa) {
            const Trace press =
                trace(model_of("press_turbine_blade",
                               at(altitude_m, {std::string("suction.pressure_model=") + model,
                                               "sensors.pressure_noise_Pa=0"})));
            EXPECT_EQ(press.truth.front().cup_status.pressure_Pa, ambient_Pa);
            double least_Pa = ambient_Pa;
            for (const Truth& truth : press.truth) {
                least_Pa = std::min(least_Pa, truth.cup_status.pressure_Pa);
            }
            return ambient_Pa - least_Pa;
        };
        const Air high = air_at({.altitude_m = 2000.0});
        EXPECT_NEAR(vacuum_Pa("2000", high.pressure_Pa) / vacuum_Pa("0", kAtmosphere_Pa),
                    79495.2 / 101325.0, 0.005)
            << model;
    }
}

/// T = k_mot (rho / rho_0) w^2 carries the same weight: w rises by the root of the density.
TEST(Atmosphere, AHoverTurnsFasterInThinAir) {
    const auto hover = [](std::vector<std::string> overrides) {
        overrides.emplace_back("simulation.hover_s=4");
        const auto model = model_of("hover", overrides);
        const Trace flight = trace(model);
        EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
        EXPECT_NEAR(flight.truth.back().thrust_N, 3.2 * kGravity_m_s2, 0.5);
        EXPECT_NEAR(flight.truth.back().base.p_WF_m.z(), 0.0, 0.05);  // its barometer is zeroed
        return flight.truth.back().rotor_speed_rad_s[0];
    };
    const double low_rad_s = hover({});
    EXPECT_NEAR(hover(at("3000")) / low_rad_s, std::sqrt(1.225 / 0.909122), 0.01);
    EXPECT_NEAR(hover({"environment.air_temperature_offset_K=30"}) / low_rad_s,
                std::sqrt(318.15 / 288.15), 0.01);
}

TEST(Atmosphere, ItPerchesAtTwoThousandMetres) {
    for (const char* model : {"first_order", "pneumatic"}) {
        const Trace flight = trace(model_of(
            "perch_concrete", at("2000", {std::string("suction.pressure_model=") + model})));
        EXPECT_EQ(flight.result.outcome, Outcome::released) << model << flight.result.reason;
    }
}

/// The thresholds keep their vacuum, and so the force that stands behind them.
TEST(Atmosphere, ThresholdsThatAreNotGivenFollow) {
    const auto model = model_of("perch_concrete", at("1000"));
    const double ambient_Pa = air_at({.altitude_m = 1000.0}).pressure_Pa;
    EXPECT_NEAR(ambient_Pa - model->cup.parameters.attachment_pressure_Pa, 13325.0, 1e-6);
    EXPECT_NEAR(ambient_Pa - model->guidance.land_pressure_Pa, 13325.0, 1e-6);
    EXPECT_NEAR(ambient_Pa - model->guidance.detach_pressure_Pa, 3325.0, 1e-6);
    const auto given = model_of("perch_concrete", at("1000", {"guidance.land_pressure_Pa=70000"}));
    EXPECT_EQ(given->guidance.land_pressure_Pa, 70000.0);
}

TEST(Atmosphere, AThresholdAboveTheAirsPressureIsRefused) {
    try {
        (void)model_of("perch_concrete", at("3000", {"suction.attachment_pressure_Pa=88000"}));
        FAIL() << "no vacuum would have been attached";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("above the pressure of the air at 3000 m, 70108"),
                  std::string::npos)
            << error.what();
    }
}

/// Too high to hover: told in one line, nothing flies.
TEST(Atmosphere, TooThinToHoverIsRefused) {
    EXPECT_THROW((void)model_of("hover", at("9500")), InputError);
}

}  // namespace
}  // namespace limpet::simulation
