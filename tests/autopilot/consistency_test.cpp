// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "trajectory.hpp"

/// Does the filter know how wrong it is? The normalised estimation error squared e' P^-1 e of an
/// honest 15-state filter has mean 15; over N runs its average has the deviation sqrt(2 * 15 / N).
/// Sensors and parameters agree here; the defaults of the parameters are larger on purpose.
/// Source: Bar-Shalom, Li, Kirubarajan, "Estimation with applications to tracking", 5.4.2.
namespace limpet::autopilot {
namespace {

constexpr int kRuns = 30;
constexpr double kDuration_s = 20.0;

/// Average over the runs at each whole second from the second on.
std::vector<double> average_nees(const AutopilotParameters& parameters, const SensorNoise& noise) {
    std::vector<double> average;
    for (int run = 0; run < kRuns; ++run) {
        RandomStream initial(100, static_cast<std::uint32_t>(run), Stream::test);
        SensedFlight flight(figure_of_eight, noise,
                            RandomStream(200, static_cast<std::uint32_t>(run), Stream::test));
        EstimatorState state =
            start_estimator(parameters, draw_initial(parameters, flight, initial));
        std::size_t second = 0;
        for (int i = 1; i * 0.004 < kDuration_s + 0.002; ++i) {
            flight.step();
            update_estimator(parameters, state, flight.readings);
            if (i % 250 == 0 && i >= 500) {
                const ErrorVector error = flight.error(state);
                average.resize(std::max(average.size(), second + 1), 0.0);
                average[second++] += error.dot(state.covariance.llt().solve(error)) / kRuns;
            }
        }
    }
    return average;
}

void expect_consistent(const std::vector<double>& average) {
    const double deviation = std::sqrt(2.0 * kErrors / kRuns);
    double mean = 0.0;
    for (const double nees : average) {
        EXPECT_NEAR(nees, kErrors, 4.0 * deviation);
        mean += nees / static_cast<double>(average.size());
    }
    // 95 % of one instant; the mean over instants is not wider
    EXPECT_NEAR(mean, kErrors, 1.96 * deviation);
    testing::Test::RecordProperty("mean_nees", std::to_string(mean));
}

TEST(Consistency, MotionCaptureWithLatency) {
    const SensorNoise noise;
    expect_consistent(average_nees(matched_to(noise), noise));
}

TEST(Consistency, MotionCaptureFortyMillisecondsLate) {
    SensorNoise noise;
    noise.motion_capture_latency_s = 0.04;
    expect_consistent(average_nees(matched_to(noise), noise));
}

TEST(Consistency, GpsBarometerMagnetometer) {
    const SensorNoise noise;
    expect_consistent(average_nees(matched_to_without_motion_capture(noise), noise));
}

/// The defaults claim more noise than the sensors have: the filter must be cautious, never bold.
TEST(Consistency, DefaultsAreCautious) {
    for (const double nees : average_nees(AutopilotParameters{}, SensorNoise{})) {
        EXPECT_LT(nees, kErrors);
    }
}

/// The test can fail: a filter told of half the noise is caught.
TEST(Consistency, BoldFilterIsCaught) {
    const SensorNoise noise;
    AutopilotParameters bold = matched_to(noise);
    bold.EKF2_EVP_NOISE *= 0.5;
    bold.EKF2_EVA_NOISE *= 0.5;
    for (const double nees : average_nees(bold, noise)) {
        EXPECT_GT(nees, kErrors + 4.0 * std::sqrt(2.0 * kErrors / kRuns));
    }
}

/// A GPS that is off by a constant drags the belief along as far as the filter says that it does:
/// two runs with the same noise, one of them with the offset, and a barometer that holds against
/// it.
TEST(Consistency, AGpssWanderIsFollowedAsFarAsItIsSaid) {
    const SensorNoise noise;
    const AutopilotParameters parameters = matched_to_without_motion_capture(noise);
    const Vector3 offset_m(0.3, -0.2, 0.4);
    RandomStream initial(300, 0, Stream::test);
    SensedFlight flight(figure_of_eight, noise, RandomStream(400, 0, Stream::test));
    const Estimate begin = draw_initial(parameters, flight, initial);
    EstimatorState without = start_estimator(parameters, begin);
    EstimatorState with = without;
    for (int i = 1; i * 0.004 < 10.0; ++i) {
        flight.step();
        update_estimator(parameters, without, flight.readings);
        Readings off = flight.readings;
        off.gps.value.p_WB_m += offset_m;
        update_estimator(parameters, with, off);
        if (i % 125 == 0) {
            const ErrorVector moved = flight.error(with) - flight.error(without);
            const ErrorVector said = with.followed * offset_m;
            EXPECT_LT((moved - said).head<6>().norm(), 0.02 * offset_m.norm()) << i;
        }
    }
    EXPECT_NEAR(with.followed(0, 0), -1.0, 0.1);
    EXPECT_GT(with.followed(2, 2), -0.9);  // the barometer's share
    // What it states has that in it: all that is correlated is EKF2_GPS_P_NOISE.
    const Covariance stated = stated_covariance(parameters, with);
    EXPECT_NEAR(stated(0, 0),
                with.covariance(0, 0) + with.followed.row(0).head<2>().squaredNorm() * 0.5 * 0.5 +
                    std::pow(with.followed(0, 2) * 0.75, 2),
                1e-12);
    EXPECT_NEAR(estimate_from(parameters, with).variance[0], stated(0, 0), 1e-12);
}

}  // namespace
}  // namespace limpet::autopilot
