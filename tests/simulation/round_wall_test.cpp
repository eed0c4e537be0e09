// SPDX-License-Identifier: Apache-2.0
#include "flown.hpp"

namespace limpet::simulation {
namespace {

// A flight knows of the wall what is under a point of it, so it perches on one that bends.

const std::string kRound = "wall.shape=cylinder";

TEST(RoundWall, HoldsTheWholeFlight) {
    const FlightResult round = fly(model_of("perch_concrete", {kRound, "wall.radius_m=5"}));
    const FlightResult& flat = flown("perch_concrete").result;
    EXPECT_EQ(round.outcome, Outcome::released) << round.reason;
    EXPECT_EQ(round.attempts, 1);
    // The legs, 0.15 m left and right of the cup, find the wall 0.15^2 / (2 5 m) further away, at a
    // lever of 0.567 m.
    EXPECT_NEAR(round.metrics.perched_pitch_deg - flat.metrics.perched_pitch_deg,
                degrees(2.25e-3 / 0.567), 0.02);
    EXPECT_NEAR(round.metrics.cup_pull_max_N, flat.metrics.cup_pull_max_N,
                0.1 * flat.metrics.cup_pull_max_N);
}

TEST(RoundWall, IsMetSquareToTheSpotAhead) {
    const FlightResult beside =
        fly(model_of("perch_concrete", {kRound, "wall.radius_m=2", "wall.heading_deg=60",
                                        "simulation.start_offset_m=0.6"}));
    EXPECT_EQ(beside.outcome, Outcome::released) << beside.reason;
    EXPECT_LT(beside.metrics.alignment_at_approach_deg, 2.0);
}

TEST(RoundWall, OfAnEndlessRadiusIsFlat) {
    const std::string smooth = "sensors.lidar_resolution_m=0";  // no steps that a micrometre flips
    const FlightResult round =
        fly(model_of("perch_concrete", {kRound, "wall.radius_m=1e4", smooth}));
    const FlightResult flat = fly(model_of("perch_concrete", {smooth}));
    for (const MetricInfo& metric : metric_table()) {
        const double expected = flat.metrics.*metric.field;
        EXPECT_NEAR(round.metrics.*metric.field, expected, 2e-2 * std::abs(expected) + 1e-2)
            << metric.name;
    }
}

/// Rigs start where the lip meets the wall on the line of travel, found on any shape.
TEST(RoundWall, IsMetByTheMountsWhereItIs) {
    for (const char* trial : {"pendulum_concrete", "press_concrete"}) {
        const auto model = model_of(trial, {kRound, "wall.radius_m=2", "wall.lean_deg=3"});
        const Vector3 lip_W_m =
            touching_p_WB_m(*model->scenario) + scenario::attitude(model->scenario->start) *
                                                    vehicle::lip_p_B_m(model->scenario->airframe);
        EXPECT_NEAR(before_wall_m(model->cup.wall, lip_W_m), 0.0, 1e-9);
    }
    EXPECT_EQ(fly(model_of("pendulum_concrete", {kRound, "wall.radius_m=2"})).outcome,
              Outcome::perched);
}

/// Rounder than the lip follows: pressed and straight, it does not seal; a cup whose maker tells a
/// smaller radius does.
TEST(RoundWall, RounderThanTheLipFollowsDoesNotSeal) {
    const std::vector<std::string> post = {kRound, "wall.radius_m=0.15"};
    const FlightResult result = fly(model_of("press_concrete", post));
    EXPECT_EQ(result.outcome, Outcome::failed_to_seal);
    EXPECT_EQ(result.reason, "the wall is rounder than the lip follows");
    std::vector<std::string> small = post;
    small.emplace_back("suction.least_radius_m=0.1");
    EXPECT_EQ(fly(model_of("press_concrete", small)).outcome, Outcome::released);
}

}  // namespace
}  // namespace limpet::simulation
