// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/workers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "campaigns.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/folder_lock.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path fly_all(const Bench& bench, const Campaign& campaign, const std::string& folder,
                 int jobs) {
    fs::create_directories(bench.folder() / folder);
    Results results = begin_results(campaign, bench.folder() / folder, false);
    run_campaign(results, jobs);
    return bench.folder() / folder / Results::kFileName;
}

TEST(Workers, RowsDoNotDependOnTheirNumber) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(20));
    const auto one = table_of(fly_all(bench, campaign, "one", 1));
    ASSERT_EQ(one.size(), 20U);
    EXPECT_EQ(one, table_of(fly_all(bench, campaign, "two", 2)));
    EXPECT_EQ(one, table_of(fly_all(bench, campaign, "four", 4)));
    std::set<std::string> hashes;
    for (const auto& row : one) {
        hashes.insert(row.back());
    }
    EXPECT_EQ(hashes.size(), 20U);  // every run is another flight
    // Golden, as those of tests/simulation/golden_test.cpp.
    EXPECT_EQ(one.front().back(), "879d9c9c892b62a5");
    EXPECT_EQ(one.back().back(), "a5cc201d8d8abb6a");
}

/// Side by side with whom they fly, and how many lanes the machine has, changes nothing.
TEST(Workers, RowsAreThoseOfFlightsAlone) {
    const Bench bench;
    Campaign campaign = campaign_of(bench, R"(scenario: perch_concrete
runs: 11
parameters:
  simulation.start_offset_m: {normal: {mean: 0.1, sigma: 0.05, from: -0.3, to: 0.3}}
  vehicle.cup.mass_kg: {uniform: [0.07, 0.12]}
  sensors.mocap_latency_s: {uniform: [0.0, 0.02]}
)");
    const auto rows = table_of(fly_all(bench, campaign, "together", 1));
    ASSERT_EQ(rows.size(), 11U);
    for (std::uint32_t run = 0; run < rows.size(); ++run) {
        EXPECT_EQ(rows[run].back(), fly_run(campaign, run).state_hash) << run;
    }
}

TEST(Workers, ARunIsTheFlightOfItsScenarioSeedAndIndex) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(4));
    const RunRow row = fly_run(campaign, 3);
    const auto sample = draw(campaign.keys, campaign.seed, 3);
    EXPECT_EQ(row.sample, sample);
    EXPECT_EQ(std::get<std::string>(row.sample[1]), "iris");
    const scenario::Scenario scenario = scenario_of(campaign, sample);
    EXPECT_EQ(scenario.sensors.lidar_noise_m, std::get<double>(sample[0]));
    EXPECT_EQ(row.state_hash,
              hash_text(simulation::fly(simulation::build_model(scenario), {}, {}, 3).state_hash));
}

TEST(Workers, GoOnWhereTheyWereStopped) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(60));
    const auto whole = table_of(fly_all(bench, campaign, "whole", 2));
    Results results = begin_results(campaign, bench.folder(), false);
    std::atomic<bool> stop = false;
    const Progress first = run_campaign(
        results, 2,
        {.on_progress = [&](const Progress& p) { stop = p.finished >= 5; }, .stop = &stop});
    EXPECT_GE(first.finished, 5U);
    EXPECT_LT(first.finished, 60U);
    const Progress second = run_campaign(results, 2);
    EXPECT_EQ(second.finished, 60U);
    EXPECT_EQ(first.flown + second.flown, 60U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), whole);
}

TEST(Workers, FillGapsAndRepeatNothing) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(8));
    const auto whole = table_of(fly_all(bench, campaign, "whole", 1));
    Results results = begin_results(campaign, bench.folder(), false);
    results.add({fly_run(campaign, 0), fly_run(campaign, 2), fly_run(campaign, 5)});
    EXPECT_THAT(results.finished_runs(), testing::ElementsAre(0U, 2U, 5U));
    EXPECT_EQ(run_campaign(results, 1).flown, 5U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), whole);
}

TEST(Workers, ValuesThatDoNotFitEachOtherNameTheirRun) {
    const Bench bench;
    // Each alone is fine, with the other in its middle; the pair may cross.
    const Campaign campaign = campaign_of(
        bench, short_hovers(40,
                            "  guidance.land_pressure_Pa: {uniform: [80000, 88000]}\n"
                            "  guidance.detach_pressure_Pa: {uniform: [86000, 92000]}\n"));
    Results results = begin_results(campaign, bench.folder(), false);
    try {
        (void)run_campaign(results, 1);
        FAIL() << "no pair crossed";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("run "));
        EXPECT_THAT(error.what(), HasSubstr("land_pressure_Pa"));
    }
    const auto kept = results.finished_runs();
    EXPECT_TRUE(kept.empty() || kept.back() + 1 == kept.size());  // all before it
}

TEST(Workers, AFullDiskStopsThemAllAndLosesNothing) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(60));
    const auto whole = table_of(fly_all(bench, campaign, "whole", 2));
    Results results = begin_results(campaign, bench.folder(), false);
    results.database().exec("PRAGMA max_page_count = 1");  // no more than it has
    try {
        (void)run_campaign(results, 4);
        FAIL() << "60 rows went into the last page";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("full"));
    }
    EXPECT_LT(results.finished(), 60U);
    results.database().exec("PRAGMA max_page_count = 10000");
    EXPECT_EQ(run_campaign(results, 2).finished, 60U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), whole);
}

TEST(FolderLock, KeepsASecondOut) {
    const Bench bench;
    {
        const FolderLock lock(bench.folder());
        EXPECT_THROW(FolderLock{bench.folder()}, InputError);
    }
    EXPECT_NO_THROW(FolderLock{bench.folder()});
}

TEST(Summary, CountsWhatTheRowsSay) {
    const Bench bench;
    const Campaign campaign =
        campaign_of(bench,
                    "scenario: perch_concrete\nrepeats: 10\nparameters:\n"
                    "  guidance.dock_speed_m_s: {grid: [0.2, 0.4, 0.6, 0.8]}\n"
                    "  wall.surface: {choice: [metal, porous_concrete]}\n");
    ASSERT_EQ(campaign.runs, 40U);
    Results results = begin_results(campaign, bench.folder(), false);
    std::vector<RunRow> rows;
    for (std::uint32_t run = 0; run < 40; ++run) {
        RunRow& row = rows.emplace_back();
        row.run = run;
        row.sample = draw(campaign.keys, 1, run);
        const std::uint32_t successes[] = {0, 2, 8, 10};
        const bool success = run / 4 < successes[run % 4];
        row.outcome = success ? "released" : run % 8 == 0 ? "crashed" : "failed_to_seal";
        row.reason = success ? "done" : "why";
        row.true_end = "hovering";
        row.metrics.impact_speed_m_s = run;
    }
    results.add(rows);
    const CampaignSummary summary = summarise(results);
    EXPECT_EQ(summary.success.successes, 20U);
    EXPECT_EQ(summary.success.runs, 40U);
    ASSERT_EQ(summary.keys.size(), 2U);
    const KeySummary& speed = summary.keys[0];
    ASSERT_EQ(speed.groups.size(), 4U);
    EXPECT_EQ(speed.groups[1].proportion.successes, 2U);
    EXPECT_EQ(speed.groups[2].proportion.runs, 10U);
    ASSERT_TRUE(speed.fit);
    EXPECT_NEAR(speed.fit->half, 0.5, 0.01);  // the data is symmetric about it
    EXPECT_EQ(summary.keys[1].groups[0].proportion.runs + summary.keys[1].groups[1].proportion.runs,
              40U);
    ASSERT_EQ(summary.failures.size(), 2U);
    EXPECT_EQ(summary.failures[0].proportion.successes + summary.failures[1].proportion.successes,
              20U);
    EXPECT_EQ(summary.metrics.front().name, "impact_speed_m_s");
    EXPECT_DOUBLE_EQ(summary.metrics.front().median, 19.5);
    const auto files = draw_summary(summary, bench.folder());
    ASSERT_EQ(files.size(), 2U);
    EXPECT_GT(fs::file_size(files[0]), 10'000U);
    EXPECT_THAT(text_of(files[1]), HasSubstr("dock speed  [m/s], guidance"));
}

}  // namespace
}  // namespace limpet::campaign
