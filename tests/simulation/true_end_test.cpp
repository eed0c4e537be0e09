// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/true_end.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

using testing::HasSubstr;

FlightResult ended_with(const char* scenario, const std::string& fault) {
    return fly(model_of(scenario, {"faults={" + fault + "}"}));
}

/// Guidance's own end, and what a tick-by-tick flight had seen by then.
struct GuidedEnd {
    double time_s = kNaN;
    std::uint64_t hash = 0;
};
GuidedEnd guided_end(const std::shared_ptr<const FlightModel>& model) {
    Flight flight(model);
    while (!flight.ended() && !flight.state().guidance.ending) {
        (void)flight.tick();
    }
    return {seconds(flight.state().tick), flight.seen().hash};
}

TEST(TrueEnds, AFlightThatEndedWellEndsWhereItDid) {
    for (const char* scenario : {"perch_concrete", "perch_metal_valve", "hover", "failed_perch"}) {
        const auto model = model_of(scenario);
        const FlightResult result = fly(model);
        const GuidedEnd guided = guided_end(model);
        EXPECT_EQ(result.performance.simulated_s, guided.time_s) << scenario;
        EXPECT_EQ(result.state_hash, guided.hash) << scenario;
        EXPECT_EQ(result.true_end, TrueEnd::hovering) << scenario;
        EXPECT_TRUE(bears_out(result.true_end, result.outcome)) << scenario;
        EXPECT_LT(result.metrics.off_place_m, 0.15) << scenario;
    }
}

TEST(TrueEnds, AtRestItIsOnTheWall) {
    const FlightResult result = fly(model_of("perch_metal"));  // its release takes too long
    EXPECT_EQ(result.outcome, Outcome::release_aborted);
    EXPECT_EQ(result.true_end, TrueEnd::on_wall);
    EXPECT_TRUE(bears_out(result.true_end, result.outcome));
    EXPECT_TRUE(std::isnan(result.metrics.off_place_m));
}

/// Guidance gives up at 0.1 s, with no rotor turning.
TEST(TrueEnds, AFallThatGuidanceEndedIsACrash) {
    const FlightResult result =
        ended_with("perch_concrete", "fault: battery_empty, phase: pre_positioning");
    EXPECT_EQ(result.outcome, Outcome::crashed);
    EXPECT_EQ(result.reason, "hit the ground; guidance had ended: battery low");
    EXPECT_EQ(result.true_end, TrueEnd::fallen);
}

/// Its estimate drifts, and guidance stands at the pre-position by that.
TEST(TrueEnds, ReleasedMetresAwayIsNoSuccess) {
    const FlightResult result =
        ended_with("perch_concrete", "fault: estimate_drifts, phase: resting");
    ASSERT_EQ(result.outcome, Outcome::released) << result.reason;
    EXPECT_NE(result.true_end, TrueEnd::hovering);
    EXPECT_GT(result.metrics.off_place_m, 2.0);
    EXPECT_FALSE(is_success(result.outcome, result.true_end));
}

TEST(TrueEnds, WhatIsSavedInBetweenEndsAlike) {
    const auto model =
        model_of("perch_concrete", {"faults={fault: battery_empty, phase: pre_positioning}"});
    Flight flight(model);
    while (!flight.state().guidance.ending) {
        (void)flight.tick();
    }
    ASSERT_FALSE(flight.ended());
    Flight other(model);
    other.restore(snapshot_from(to_bytes(flight.save())));
    for (Flight* each : {&flight, &other}) {
        while (!each->ended()) {
            (void)each->tick();
        }
    }
    EXPECT_EQ(other.state().ending->reason.view(), flight.state().ending->reason.view());
    EXPECT_EQ(other.seen().hash, flight.seen().hash);
    EXPECT_THAT(std::string(other.state().ending->reason.view()), HasSubstr("hit the ground"));
}

/// What hovers on goes on for as long as it takes to see that it does, and no longer.
TEST(TrueEnds, AHoverIsLookedAtForHalfASecond) {
    const FlightResult result = fly(model_of("hover", {"simulation.hover_s=0.1"}));
    EXPECT_EQ(result.outcome, Outcome::released);
    EXPECT_EQ(result.true_end, TrueEnd::hovering);
    EXPECT_NEAR(result.performance.simulated_s, kStill_s, 0.01);
}

TEST(TrueEnds, WhereItBelongsIsThePrePositionByTheTrueWall) {
    const auto model = model_of("perch_concrete");
    const Vector3 place_W_m = simulation::place_W_m(*model);
    const Vector3 nose_W_m = place_W_m + Vector3(model->guidance.lidar_x_m, 0.0, 0.0);
    EXPECT_NEAR(before_wall_m(model->cup.wall, nose_W_m), model->guidance.pre_distance_m, 1e-9);
    EXPECT_EQ(place_W_m.z(), model->start.p_WB_m.z());
    const auto hover = model_of("hover");
    EXPECT_EQ(simulation::place_W_m(*hover), hover->start.p_WB_m);
}

}  // namespace
}  // namespace limpet::simulation
