// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/consistency.hpp"
#include "limpet/simulation/flight.hpp"

/// Does the filter know how wrong it is in whole flights, as flown? e' P^-1 e of an honest filter
/// of 15 states has mean 15. Parameters as PX4 ships them are larger than these sensors' noise, so
/// that it is humbler than it need be; with the sensors' own densities it is honest
/// (docs/models.md#estimator).
namespace limpet::simulation {
namespace {

/// Means over flights, each of mean 1 where the filter is honest, and of squared errors in metres
/// beside what it says of them.
struct Honesty {
    Consistency mean{.nees = 0.0, .nees_of = {}, .nis_of = {}};
    Vector3 squared_m2 = Vector3::Zero();
    Vector3 stated_m2 = Vector3::Zero();
};

Honesty honesty(const std::string& scenario, const std::vector<std::string>& overrides,
                std::uint32_t flights) {
    Honesty sum;
    double count = 0.0;
    const auto model = build_model(scenario::load_scenario(scenario, {.overrides = overrides}));
    for (std::uint32_t run = 0; run < flights; ++run) {
        Flight flight(model, run);
        while (!flight.ended()) {
            const Kinematics truth = flight.state().truth.base;
            const double time_s = seconds(flight.state().tick);
            flight.tick();
            const FlightState& state = flight.state();
            // Once it has settled.
            const auto seen =
                time_s > 2.0 ? consistency_of(*model, state, truth, time_s) : std::nullopt;
            if (seen) {
                sum.mean.nees += seen->nees;
                for (std::size_t k = 0; k < 5; ++k) {
                    sum.mean.nees_of[k] += seen->nees_of[k];
                }
                for (std::size_t k = 0; k < 6; ++k) {
                    sum.mean.nis_of[k] += seen->nis_of[k];
                }
                sum.squared_m2 += filter_error(state, truth).head<3>().cwiseAbs2();
                for (int axis = 0; axis < 3; ++axis) {
                    sum.stated_m2[axis] +=
                        state.autopilot.estimate.variance[static_cast<std::size_t>(axis)];
                }
                ++count;
            }
        }
    }
    EXPECT_GT(count, 100.0);
    sum.mean.nees /= count;
    for (double& one : sum.mean.nees_of) {
        one /= count;
    }
    for (double& one : sum.mean.nis_of) {
        one /= count;
    }
    sum.squared_m2 /= count;
    sum.stated_m2 /= count;
    return sum;
}

double mean_nees(const std::vector<std::string>& overrides) {
    return autopilot::kErrors * honesty("perch_concrete", overrides, 3).mean.nees;
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
