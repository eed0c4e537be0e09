// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "campaigns.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/campaign/workers.hpp"

namespace limpet::campaign {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An estimate that drifts on the wall: guidance stands at the pre-position by it, metres away.
/// Rotors that stop in the air: guidance gives up, and it falls.
constexpr const char* kUnsafe =
    "description: ends that guidance does not see\n"
    "scenario: perch_concrete\n"
    "overrides:\n"
    "  - \"faults={fault: none, phase: hovering}\"\n"
    "success: [released, perched, release_aborted, aborted, failed_to_seal]\n"
    "repeats: 1\n"
    "parameters:\n"
    "  faults.fault: {grid: [none, estimate_drifts, battery_empty]}\n"
    "  faults.phase: {grid: [pre_positioning, resting]}\n";

TEST(Success, NeedsTheTruthInRowsDatabaseSummaryAndPage) {
    const Bench bench;
    const auto file = bench.write("unsafe.yaml", kUnsafe);
    const Campaign campaign = load_campaign(file.string());
    Results results = begin_results(campaign, bench.folder(), false);
    (void)run_campaign(results, 2);
    std::uint32_t successes = 0;
    for (std::uint32_t run = 0; run < campaign.runs; ++run) {
        const RunRow row = results.row(run);
        const bool drifts = std::get<std::string>(row.sample[0]) == "estimate_drifts";
        const bool empty = std::get<std::string>(row.sample[0]) == "battery_empty";
        const bool resting = std::get<std::string>(row.sample[1]) == "resting";
        successes += is_success(campaign, row) ? 1U : 0U;
        if (drifts && resting) {
            EXPECT_EQ(row.outcome, "released");
            EXPECT_GT(row.metrics.off_place_m, 2.0);
            EXPECT_FALSE(is_success(campaign, row)) << row.true_end;
            EXPECT_FALSE(ended_as(row, Outcome::released));
        } else if (empty && !resting) {
            EXPECT_EQ(row.outcome, "crashed");
            EXPECT_EQ(row.true_end, "fallen");
            EXPECT_THAT(row.reason, HasSubstr("guidance had ended: battery low"));
        } else if (!drifts && !empty) {
            EXPECT_TRUE(is_success(campaign, row)) << row.true_end;
            EXPECT_EQ(row.true_end, "hovering");
        }
    }
    EXPECT_LT(successes, campaign.runs);
    const CampaignSummary summary = summarise(results);
    EXPECT_EQ(summary.success.successes, successes);
    EXPECT_THAT(summary_text(summary), HasSubstr("; in truth "));
    const auto page = write_cells(results, "results.sqlite", bench.folder() / "page");
    ASSERT_TRUE(page);
    const std::string html = text_of(*page);
    EXPECT_THAT(html, HasSubstr("<button class=\"untrue\""));
    EXPECT_THAT(html, HasSubstr("in truth hovering"));
    EXPECT_THAT(html, Not(HasSubstr("in truth \"")));
}

TEST(Success, AFlightThatBrokeOffIsNone) {
    Campaign campaign;
    campaign.success = {Outcome::released, Outcome::timed_out};
    RunRow row;
    row.outcome = kFault;
    EXPECT_FALSE(is_success(campaign, row));
    row.outcome = "timed_out";
    EXPECT_FALSE(is_success(campaign, row)) << "no flight";
    row.true_end = "moving";
    EXPECT_TRUE(is_success(campaign, row)) << "it claims nothing";
}

}  // namespace
}  // namespace limpet::campaign
