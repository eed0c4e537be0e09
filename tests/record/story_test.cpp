// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/story.hpp"

#include <gmock/gmock.h>

#include "../support/flights.hpp"

namespace limpet::record {
namespace {

using test::Attempt;
using testing::ElementsAre;

std::vector<std::string> files(const std::vector<Chapter>& chapters) {
    std::vector<std::string> names;
    for (const Chapter& chapter : chapters) {
        names.push_back(chapter.file);
    }
    return names;
}

/// A recording of some length with these events and nothing else.
Recording told(std::vector<RecordedEvent> events, double end_s = 60.0) {
    Recording recording;
    recording.tables.push_back(
        {.topic = "/truth/pose", .type = "", .time_s = {0.0, end_s}, .columns = {}, .texts = {}});
    recording.events = std::move(events);
    return recording;
}

RecordedEvent at(double time_s, const char* name) {
    return {.time_s = time_s, .station = "guidance", .name = name, .reason = "", .values = {}};
}

TEST(Story, windows_of_a_whole_flight) {
    const Recording flight = test::fly();
    EXPECT_THAT(files(chapters(flight)), ElementsAre("overview", "perching", "take_off"));
    const Window overview = chapters(flight)[0].window;
    EXPECT_DOUBLE_EQ(overview.from_s, 0.0);
    EXPECT_NEAR(overview.to_s, Attempt::kEnd_s, 0.005);
    const Window landing = perching(flight)->window;
    EXPECT_NEAR(landing.from_s, Attempt::kApproach_s - 0.5, 1e-9);
    EXPECT_NEAR(landing.to_s, Attempt::kPerched_s + 1.0, 1e-9);
    const Window leaving = take_off(flight)->window;
    EXPECT_NEAR(leaving.from_s, Attempt::kMotorsOn_s - 0.5, 1e-9);
    EXPECT_NEAR(leaving.to_s, Attempt::kEnd_s, 0.005) << "two seconds are more than there are";
}

TEST(Story, the_last_attempt_counts_and_the_failed_one_has_its_own) {
    const Recording flight = test::fly({.failed_first = true});
    EXPECT_THAT(files(chapters(flight)),
                ElementsAre("overview", "perching", "take_off", "failed_attempt"));
    EXPECT_NEAR(perching(flight)->window.from_s, Attempt::kFailedEnd_s + Attempt::kApproach_s - 0.5,
                1e-9);
    const Window failed = failed_attempt(flight)->window;
    EXPECT_NEAR(failed.from_s, Attempt::kApproach_s - 0.5, 1e-9);
    EXPECT_NEAR(failed.to_s, Attempt::kDecision_s + 3.0, 1e-9);
}

TEST(Story, a_hover_has_the_overview_alone) {
    EXPECT_THAT(files(chapters(test::fly({.cup = false}))), ElementsAre("overview"));
}

TEST(Story, a_release_that_is_given_up_ends_two_seconds_later) {
    const Recording flight =
        told({at(5.0, "approach_started"), at(6.0, "impact"), at(12.0, "motors_off"),
              at(20.0, "motors_on"), at(26.0, "level"), at(42.0, "aborted"),
              at(43.0, "landing_started"), at(50.0, "motors_off")});
    EXPECT_DOUBLE_EQ(take_off(flight)->window.to_s, 44.0);
    EXPECT_DOUBLE_EQ(perching(flight)->window.to_s, 13.0) << "the first rest, not the second";
}

TEST(Story, a_landing_without_an_end_is_shown_to_the_end) {
    EXPECT_DOUBLE_EQ(perching(told({at(5.0, "approach_started")}, 9.0))->window.to_s, 9.0);
}

TEST(Story, an_attempt_that_fails_ends_with_its_retreat) {
    const Recording flight =
        told({at(5.0, "approach_started"), at(6.0, "impact"), at(6.5, "retreat_started")});
    EXPECT_DOUBLE_EQ(perching(flight)->window.to_s, 7.5);
    EXPECT_DOUBLE_EQ(failed_attempt(flight)->window.to_s, 9.5);
}

TEST(Story, phases_follow_each_other_without_a_gap) {
    const Recording flight = test::fly();
    const std::vector<Phase> states = phases(flight);
    ASSERT_EQ(states.size(), 10u);
    EXPECT_EQ(states.front().state, "pre_positioning");
    EXPECT_EQ(states.back().state, "finished");
    for (std::size_t i = 1; i < states.size(); ++i) {
        EXPECT_DOUBLE_EQ(states[i].window.from_s, states[i - 1].window.to_s);
    }
    EXPECT_DOUBLE_EQ(states[3].window.from_s, Attempt::kImpact_s);
    EXPECT_DOUBLE_EQ(states.back().window.to_s, whole_flight(flight).to_s);
}

TEST(Story, summary_of_a_finished_flight) {
    const Summary facts = summary(test::fly());
    EXPECT_EQ(facts.scenario, "perch_concrete");
    EXPECT_EQ(facts.seed, "7");
    EXPECT_EQ(facts.outcome, "released");
    EXPECT_EQ(facts.reason, "back at the pre-position");
}

/// Its words are printed, whoever wrote them.
TEST(Story, a_summary_steers_no_terminal) {
    Recording recording;
    recording.metadata["limpet"] = {{"scenario", "\x1b[31ma\nb\x7f"}, {"seed", "\xC2\x9B 7"}};
    recording.attachments.push_back({.name = "summary.json",
                                     .media_type = "application/json",
                                     .text = "{\"outcome\": \"\\u001b]0;x\\u0007\", "
                                             "\"reason\": \"\u00fcber \\u009b2J\"}",
                                     .log_time_ns = 0});
    EXPECT_EQ(summary(recording).scenario, " [31ma b ");
    EXPECT_EQ(summary(recording).seed, "   7");
    EXPECT_EQ(summary(recording).outcome, " ]0;x ");
    EXPECT_EQ(summary(recording).reason, "\u00fcber   2J");
}

TEST(Story, summary_of_nothing_and_of_nonsense_is_empty) {
    Recording recording;
    EXPECT_EQ(summary(recording).outcome, "");
    recording.attachments.push_back({.name = "summary.json",
                                     .media_type = "application/json",
                                     .text = "{\"outcome\": 3, ",
                                     .log_time_ns = 0});
    EXPECT_EQ(summary(recording).outcome, "");
    EXPECT_DOUBLE_EQ(whole_flight(recording).span_s(), 0.0);
    EXPECT_TRUE(phases(recording).empty());
}

}  // namespace
}  // namespace limpet::record
