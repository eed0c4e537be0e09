// SPDX-License-Identifier: Apache-2.0
#include "limpet/rare/rare_event.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::rare {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text, const RareGuide& guide = {}) {
    try {
        (void)parse_rare_event(text, guide);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(RareEvent, AThresholdIsAMetricBeyondALimit) {
    campaign::RunRow row;
    row.metrics.cup_margin_min_N = 2.0;
    const RareEvent less = parse_rare_event("cup_margin_min_N < 2");
    EXPECT_EQ(less.text, "cup_margin_min_N<2");
    EXPECT_FALSE(less.happened(row));
    EXPECT_TRUE(parse_rare_event("cup_margin_min_N<=2").happened(row));
    EXPECT_EQ(less.fall(row), 2.0);
    row.metrics.cup_margin_min_N = 1.5;
    EXPECT_TRUE(less.happened(row));
    const RareEvent more = parse_rare_event("attempts>2");
    row.attempts = 3;
    EXPECT_TRUE(more.happened(row));
    EXPECT_EQ(more.fall(row), -3.0);
    EXPECT_EQ(more.value_at(more.fall(row)), 3.0);
}

TEST(RareEvent, WhatDidNotComeToPassIsFarAway) {
    campaign::RunRow row;
    const RareEvent event = parse_rare_event("cup_press_max_N>60");
    EXPECT_TRUE(std::isinf(event.fall(row)));
    EXPECT_FALSE(event.happened(row));
    row.outcome = campaign::kFault;
    row.metrics.cup_press_max_N = 70.0;
    EXPECT_TRUE(std::isinf(event.fall(row)));
    EXPECT_FALSE(event.happened(row));
}

TEST(RareEvent, AnOutcomeHasAFigureThatLeadsToIt) {
    campaign::RunRow row;
    row.outcome = "perched";
    row.metrics.cup_press_max_N = 50.0;
    const RareEvent failed = parse_rare_event("failed_to_seal");
    EXPECT_EQ(failed.fall(row), 50.0);
    row.outcome = "failed_to_seal";
    EXPECT_TRUE(failed.happened(row));
    EXPECT_EQ(failed.fall(row), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(parse_rare_event("timed_out").figure, "simulated_s");
    EXPECT_TRUE(parse_rare_event("timed_out").rising);
    const RareEvent crashed =
        parse_rare_event("crashed", {.falling = "cup_margin_min_N", .rising = {}});
    EXPECT_EQ(crashed.figure, "cup_margin_min_N");
    EXPECT_FALSE(crashed.rising);
}

TEST(RareEvent, ASuccessIsOneByTheTruthAlone) {
    const RareEvent released =
        parse_rare_event("released", {.falling = "cup_margin_min_N", .rising = {}});
    campaign::RunRow row;
    row.outcome = "released";
    row.true_end = "hovering";
    EXPECT_TRUE(released.happened(row));
    row.true_end = "adrift";
    EXPECT_FALSE(released.happened(row));
    const RareEvent failed = parse_rare_event("failed_to_seal");
    row.outcome = "failed_to_seal";
    EXPECT_TRUE(failed.happened(row)) << "a failure, whatever the truth adds";
}

TEST(RareEvent, OneLineForWhatIsNone) {
    EXPECT_THAT(refusal("crash"), HasSubstr("did you mean crashed?"));
    EXPECT_THAT(refusal("cup_margin_mn_N<0"), HasSubstr("did you mean cup_margin_min_N?"));
    EXPECT_THAT(refusal("cup_margin_min_N"), HasSubstr("give its threshold"));
    EXPECT_THAT(refusal("cup_margin_min_N<low"), HasSubstr("\"low\" is not a number"));
    EXPECT_THAT(refusal("cup_margin_min_N<"), HasSubstr("is not a number"));
    EXPECT_THAT(refusal("cup_margin_min_N<nan"), HasSubstr("is not a number"));
    EXPECT_THAT(refusal("crashed"), HasSubstr("--falling or --rising"));
    EXPECT_THAT(refusal("crashed", {.falling = "cup_margin", .rising = {}}),
                HasSubstr("--falling cup_margin: unknown metric, did you mean cup_margin_min_N?"));
    EXPECT_THAT(refusal("attempts>2", {.falling = "attempts", .rising = {}}),
                HasSubstr("are for outcomes"));
    EXPECT_THAT(refusal(""), HasSubstr("no outcome"));
}

}  // namespace
}  // namespace limpet::rare
