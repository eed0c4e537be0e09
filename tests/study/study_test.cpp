// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../campaign/campaigns.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"

namespace limpet::study {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Hovers that are cut off at a time that is drawn: that alone decides how long one lasts.
constexpr const char* kHovers =
    "description: short hovers\n"
    "scenario: hover\n"
    "success: [timed_out]\n"
    "seed: 3\n"
    "runs: 10\n"
    "parameters:\n"
    "  simulation.time_limit_s: {uniform: [0.2, 0.4]}\n"
    "  sensors.lidar_noise_m: {uniform: [0.002, 0.02]}\n";

campaign::Results begun(const campaign::Campaign& campaign, const fs::path& folder,
                        const StudyRequest& asked) {
    fs::create_directories(folder);
    campaign::Results results = begin_results(campaign, folder, true);
    begin_study(results, asked);
    return results;
}

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

TEST(Study, WhatDecidesANumberHasAllOfItsVariance) {
    const Bench bench;
    campaign::Results results = begun(campaign::campaign_of(bench, kHovers), bench.folder(),
                                      {.figure = "simulated_s", .samples = 64});
    EXPECT_EQ(fly_study(results, 2).flown, 64U * 5U);
    const StudyFound found = find_study(results);
    EXPECT_EQ(found.used, 64U);
    ASSERT_EQ(found.inputs.size(), 3U);
    EXPECT_EQ(found.inputs[0].key, "simulation.time_limit_s");
    EXPECT_GT(found.inputs[0].index.first, 0.99);
    EXPECT_GT(found.inputs[0].index.total, 0.9);
    EXPECT_LT(found.inputs[1].index.total, 1e-6);
    EXPECT_EQ(found.inputs[2].key, "noise");
    EXPECT_LT(found.inputs[2].index.total, 1e-6);
    EXPECT_NEAR(found.mean(), 0.3, 0.03);
    EXPECT_THAT(study_text(found), HasSubstr("simulation.time_limit_s"));

    // Another number of the same flights: no flight more.
    begin_study(results, {.figure = "simulated_s>0.35", .samples = 64});
    EXPECT_EQ(fly_study(results, 1).flown, 0U);
    const StudyFound late = find_study(results);
    EXPECT_EQ(late.events.runs, 128U);
    EXPECT_LT(late.events.interval().low, 0.25);
    EXPECT_GT(late.events.interval().high, 0.25);
    EXPECT_FALSE(draw_study(late, bench.folder()).empty());
}

/// In a hover of half a second only the noise tilts the vehicle; nothing that is drawn does.
TEST(Study, TheFlightsOwnNoiseIsAnInput) {
    const Bench bench;
    campaign::Results results =
        begun(campaign::campaign_of(bench,
                                    "scenario: pendulum_concrete\n"
                                    "overrides: [wall.surface.seal_threshold_sigma=0.6]\n"
                                    "runs: 10\n"
                                    "parameters:\n"
                                    "  vehicle.battery.avionics_power_W: {uniform: [10, 12]}"
                                    "\n"),
              bench.folder(), {.figure = "perched", .samples = 64});
    (void)fly_study(results, 2);
    const StudyFound found = find_study(results);
    ASSERT_EQ(found.inputs.size(), 2U);
    EXPECT_GT(found.inputs[1].index.first, 0.9);  // whether the spot seals
    EXPECT_LT(found.inputs[0].index.total, 0.05);
}

TEST(Study, DoesNotDependOnTheNumberOfWorkersAndGoesOn) {
    const Bench bench;
    const campaign::Campaign campaign = campaign::campaign_of(bench, kHovers);
    const StudyRequest asked{.figure = "simulated_s", .samples = 20};
    campaign::Results one = begun(campaign, bench.folder() / "one", asked);
    campaign::Results three = begun(campaign, bench.folder() / "three", asked);
    (void)fly_study(one, 1);
    std::atomic<bool> stop = false;
    (void)fly_study(
        three, 3,
        {.on_progress = [&](const auto& so_far) { stop = so_far.flown >= 30; }, .stop = &stop});
    EXPECT_LT(three.finished(), 100U);
    (void)fly_study(three, 3);
    EXPECT_EQ(campaign::table_of(bench.folder() / "one/results.sqlite"),
              campaign::table_of(bench.folder() / "three/results.sqlite"));
    const campaign::RunRow row = one.row(87);
    EXPECT_EQ(campaign::hash_text(
                  replay_run(one, 87, bench.folder() / "again.mcap", {}, *study_noise(one, 87))
                      .state_hash),
              row.state_hash);
}

TEST(Study, RefusesWhatIsNoneInALine) {
    const Bench bench;
    EXPECT_THAT(refusal([] { (void)parse_figure("impact_sped_m_s"); }),
                HasSubstr("--of impact_sped_m_s: is no outcome and no metric, did you mean"));
    EXPECT_THAT(refusal([] { (void)parse_figure("simulated_s<x"); }), HasSubstr("is not a number"));
    const campaign::Campaign grid = campaign::campaign_of(
        bench, "scenario: hover\nparameters:\n  vehicle: {grid: [perching_uav, iris]}\n");
    EXPECT_THAT(refusal([&] { require_drawn(grid); }), HasSubstr("a grid has no probabilities"));
    const campaign::Campaign none = campaign::campaign_of(bench, "scenario: hover\nruns: 3\n");
    EXPECT_THAT(refusal([&] { require_drawn(none); }), HasSubstr("nothing is drawn"));
    campaign::Results results =
        begun(campaign::campaign_of(bench, kHovers), bench.folder() / "study",
              {.figure = "simulated_s", .samples = 20});
    EXPECT_THAT(refusal([&] { require_no_study(results); }), HasSubstr("holds a study of"));
    EXPECT_THAT(refusal([&] { begin_study(results, {.figure = "simulated_s", .samples = 21}); }),
                HasSubstr("was begun with --samples 20"));
}

}  // namespace
}  // namespace limpet::study
