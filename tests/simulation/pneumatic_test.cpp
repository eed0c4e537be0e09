// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

using enum EventName;

Trace pneumatic(const std::string& scenario, std::vector<std::string> overrides = {}) {
    overrides.emplace_back("suction.pressure_model=pneumatic");
    return trace(model_of(scenario, overrides));
}

TEST(PneumaticFlight, PerchesOnConcreteAndReleasesInAboutASecond) {
    const Trace flight = pneumatic("perch_concrete");
    EXPECT_EQ(flight.result.outcome, Outcome::released);
    EXPECT_NEAR(flight.first(detached) - flight.first(pump_off), 1.0, 0.35);
    EXPECT_NEAR(flight.result.metrics.pressure_min_Pa, 65000.0, 2000.0);
}

TEST(PneumaticFlight, MetalStillHoldsAfterSixteenSecondsAndThePumpRests) {
    const Trace flight = pneumatic("perch_metal");
    EXPECT_EQ(flight.result.outcome, Outcome::release_aborted);
    EXPECT_NEAR(flight.first(aborted) - flight.first(pump_off), 16.0, 0.05);
    EXPECT_NEAR(flight.result.metrics.pressure_at_release_end_Pa, 74200.0, 1500.0);
    const double share = flight.mean(guidance::PerchingState::resting, [](const Truth& truth) {
        return truth.cup_status.pump_running ? 1.0 : 0.0;
    });
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 0.8);
}

TEST(PneumaticFlight, AValveLetsGoAtOnce) {
    const Trace flight = pneumatic("perch_metal_valve");
    EXPECT_EQ(flight.result.outcome, Outcome::released);
    EXPECT_LT(flight.first(detached) - flight.first(pump_off), 0.5);
}

TEST(PneumaticFlight, APartialSealOrABlockedHoseIsNoPerch) {
    for (const char* fault : {"suction.partial_seal_area_mm2=4", "suction.hose_bore_mm=0"}) {
        const Trace flight = pneumatic("perch_concrete", {fault});
        EXPECT_EQ(flight.result.outcome, Outcome::failed_to_seal) << fault;
        EXPECT_TRUE(flight.times(perched).empty()) << fault;
    }
}

TEST(PneumaticFlight, ItsRowsMoveNothingWhileItIsOff) {
    const auto rows = model_of("perch_concrete",
                               {"suction.pump_speed_L_min=1", "suction.partial_seal_area_mm2=4"});
    EXPECT_EQ(trace(rows).result.state_hash, flown("perch_concrete").result.state_hash);
}

TEST(SealWearInTheLoop, ACreepingSealLetsTheRestingVacuumFade) {
    const Trace flight = trace(model_of("perch_metal_valve", {"suction.seal_creep_1_s=0.5"}));
    EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
    const auto resting_Pa = [](const Trace& trace) {
        return trace.mean(guidance::PerchingState::resting,
                          [](const Truth& truth) { return truth.cup_status.pressure_Pa; });
    };
    EXPECT_GT(resting_Pa(flight), resting_Pa(flown("perch_metal_valve")) + 2000.0);
}

}  // namespace
}  // namespace limpet::simulation
