// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/mission_report.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace limpet::mavlink {
namespace {

TEST(MissionReport, EveryEventIsToldAndUnderstood) {
    for (int i = 0; i <= static_cast<int>(EventName::aborted); ++i) {
        const auto name = static_cast<EventName>(i);
        EXPECT_EQ(event_name(event_text(make_event(1.0, "guidance", name))), name);
        const StatusText text = event_text(make_event(1.0, "guidance", name, "for a reason"));
        EXPECT_EQ(event_name(text), name);
        EXPECT_NE(text_of(text.text).find(": for a reason"), std::string_view::npos);
    }
}

TEST(MissionReport, TheOutcomeIsToldWithItsReason) {
    const StatusText text = outcome_text(Outcome::released, "back where it came from");
    EXPECT_EQ(text_of(text.text), "outcome: released: back where it came from");
    const auto told = told_outcome(text);
    ASSERT_TRUE(told);
    EXPECT_EQ(told->outcome, Outcome::released);
    EXPECT_EQ(told->reason, "back where it came from");
    EXPECT_FALSE(event_name(text));
}

TEST(MissionReport, ALongReasonIsCutNotLost) {
    const StatusText text = outcome_text(Outcome::release_aborted, std::string(80, 'x'));
    EXPECT_EQ(text_of(text.text).size(), 50U);
    ASSERT_TRUE(told_outcome(text));
    EXPECT_EQ(told_outcome(text)->outcome, Outcome::release_aborted);
    EXPECT_EQ(told_outcome(text)->reason, std::string(50 - 26, 'x'));
}

TEST(MissionReport, OtherTextsAreNeither) {
    for (const char* words : {"", "outcome", "outcome: ", "outcome: landed: x", "perched?",
                              "PX4: perched", "Armed by external command"}) {
        StatusText text;
        set_text(text.text, words);
        EXPECT_FALSE(event_name(text)) << words;
        EXPECT_FALSE(told_outcome(text)) << words;
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
