// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../campaign/campaigns.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/rare/rare.hpp"

namespace limpet::rare {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Hovers that are cut off at a time that is drawn: how probable a late one is, is known.
constexpr const char* kHovers =
    "description: short hovers\n"
    "scenario: hover\n"
    "success: [timed_out]\n"
    "seed: 3\n"
    "runs: 10\n"
    "parameters:\n"
    "  simulation.time_limit_s: {normal: {mean: 0.3, sigma: 0.04, from: 0.1, to: 0.6}}\n"
    "  vehicle: {choice: [perching_uav, iris]}\n";

RareSearch long_hovers(std::uint32_t level_runs = 100,
                       const std::string& event = "simulated_s>0.38") {
    return {.event = parse_rare_event(event), .level_runs = level_runs};
}

campaign::Results begun(const campaign::Campaign& campaign, const fs::path& folder,
                        const RareSearch& search) {
    fs::create_directories(folder);
    campaign::Results results = begin_results(campaign, folder, false);
    begin_rare(results, search, {});
    return results;
}

std::vector<std::vector<std::string>> rare_rows(campaign::Results& results) {
    std::vector<std::vector<std::string>> rows;
    SQLite::Statement select(results.database(), "SELECT * FROM rare_runs ORDER BY run");
    while (select.executeStep()) {
        auto& row = rows.emplace_back();
        for (int i = 0; i < select.getColumnCount(); ++i) {
            row.push_back(select.getColumn(i).getString());
        }
    }
    return rows;
}

/// The flight ends with the tick in which its time is over: 4 ms, a tenth of a sigma.
TEST(RareCampaign, FlightsFindTheProbabilityThatIsKnown) {
    const Bench bench;
    const RareSearch search = long_hovers(200, "simulated_s>0.42");
    campaign::Results results =
        begun(campaign::campaign_of(bench, kHovers), bench.folder(), search);
    const RareFlown flown = fly_rare(results, search, 2);
    ASSERT_EQ(flown.result.ending, RareEnding::estimated);
    EXPECT_LT(flown.result.interval().low, normal_probability(-2.9));   // 1.9e-3
    EXPECT_GT(flown.result.interval().high, normal_probability(-3.1));  // 1.0e-3
    EXPECT_LT(flown.result.variation2(), 0.7);
    EXPECT_EQ(flown.flown, results.finished());
    EXPECT_EQ(flown.flown, flown.result.runs);
    EXPECT_EQ(rare_rows(results).size(), flown.flown);
}

TEST(RareCampaign, DoesNotDependOnTheNumberOfWorkersAndIsDrawn) {
    const Bench bench;
    const campaign::Campaign campaign = campaign::campaign_of(bench, kHovers);
    campaign::Results one = begun(campaign, bench.folder() / "one", long_hovers());
    campaign::Results three = begun(campaign, bench.folder() / "three", long_hovers());
    const RareFlown first = fly_rare(one, long_hovers(), 1);
    const RareFlown second = fly_rare(three, long_hovers(), 3);
    EXPECT_EQ(first.result.probability(), second.result.probability());
    EXPECT_EQ(campaign::table_of(bench.folder() / "one/results.sqlite"),
              campaign::table_of(bench.folder() / "three/results.sqlite"));
    EXPECT_EQ(rare_rows(one), rare_rows(three));
    EXPECT_TRUE(draw_rare(summarise_rare(one, *rare_search(one), {}), bench.folder()).empty());
    const auto files = draw_rare(summarise_rare(one, *rare_search(one)), bench.folder());
    ASSERT_EQ(files.size(), 2U);
    EXPECT_THAT(text_of(files[1]), HasSubstr("simulated_s"));
    // The rows alone tell the same.
    EXPECT_EQ(rare_json(summarise_rare(one, *rare_search(one))),
              rare_json(summarise_rare(one, long_hovers(), first.result)));
}

TEST(RareCampaign, GoesOnWhereItWasStopped) {
    const Bench bench;
    const campaign::Campaign campaign = campaign::campaign_of(bench, kHovers);
    campaign::Results whole = begun(campaign, bench.folder() / "whole", long_hovers());
    (void)fly_rare(whole, long_hovers(), 2);
    campaign::Results cut = begun(campaign, bench.folder() / "cut", long_hovers());
    std::atomic<bool> stop = false;
    const RareFlown first = fly_rare(
        cut, long_hovers(), 2,
        {.on_progress = [&](const RareProgress& p) { stop = p.flown >= 130; }, .stop = &stop});
    EXPECT_EQ(first.result.ending, RareEnding::stopped);
    EXPECT_EQ(summarise_rare(cut, long_hovers()).result.levels.size(), 1U);
    // A kill between the two rows of a run leaves that of rare_runs alone.
    cut.database().exec("DELETE FROM runs WHERE run = 120");
    begin_rare(cut, long_hovers(), {});
    const RareFlown second = fly_rare(cut, long_hovers(), 1);
    EXPECT_EQ(first.flown + second.flown, whole.finished() + 1);
    EXPECT_EQ(campaign::table_of(bench.folder() / "cut/results.sqlite"),
              campaign::table_of(bench.folder() / "whole/results.sqlite"));
    EXPECT_EQ(rare_rows(cut), rare_rows(whole));
}

TEST(RareCampaign, RefusesResultsOfSomethingElse) {
    const Bench bench;
    const campaign::Campaign campaign = campaign::campaign_of(bench, kHovers);
    campaign::Results results = begun(campaign, bench.folder(), long_hovers());
    const auto refusal = [](const auto& act) -> std::string {
        try {
            act();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const RareSearch other{.event = parse_rare_event("attempts>1"), .level_runs = 100};
    EXPECT_THAT(refusal([&] { begin_rare(results, other, {}); }), HasSubstr("simulated_s>0.38"));
    EXPECT_THAT(refusal([&] { begin_rare(results, long_hovers(200), {}); }),
                HasSubstr("100 runs a level"));
    EXPECT_THAT(refusal([&] { require_plain(results); }), HasSubstr("--rare"));
    campaign::RunRow row = fly_run(campaign, 0);
    results.add({row});
    EXPECT_THAT(refusal([&] { (void)fly_rare(results, long_hovers(), 1); }),
                HasSubstr("run 0 is not the one"));
    fs::create_directories(bench.folder() / "plain");
    campaign::Results plain = begin_results(campaign, bench.folder() / "plain", false);
    plain.add({row});
    EXPECT_THAT(refusal([&] { begin_rare(plain, long_hovers(), {}); }),
                HasSubstr("a campaign without --rare"));
}

TEST(RareCampaign, ARunIsTheFlightOfItsSampleAndNoise) {
    const Bench bench;
    const campaign::Campaign campaign = campaign::campaign_of(bench, kHovers);
    campaign::Results results = begun(campaign, bench.folder(), long_hovers());
    (void)fly_rare(results, long_hovers(), 2);
    const campaign::RunRow row = results.row(100);  // the first of the second level
    const NoiseBlend noise = rare_noise(results, row.run);
    EXPECT_GT(noise.size(), 1U);  // a proposal beside another run
    const std::string yaml = to_yaml(campaign::scenario_of(campaign, row.sample, noise));
    const auto model = simulation::build_model(scenario::load_scenario_text(
        yaml, "again", {.overrides = {}, .seed = {}, .data_root = "."}));
    EXPECT_EQ(campaign::hash_text(simulation::fly(model).state_hash), row.state_hash);
    EXPECT_EQ(campaign::hash_text(replay_run(results, row.run, bench.folder() / "flight.mcap", {},
                                             rare_noise(results, row.run))
                                      .state_hash),
              row.state_hash);
}

TEST(RareCampaign, AllThatVariesIsDrawnAndCanBeFlownFarOut) {
    const Bench bench;
    const auto refusal = [&](const std::string& keys) -> std::string {
        try {
            require_searchable(
                campaign::campaign_of(bench, "scenario: hover\nruns: 4\nparameters:\n" + keys));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal("  simulation.hover_s: {uniform: [1, 2]}\n  vehicle: {grid: [iris]}\n"), "");
    EXPECT_THAT(refusal("  vehicle: {grid: [iris, perching_uav]}\n"),
                testing::AllOf(HasSubstr("x.yaml:4: parameters.vehicle: a grid has no"),
                               HasSubstr("choice")));
    EXPECT_THAT(refusal("  simulation.hover_s: {normal: {mean: 2, sigma: 0.4}}\n"),
                testing::AllOf(HasSubstr("x.yaml:4: parameters.simulation.hover_s"),
                               HasSubstr("6 sigma"), HasSubstr("from and to")));
}

/// Where a normal stands in a spread: the inverse of its distribution.
TEST(SampleAt, IsTheInverseOfTheDistribution) {
    campaign::VariedKey key;
    key.spread = campaign::Spread::uniform;
    key.first = 2.0;
    key.second = 4.0;
    const auto at = [&key](double normal) {
        return std::get<double>(campaign::sample_at({key}, {normal}).front());
    };
    EXPECT_DOUBLE_EQ(at(0.0), 3.0);
    EXPECT_NEAR(at(1.0), 2.0 + 2.0 * 0.841344746, 1e-8);
    key.spread = campaign::Spread::normal;
    EXPECT_DOUBLE_EQ(at(1.5), 2.0 + 4.0 * 1.5);
    key.spread = campaign::Spread::lognormal;
    EXPECT_DOUBLE_EQ(at(0.5), 2.0 * std::exp(4.0 * 0.5));
    key.spread = campaign::Spread::normal;
    key.from = 4.0;  // half a sigma out: what is left is shared out
    key.to = 1e300;
    const double left = normal_probability(-0.5);
    for (const double normal : {-5.0, -1.0, 0.0, 2.0, 5.0}) {
        EXPECT_GE(at(normal), 4.0);
        EXPECT_NEAR(normal_probability(-(at(normal) - 2.0) / 4.0) / left,
                    normal_probability(-normal), 1e-9 + 1e-6 * normal_probability(-normal));
    }
}

}  // namespace
}  // namespace limpet::rare
