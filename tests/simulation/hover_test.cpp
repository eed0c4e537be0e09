// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

TEST(Hover, RotorsTurnAtTheWeightsSpeed) {
    // facts.md section 1: sqrt(m g / 4 k_mot) = 560 rad/s
    const Trace& trace = flown("hover");
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    for (std::size_t rotor = 0; rotor < 4; ++rotor) {
        const double speed =
            trace.mean(guidance::PerchingState::hovering,
                       [rotor](const Truth& truth) { return truth.rotor_speed_rad_s[rotor]; });
        EXPECT_NEAR(speed, 560.0, 5.6);
    }
}

TEST(Hover, StaysWhereItIs) {
    const Trace& trace = flown("hover");
    for (const Truth& truth : trace.truth) {
        ASSERT_LT((truth.base.p_WF_m - trace.truth.front().base.p_WF_m).norm(), 0.05);
    }
}

TEST(Hover, DrawsTheShaftPowerOfTheRotors) {
    // facts.md section 1: 334 W at the shafts; with 0.75 drive efficiency and 12 W of avionics
    const Trace& trace = flown("hover");
    const double power_W =
        trace.result.metrics.energy_flying_Wh * 3600.0 / trace.truth.back().time_s;
    EXPECT_NEAR(power_W, 334.0 / 0.75 + 12.0, 10.0);
}

TEST(Hover, FliesTheOtherVehicleToo) {
    const Trace trace = simulation::trace(model_of("hover", {"vehicle=iris"}));
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    EXPECT_LT((trace.truth.back().base.p_WF_m - trace.truth.front().base.p_WF_m).norm(), 0.1);
}

TEST(Hover, OnGpsBarometerAndCompassItDriftsButStays) {
    const Trace trace = simulation::trace(
        model_of("hover", {"autopilot.EKF2_EV_CTRL=0", "autopilot.EKF2_GPS_CTRL=7"}));
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    EXPECT_LT((trace.truth.back().base.p_WF_m - trace.truth.front().base.p_WF_m).norm(), 3.0);
}

}  // namespace
}  // namespace limpet::simulation
