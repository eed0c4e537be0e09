// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/wind.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::vehicle {
namespace {

constexpr double kSigma_m_s = 0.8;

/// Gusts of 5 m at 2 m/s: T = 2.5 s on every axis.
WindParameters gusty() {
    WindParameters wind;
    wind.gust_sigma_m_s = kSigma_m_s;
    wind.gust_length_m = 5.0;
    wind.gust_drift_m_s = 2.0;
    return wind;
}
constexpr double kT_s = 2.5;

RandomStream stream(std::uint32_t run) {
    return RandomStream(5, run, Stream::wind);
}

TEST(Wind, StillAirByDefaultAndDrawsNothing) {
    const WindModel model = make_wind({}, 1e-3);
    WindState state = start(model, stream(0));
    for (int k = 0; k < 10; ++k) {
        step(model, state);
    }
    EXPECT_FALSE(model.gusts);
    EXPECT_EQ(wind_W_m_s(model, state), Vector3::Zero());
    RandomStream fresh = stream(0);
    EXPECT_EQ(state.random.uniform(), fresh.uniform());
}

TEST(Wind, BlowsAwayFromWhereItComes) {
    WindParameters west;
    west.wind_speed_m_s = 3.0;
    west.wind_from_deg = 270.0;
    const WindModel model = make_wind(west, 1e-3);
    const Vector3 wind = wind_W_m_s(model, start(model, stream(0)));
    EXPECT_NEAR((wind - Vector3(0.0, 3.0, 0.0)).norm(), 0.0, 1e-12);  // to the east
}

TEST(Wind, LowAltitudeScalesByHand) {
    WindParameters wind;
    wind.gust_wind_m_s = 10.0;
    wind.gust_height_m = 30.48;  // 100 ft: 0.177 + 0.0823 = 0.2593
    const GustScales scales = gust_scales(wind);
    EXPECT_NEAR(scales.down.sigma_m_s, 1.0, 1e-12);
    EXPECT_NEAR(scales.down.length_m, 30.48, 1e-12);
    EXPECT_NEAR(scales.along.sigma_m_s, 1.0 / 0.58280, 1e-4);  // 0.2593^0.4
    EXPECT_NEAR(scales.along.length_m, 30.48 / 0.19795, 0.1);  // 0.2593^1.2
    EXPECT_EQ(scales.across.sigma_m_s, scales.along.sigma_m_s);
    wind.gust_height_m = 304.8;  // 1000 ft: 0.177 + 0.823 = 1, isotropic
    EXPECT_NEAR(gust_scales(wind).along.sigma_m_s, 1.0, 1e-12);
    EXPECT_NEAR(gust_scales(wind).along.length_m, 304.8, 1e-9);
}

TEST(Wind, GustsAreStationaryFromTheFirstTickOn) {
    constexpr int kRuns = 20000;
    const WindModel model = make_wind(gusty(), 0.05);
    for (const int steps : {0, 1, 10, 100}) {
        Vector3 squares = Vector3::Zero();
        for (std::uint32_t run = 0; run < kRuns; ++run) {
            WindState state = start(model, stream(run));
            for (int k = 0; k < steps; ++k) {
                step(model, state);
            }
            squares += wind_W_m_s(model, state).cwiseAbs2();
        }
        const Vector3 variance = squares / kRuns / (kSigma_m_s * kSigma_m_s);
        const double four_sigma = 4.0 * std::sqrt(2.0 / kRuns);
        EXPECT_NEAR(variance.x(), 1.0, four_sigma) << steps;
        EXPECT_NEAR(variance.y(), 1.0, four_sigma) << steps;
        EXPECT_NEAR(variance.z(), 1.0, four_sigma) << steps;
    }
}

/// Mean of w(t) w(t + lag) over an ensemble, axis by axis, over sigma^2.
Vector3 correlation(double dt_s, int lag_steps) {
    constexpr std::uint32_t kRuns = 40000;
    const WindModel model = make_wind(gusty(), dt_s);
    Vector3 sum = Vector3::Zero();
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        WindState state = start(model, stream(run));
        const Vector3 before = wind_W_m_s(model, state);
        for (int k = 0; k < lag_steps; ++k) {
            step(model, state);
        }
        sum += before.cwiseProduct(wind_W_m_s(model, state));
    }
    return sum / kRuns / (kSigma_m_s * kSigma_m_s);
}

/// Dryden's spectra are the transforms of these; of any step, so that it may be coarse.
TEST(Wind, AutocorrelationIsDrydensWhateverTheStep) {
    struct Case {
        double dt_s;
        int steps;
    };
    for (const Case& c :
         {Case{0.1, 5}, Case{1.25, 1}, Case{0.25, 10}, Case{2.5, 2}, Case{10.0, 1}}) {
        const double s = c.dt_s * c.steps / kT_s;
        const Vector3 found = correlation(c.dt_s, c.steps);
        const double along = std::exp(-s);
        const double across = (1.0 - 0.5 * s) * std::exp(-s);
        EXPECT_NEAR(found.x(), along, 0.025) << c.dt_s;
        EXPECT_NEAR(found.y(), across, 0.025) << c.dt_s;
        EXPECT_NEAR(found.z(), across, 0.025) << c.dt_s;
    }
}

/// One step of 1 ms adds what theory says to the difference of two neighbours: 2 sigma^2 (1 - rho).
TEST(Wind, NeighboursAtOneMillisecondDifferByWhatTheSpectrumAllows) {
    const WindModel model = make_wind(gusty(), 1e-3);
    WindState state = start(model, stream(0));
    constexpr int kSteps = 200000;
    Vector3 sum = Vector3::Zero();
    Vector3 before = wind_W_m_s(model, state);
    for (int k = 0; k < kSteps; ++k) {
        step(model, state);
        const Vector3 now = wind_W_m_s(model, state);
        sum += (now - before).cwiseAbs2();
        before = now;
    }
    const double s = 1e-3 / kT_s;
    const double unit = kSigma_m_s * kSigma_m_s * kSteps;
    EXPECT_NEAR(sum.x() / unit / (2.0 * (1.0 - std::exp(-s))), 1.0, 0.02);
    EXPECT_NEAR(sum.y() / unit / (2.0 * (1.0 - (1.0 - 0.5 * s) * std::exp(-s))), 1.0, 0.02);
}

TEST(Wind, GustsGoWithTheWindsDirection) {
    WindParameters wind;
    wind.gust_wind_m_s = 8.0;  // stronger level than down
    wind.wind_from_deg = 300.0;
    const WindModel model = make_wind(wind, 1e-3);
    WindState state = start(model, stream(3));
    state.across = {};
    state.down = {};
    const Vector3 gust = wind_W_m_s(model, state);
    EXPECT_NEAR(gust.norm(), model.along.sigma_m_s * std::abs(state.along.first), 1e-12);
    EXPECT_NEAR(std::abs(gust.y() / gust.x()), std::tan(radians(60.0)), 1e-9);
}

TEST(Wind, SameKeySameGustsAnotherRunOthers) {
    const WindModel model = make_wind(gusty(), 1e-3);
    WindState a = start(model, stream(1));
    WindState b = start(model, stream(1));
    WindState c = start(model, stream(2));
    for (int k = 0; k < 100; ++k) {
        step(model, a);
        step(model, b);
        step(model, c);
    }
    EXPECT_EQ(wind_W_m_s(model, a), wind_W_m_s(model, b));
    EXPECT_NE(wind_W_m_s(model, a), wind_W_m_s(model, c));
}

}  // namespace
}  // namespace limpet::vehicle
