// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <vector>

#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

/// Does the filter know how wrong it is in whole flights, as flown? e' P^-1 e of an honest filter
/// of 15 states has mean 15. Parameters as PX4 ships them are larger than these sensors' noise, so
/// that it is humbler than it need be; with the sensors' own densities it is honest
/// (docs/models.md#estimator).
namespace limpet::simulation {
namespace {

/// Truth less belief, as the filter's error is: attitude as a rotation vector in B.
Eigen::Matrix<double, 15, 1> error_of(const FlightState& state, const Kinematics& truth) {
    const autopilot::EstimatorState& filter = state.autopilot.estimator;
    const autopilot::Navigation& belief = filter.navigation;
    const auto& imu = state.sensors.units<sensors::ImuSensor>()[0].state;
    Eigen::Matrix<double, 15, 1> error;
    error << truth.p_WF_m - belief.p_WB_m, truth.v_WF_W_m_s - belief.v_WB_m_s,
        rotation_vector_from_quaternion(belief.q_WB.conjugate() * truth.q_WF),
        imu.gyro_turn_on_rad_s + imu.gyro_bias_rad_s - belief.gyro_bias_rad_s,
        imu.accel_turn_on_m_s2 + imu.accel_bias_m_s2 - belief.accelerometer_bias_m_s2;
    return error;
}

double mean_nees(const std::vector<std::string>& overrides) {
    constexpr std::uint32_t kFlights = 3;
    double sum = 0.0, count = 0.0;
    const auto model =
        build_model(scenario::load_scenario("perch_concrete", {.overrides = overrides}));
    for (std::uint32_t run = 0; run < kFlights; ++run) {
        Flight flight(model, run);
        while (!flight.ended()) {
            const Kinematics truth = flight.state().truth.base;
            const double time_s = seconds(flight.state().tick);
            flight.tick();
            const FlightState& state = flight.state();
            const autopilot::EstimatorState& filter = state.autopilot.estimator;
            // At the instants to which it has just brought its covariance, once it has settled.
            if (time_s > 2.0 && filter.time_s == time_s && filter.covariance_s == time_s) {
                const auto error = error_of(state, truth);
                sum += error.dot(filter.covariance.llt().solve(error));
                ++count;
            }
        }
    }
    EXPECT_GT(count, 100.0);
    return sum / count;
}

TEST(Nees, AsFlownTheFilterIsHumblerThanItNeedBe) {
    const double nees = mean_nees({});
    SCOPED_TRACE(testing::Message() << nees);
    EXPECT_GT(nees, 1.0);
    EXPECT_LT(nees, 5.0);
}

TEST(Nees, WithTheSensorsOwnDensitiesItIsHonest) {
    const double nees =
        mean_nees({"autopilot.EKF2_GYR_NOISE=3.39e-3", "autopilot.EKF2_ACC_NOISE=0.04",
                   "autopilot.EKF2_GYR_B_NOISE=3.88e-4", "autopilot.EKF2_ACC_B_NOISE=0.06",
                   "autopilot.EKF2_EVP_NOISE=5e-4", "autopilot.EKF2_EVA_NOISE=1.745e-3"});
    SCOPED_TRACE(testing::Message() << nees);
    EXPECT_GT(nees, 12.0);
    EXPECT_LT(nees, 18.0);
}

}  // namespace
}  // namespace limpet::simulation
