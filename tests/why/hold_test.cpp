// SPDX-License-Identifier: Apache-2.0
#include "limpet/why/hold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

struct Watched {
    simulation::FlightResult result;
    std::vector<Hold> holds;
    HoldTrace trace;
};

Watched watched(const std::string& scenario, const std::vector<std::string>& overrides = {}) {
    HoldWatch watch(true);
    simulation::FlightWatch on;
    on.on_tick = [&](simulation::Flight& flight, const guidance::EventList& events) {
        watch.tick(flight, events);
    };
    const auto model =
        simulation::build_model(scenario::load_scenario(scenario, {.overrides = overrides}));
    Watched seen;
    seen.result = simulation::fly(model, {}, on);
    seen.holds = watch.holds();
    seen.trace = watch.trace();
    return seen;
}

const std::string kSteel = std::string(LIMPET_SOURCE_DIR) + "/tests/data/steel12/steel12.yaml";

TEST(Holds, AGoodPerchIsOneThatIsLetGoOnPurpose) {
    const Watched seen = watched("perch_concrete");
    ASSERT_EQ(seen.holds.size(), 1U);
    const Hold& hold = seen.holds.front();
    EXPECT_TRUE(hold.on_purpose);
    EXPECT_EQ(hold.phase, "backing_off");
    EXPECT_GT(hold.pitch_deg, 60.0);
    EXPECT_NEAR(hold.ended_s - hold.sealed_s, 22.7, 1.0);
    // No finer than a tick: the metrics look at every sub-step.
    EXPECT_GE(hold.margin_N, seen.result.metrics.cup_margin_min_N - 1e-9);
}

TEST(Holds, WhatPeelsOffIsAtItsLimitThen) {
    const Watched seen = watched(kSteel);
    const auto attached = std::count_if(seen.holds.begin(), seen.holds.end(), [](const Hold& hold) {
        return !std::isnan(hold.attached_s);
    });
    EXPECT_EQ(attached, 3);
    for (const Hold& hold : seen.holds) {
        if (std::isnan(hold.attached_s)) {
            continue;
        }
        EXPECT_EQ(hold.let_go, "peeled off");
        EXPECT_FALSE(hold.on_purpose);
        EXPECT_EQ(hold.phase, "holding");
        EXPECT_NEAR(hold.ended_s - hold.attached_s, 0.112, 0.01);
        EXPECT_GE(hold.loads.peel_N_m, hold.loads.peel_most_N_m);
    }
}

/// A joint that is bent hands its spring's moment on to the lip.
TEST(Holds, ThePeelIsTheSpringsWhereTheJointIsBent) {
    const Watched seen = watched(kSteel, {"vehicle.slider.damping_N_s_m=40"});
    const Hold* hold = nullptr;
    for (const Hold& one : seen.holds) {
        hold = one.phase == "pitching_up" ? &one : hold;
    }
    ASSERT_NE(hold, nullptr);
    EXPECT_EQ(hold->let_go, "peeled off");
    EXPECT_NEAR(hold->pitch_deg, 45.0, 3.0);
    EXPECT_NEAR(hold->peel.bent_deg, hold->pitch_deg, 5.0);
    EXPECT_NEAR(hold->peel.spring_N_m, 0.3 * radians(hold->peel.bent_deg), 1e-9);
    // Spring and lever together are what peels, within what the cup's weight adds.
    EXPECT_NEAR(hold->loads.peel_N_m, hold->peel.spring_N_m + hold->peel.lever_N_m,
                0.15 * hold->loads.peel_N_m);
    EXPECT_NEAR(hold->loads.peel_N_m, hold->loads.peel_most_N_m, 0.05 * hold->loads.peel_most_N_m);
}

TEST(Holds, TheTraceBreaksWhereTheCupIsOff) {
    const Watched seen = watched(kSteel);
    const auto& pitch_deg = seen.trace.pitch_deg;
    const auto breaks = std::count_if(pitch_deg.begin(), pitch_deg.end(),
                                      [](double value) { return std::isnan(value); });
    EXPECT_GE(breaks, 3);
    EXPECT_TRUE(std::is_sorted(seen.trace.time_s.begin(), seen.trace.time_s.end()));
}

}  // namespace
}  // namespace limpet::why
