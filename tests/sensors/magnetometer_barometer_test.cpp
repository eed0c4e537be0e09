// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limpet/core/atmosphere.hpp"
#include "limpet/sensors/barometer.hpp"
#include "limpet/sensors/magnetometer.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::at_rest;
using test::quiet_model;
using test::run;

TEST(Barometer, FollowsTheStandardAtmosphere) {
    // table of ISO 2533
    EXPECT_NEAR(standard_pressure_Pa(0.0), 101325.0, 1e-9);
    EXPECT_NEAR(standard_pressure_Pa(1000.0), 89874.6, 1.0);
    EXPECT_NEAR(standard_pressure_Pa(5000.0), 54019.9, 1.0);
    EXPECT_NEAR(standard_altitude_m(standard_pressure_Pa(123.4)), 123.4, 1e-9);
    // near the ground: rho g = 12 Pa/m
    EXPECT_NEAR(standard_pressure_Pa(0.5) - standard_pressure_Pa(-0.5), -12.013, 0.001);
}

TEST(Barometer, ReadsTheAltitudeAboveTheOrigin) {
    run(quiet_model(), 100, at_rest, [](Tick, const Readings& readings) {
        EXPECT_NEAR(readings.barometer.value.altitude_m, 1.0, 1e-9);  // z_W = -1
    });
}

TEST(Barometer, NoiseIsThatOfThePressure) {
    SensorsModel model = quiet_model();
    model.parameters.baro_noise_Pa = 5.0;
    std::vector<double> pressure_Pa;
    std::vector<double> altitude_m;
    run(model, 100000, at_rest, [&](Tick tick, const Readings& readings) {
        if (due(tick, 50)) {
            pressure_Pa.push_back(readings.barometer.value.pressure_Pa);
            altitude_m.push_back(readings.barometer.value.altitude_m);
        }
    });
    EXPECT_EQ(pressure_Pa.size(), 5000U);
    EXPECT_NEAR(test::statistics(pressure_Pa).deviation, 5.0, 0.25);
    EXPECT_NEAR(test::statistics(altitude_m).deviation, 5.0 / 12.01, 0.02);
}

TEST(Magnetometer, SeesTheFieldInItsOwnAxes) {
    SensorsModel model = quiet_model();
    const Vector3 field_W_gauss = earth_field_W_gauss(model.parameters);
    EXPECT_NEAR(field_W_gauss.norm(), 0.479, 1e-12);
    EXPECT_GT(field_W_gauss.z(), 0.0);  // dips on the northern half
    EXPECT_NEAR(field_W_gauss.y(), 0.0, 1e-15);

    // heading east, north lies to the left
    const auto east = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.q_WF = quaternion_from_euler({.yaw_rad = 0.5 * kPi});
        return truth;
    };
    run(model, 100, east, [&](Tick, const Readings& readings) {
        const Vector3& field_B_gauss = readings.magnetometer.value.field_B_gauss;
        EXPECT_NEAR(field_B_gauss.x(), 0.0, 1e-12);
        EXPECT_NEAR(field_B_gauss.y(), -field_W_gauss.x(), 1e-12);
        EXPECT_NEAR(field_B_gauss.z(), field_W_gauss.z(), 1e-12);
    });
}

TEST(Magnetometer, DeclinationPointsEast) {
    SensorParameters parameters;
    parameters.mag_declination_deg = 10.0;
    const Vector3 field = earth_field_W_gauss(parameters);
    EXPECT_NEAR(std::atan2(field.y(), field.x()), radians(10.0), 1e-12);
}

TEST(Magnetometer, ErrorIsAConstantBiasAndWhiteNoise) {
    SensorsModel model = quiet_model();
    model.parameters.mag_noise_gauss = 0.004;
    model.parameters.mag_bias_gauss = 0.1;
    std::vector<double> east;
    run(model, 100000, at_rest, [&](Tick tick, const Readings& readings) {
        if (due(tick, 100)) {
            east.push_back(readings.magnetometer.value.field_B_gauss.y());
        }
    });
    EXPECT_NEAR(test::statistics(east).deviation, 0.004, 0.0002);
    EXPECT_GT(std::abs(test::statistics(east).mean), 5.0 * 0.004 / 100.0);
}

}  // namespace
}  // namespace limpet::sensors
