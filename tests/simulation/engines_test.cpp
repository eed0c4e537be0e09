// SPDX-License-Identifier: Apache-2.0
//
// The same flight on every engine: what they agree on is no artefact of one.
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

Trace on(const plant::Engine& engine, const std::string& scenario) {
    return trace(model_of(
        scenario, {"simulation.engine=" + std::string(engine.name), "simulation.step_s=0.00025"}));
}

class EveryEngineFlies : public testing::TestWithParam<const char*> {};

TEST_P(EveryEngineFlies, TheSameFlight) {
    const Trace reduced = on(plant::kReducedEngine, GetParam());
    const Trace mujoco = on(plant::kMujocoEngine, GetParam());
    EXPECT_EQ(reduced.result.outcome, mujoco.result.outcome);
    ASSERT_EQ(reduced.result.events.size(), mujoco.result.events.size());
    for (std::size_t i = 0; i < reduced.result.events.size(); ++i) {
        const Event& event = reduced.result.events[i];
        EXPECT_EQ(event.name, mujoco.result.events[i].name);
        EXPECT_NEAR(event.time_s, mujoco.result.events[i].time_s, 0.021) << to_string(event.name);
    }
    const Metrics& ours = reduced.result.metrics;
    const Metrics& theirs = mujoco.result.metrics;
    const auto alike = [](double a, double b, double share) {
        EXPECT_EQ(std::isfinite(a), std::isfinite(b));
        if (std::isfinite(a)) {
            EXPECT_NEAR(a, b, share * std::abs(b));
        }
    };
    alike(ours.impact_force_N, theirs.impact_force_N, 1e-4);
    alike(ours.cup_press_max_N, theirs.cup_press_max_N, 1e-4);
    alike(ours.cup_pull_max_N, theirs.cup_pull_max_N, 2e-3);
    alike(ours.pressure_min_Pa, theirs.pressure_min_Pa, 1e-6);
    alike(ours.perched_pitch_deg, theirs.perched_pitch_deg, 2e-4);
    alike(ours.energy_flying_Wh, theirs.energy_flying_Wh, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryEngineFlies,
                         testing::Values("perch_concrete", "perch_metal", "perch_metal_valve",
                                         "failed_perch", "pendulum_concrete", "press_concrete",
                                         "hover", "perch_payload"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace limpet::simulation
