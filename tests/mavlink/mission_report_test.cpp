// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/mission_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace limpet::mavlink {
namespace {

TEST(MissionReport, EveryEventIsToldAndUnderstood) {
    const std::string reason(120, 'r');
    for (int i = 0; i <= static_cast<int>(EventName::aborted); ++i) {
        const auto name = static_cast<EventName>(i);
        const ReportText words = event_text(make_event(1.0, "guidance", name));
        const auto bare = told_event(words.view());
        ASSERT_TRUE(bare);
        EXPECT_EQ(bare->name, name);
        EXPECT_EQ(bare->reason, "");
        const ReportText text = event_text(make_event(1.0, "guidance", name, reason));
        ASSERT_TRUE(told_event(text.view()));
        EXPECT_EQ(told_event(text.view())->name, name);
        EXPECT_EQ(told_event(text.view())->reason, reason);
    }
}

TEST(MissionReport, TheOutcomeIsToldWithItsReason) {
    const std::string reason = "a reason that is longer than one text of MAVLink: with all of it";
    const ReportText text = outcome_text(Outcome::released, reason);
    EXPECT_EQ(text.view(), "outcome: released: " + reason);
    const auto told = told_outcome(text.view());
    ASSERT_TRUE(told);
    EXPECT_EQ(told->outcome, Outcome::released);
    EXPECT_EQ(told->reason, reason);
    EXPECT_FALSE(told_event(text.view()));
}

TEST(MissionReport, WhatIsLongerThanAReportIsCut) {
    const ReportText text = outcome_text(Outcome::released, std::string(900, 'x'));
    EXPECT_EQ(text.view().size(), 400U);
    ASSERT_TRUE(told_outcome(text.view()));
    EXPECT_EQ(told_outcome(text.view())->outcome, Outcome::released);
}

TEST(MissionReport, OtherTextsAreNeither) {
    for (const char* words : {"", "outcome", "outcome: ", "outcome: landed: x", "perched?",
                              "PX4: perched", "Armed by external command"}) {
        EXPECT_FALSE(told_event(words)) << words;
        EXPECT_FALSE(told_outcome(words)) << words;
    }
}

TEST(MissionReport, AStateIsAWholeNumberUnderItsName) {
    EXPECT_EQ(guidance_state(guidance_state(17, 5)), 17);
    NamedValueFloat message = guidance_state(3, 5);
    message.value = 3.5F;
    EXPECT_FALSE(guidance_state(message));
    message.value = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(guidance_state(message));
    message.value = -1.0F;
    EXPECT_FALSE(guidance_state(message));
    message = guidance_state(3, 5);
    set_text(message.name, "cup_force");
    EXPECT_FALSE(guidance_state(message));
}

}  // namespace
}  // namespace limpet::mavlink
