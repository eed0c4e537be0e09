// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "../support/files.hpp"
#include "../support/png.hpp"
#include "compare_flights.hpp"
#include "limpet/compare/report.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/colours.hpp"

namespace limpet::compare {
namespace {

using test::ComparedTape;
using test::Held;
using testing::HasSubstr;

/// A ramp that begins at the impact: linear interpolation is exact, whatever the shift.
Truth ramp(double since_impact_s, double offset_Pa = 0.0) {
    Truth truth;
    truth.cup_status.pressure_Pa =
        kAtmosphere_Pa - 5000.0 * std::max(0.0, since_impact_s) + offset_Pa;
    return truth;
}

/// Of exactly this colour, "#RRGGBB".
std::size_t pixels(const draw::Image& image, const std::string& colour) {
    const unsigned long rgb = std::stoul(colour.substr(1), nullptr, 16);
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        const unsigned long here =
            image.rgb[i] * 65536ul + image.rgb[i + 1] * 256ul + image.rgb[i + 2];
        count += here == rgb ? 1 : 0;
    }
    return count;
}

ComparedTape tape_with_impact(double impact_s, double offset_Pa = 0.0) {
    return {.truth = [=](double t) { return ramp(t - impact_s, offset_Pa); },
            .events = {{impact_s, EventName::impact}}};
}

TEST(Compare, AFlightAgainstItselfIsExactlyAlike) {
    const Held held(tape_with_impact(4.0), tape_with_impact(4.0));
    for (const ChannelDifference& channel : held.comparison.channels) {
        EXPECT_EQ(channel.largest, 0.0) << channel.name;
        EXPECT_GT(channel.samples, 900u) << channel.name;
    }
    EXPECT_TRUE(held.comparison.only_in_reference.empty());
    EXPECT_TRUE(held.comparison.only_in_other.empty());
}

TEST(Compare, AnEventLaterByTwoTenthsLeavesNoDifferenceOnceAligned) {
    const Held held(tape_with_impact(4.0), tape_with_impact(4.2));
    EXPECT_NEAR(held.channel("cup_pressure_hPa").largest, 0.0, 1e-9);
    ASSERT_EQ(held.comparison.events.size(), 1u);
    EXPECT_NEAR(held.comparison.event_difference_s(held.comparison.events[0]), 0.2, 1e-9);
    // Until the impact the other has 0.2 s more, left out midway; from there on the reference has.
    ASSERT_EQ(held.comparison.pieces.size(), 3u);
    EXPECT_NEAR(held.comparison.pieces[0].window.to_s, 2.0, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[0].shift_s, 0.0, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[1].window.from_s, 2.0, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[0].other_left_out_s, 0.2, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[0].reference_left_out_s, 0.0, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[1].shift_s, 0.2, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[2].shift_s, 0.2, 1e-9);
    EXPECT_NEAR(held.comparison.pieces[2].reference_left_out_s, 0.2, 1e-9);
    EXPECT_THAT(comparison_text(held.comparison), HasSubstr("left out: 0.200 s of first"));
}

TEST(Compare, WhatLeadsUpToALateEventIsNoDifference) {
    // A force that rises 50 ms before guidance calls it an impact.
    const auto pressed = [](double impact_s) {
        ComparedTape tape = tape_with_impact(impact_s);
        tape.truth = [=](double t) { return ramp(t - impact_s + 0.05); };
        return tape;
    };
    EXPECT_NEAR(Held(pressed(4.0), pressed(4.2)).channel("cup_pressure_hPa").largest, 0.0, 1e-9);
    EXPECT_NEAR(Held(pressed(4.2), pressed(4.0)).channel("cup_pressure_hPa").largest, 0.0, 1e-9);
}

TEST(Compare, LaidStartOnStartTheSameDelayIsSlopeTimesDelay) {
    const Held held(tape_with_impact(4.0), tape_with_impact(4.2), {.by = Alignment::By::start});
    EXPECT_NEAR(held.channel("cup_pressure_hPa").largest, 50.0 * 0.2, 1e-9);
    EXPECT_NEAR(held.comparison.pieces.at(0).shift_s, 0.0, 1e-12);
}

TEST(Compare, LaidAtOneEventAClockOfItsOwnIsNoDifference) {
    ComparedTape late = tape_with_impact(104.0);  // another computer's clock
    late.from_s = 100.0;
    late.to_s = 110.0;
    const Held held(tape_with_impact(4.0), late, {.by = Alignment::By::event, .event = "impact"});
    EXPECT_NEAR(held.comparison.event_difference_s(held.comparison.events.at(0)), 0.0, 1e-9);
    EXPECT_NEAR(held.channel("cup_pressure_hPa").largest, 0.0, 1e-6);
    EXPECT_GT(held.channel("cup_pressure_hPa").samples, 990u);
}

TEST(Compare, AnOffsetOfThreeHectopascalIsThreeEverywhere) {
    const Held held(tape_with_impact(4.0), tape_with_impact(4.0, 300.0));
    const ChannelDifference& pressure = held.channel("cup_pressure_hPa");
    EXPECT_NEAR(pressure.largest, 3.0, 1e-9);
    EXPECT_NEAR(pressure.rms, 3.0, 1e-9);
    EXPECT_NEAR(pressure.other.highest - pressure.reference.highest, 3.0, 1e-9);
    EXPECT_EQ(held.channel("pitch_deg").largest, 0.0) << "nothing else has moved";
}

TEST(Compare, NamesTimeAndPhaseOfTheLargestDifference) {
    ComparedTape a = tape_with_impact(4.0);
    a.state = [](double t) { return std::string(t < 4.0 ? "approaching" : "holding"); };
    ComparedTape b = a;
    b.truth = [](double t) {
        return ramp(t - 4.0, 700.0 * std::max(0.0, 1.0 - std::abs(t - 6.5)));
    };
    const Held held(a, b);
    const ChannelDifference& pressure = held.channel("cup_pressure_hPa");
    EXPECT_NEAR(pressure.largest, 7.0, 1e-9);
    EXPECT_NEAR(pressure.at_s, 6.5, 1e-9);
    EXPECT_EQ(pressure.phase, "holding");
    // A triangle of height 7 and width 2 in 10 s: 7 sqrt(2/3 / 10).
    EXPECT_NEAR(pressure.rms, 7.0 * std::sqrt(2.0 / 3.0 / 10.0), 0.01);
}

TEST(Compare, WithoutStatesThePhaseIsTheEventBefore) {
    ComparedTape b = tape_with_impact(4.0);
    b.truth = [](double t) { return ramp(t - 4.0, t > 8.0 ? 100.0 : 0.0); };
    EXPECT_EQ(Held(tape_with_impact(4.0), b).channel("cup_pressure_hPa").phase, "impact");
}

TEST(Compare, AnEventThatOneFlightLacksIsSaidAndPassedOver) {
    ComparedTape b = tape_with_impact(4.0);
    b.events.push_back({7.0, EventName::detached});
    const Held held(tape_with_impact(4.0), b);
    ASSERT_EQ(held.comparison.events.size(), 2u);
    EXPECT_FALSE(held.comparison.events[1].in_both());
    EXPECT_EQ(held.comparison.pieces.size(), 2u) << "no piece begins at it";
    EXPECT_EQ(held.channel("cup_pressure_hPa").largest, 0.0);
    const auto checked = check_limits({held.comparison}, {{"event", 1000.0}});
    EXPECT_TRUE(checked.at(0).exceeded()) << "missing is worse than late";
    EXPECT_EQ(checked.at(0).where, "detached");
}

TEST(Compare, WithoutACommonEventItSaysWhatToDo) {
    ComparedTape b = tape_with_impact(4.0);
    b.events = {{2.0, EventName::perched}};
    try {
        const Held held(tape_with_impact(4.0), b);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no common event"));
        EXPECT_THAT(error.what(), HasSubstr("--align start"));
    }
}

TEST(Compare, TheSecondAttemptIsHeldAgainstTheSecond) {
    ComparedTape a = tape_with_impact(2.0);
    a.events = {{2.0, EventName::impact}, {3.0, EventName::contact_lost}, {6.0, EventName::impact}};
    ComparedTape b = tape_with_impact(2.0);
    b.events = {{2.0, EventName::impact}, {3.0, EventName::contact_lost}, {6.5, EventName::impact}};
    const Held held(a, b);
    ASSERT_EQ(held.comparison.events.size(), 3u);
    EXPECT_EQ(held.comparison.events[2].occurrence, 2);
    EXPECT_NEAR(held.comparison.event_difference_s(held.comparison.events[2]), 0.5, 1e-9);
}

TEST(Compare, EventsToldInAnotherOrderLoseAsFewPiecesAsPossible) {
    ComparedTape a = tape_with_impact(2.0);
    a.events = {{2.0, EventName::impact},
                {3.0, EventName::attached},
                {4.0, EventName::hold_over},
                {6.0, EventName::perched}};
    ComparedTape b = a;
    b.events = {{2.0, EventName::impact},
                {3.5, EventName::hold_over},
                {4.5, EventName::attached},
                {6.0, EventName::perched}};
    const Held held(a, b);
    ASSERT_EQ(held.comparison.pieces.size(), 6u)
        << "start; impact and one of the two, each in halves; perched";
    for (std::size_t i = 1; i < held.comparison.pieces.size(); ++i) {
        EXPECT_GE(held.comparison.pieces[i].window.from_s,
                  held.comparison.pieces[i - 1].window.to_s);
    }
}

TEST(Compare, NothingIsReadAcrossAGap) {
    ComparedTape a{.range_m = [](double t) { return 1.0 + 0.1 * t; },
                   .pressure_Pa = [](double) { return 90000.0; }};
    ComparedTape b = a;
    b.range_m = [](double t) { return t > 2.0 && t < 3.0 ? -1.0 : 1.0 + 0.1 * t; };  // no echo
    b.silent = [](double t) { return t > 5.0 && t < 6.0; };
    // The times of b lie between those of a: every value is interpolated.
    b.from_s = 0.005;
    b.to_s = 9.995;
    const Held held(a, b, {.by = Alignment::By::start});
    const ChannelDifference& lidar = held.channel("lidar_left_m");
    EXPECT_NEAR(lidar.largest, 0.0005, 1e-6) << "0.005 s of 0.1 m/s, never across a gap";
    EXPECT_NEAR(static_cast<double>(lidar.samples), 1000.0 - 2.0 * 100.0, 6.0);
    EXPECT_NEAR(static_cast<double>(held.channel("cup_pressure_measured_hPa").samples),
                1000.0 - 100.0, 6.0);
}

TEST(Compare, RecordingsWithoutTruthAreComparedByTheirSensors) {
    const ComparedTape a{.pressure_Pa = [](double t) { return 90000.0 + 10.0 * t; },
                         .events = {{1.0, EventName::impact}}};
    ComparedTape b = a;
    b.truth = [](double) { return Truth{}; };
    const Held held(a, b);
    EXPECT_EQ(held.comparison.channels.size(), 1u);
    EXPECT_THAT(held.comparison.only_in_other, testing::Contains("pitch_deg"));
    EXPECT_TRUE(held.comparison.contacts.empty());
}

TEST(Compare, WithoutACommonChannelItSaysSo) {
    const ComparedTape a{.range_m = [](double) { return 1.0; },
                         .events = {{1.0, EventName::impact}}};
    const ComparedTape b{.pressure_Pa = [](double) { return 9e4; },
                         .events = {{1.0, EventName::impact}}};
    EXPECT_THROW(Held(a, b), InputError);
}

TEST(CompareChannels, AnglesTakeTheShortWay) {
    EXPECT_NEAR(difference_of(ChannelKind::angle, 179.0, -179.0), 2.0, 1e-12);
    EXPECT_NEAR(difference_of(ChannelKind::angle, -179.0, 179.0), -2.0, 1e-12);
    const FlightChannel yaw{.name = "yaw_deg",
                            .group = "attitude",
                            .title = "yaw",
                            .unit = "deg",
                            .kind = ChannelKind::angle,
                            .time_s = {0.0, 1.0},
                            .values = {170.0, -170.0},
                            .gap_s = 2.0};
    EXPECT_NEAR(std::abs(value_at(yaw, 0.5)), 180.0, 1e-9);
    EXPECT_NEAR(value_at(yaw, 0.25), 175.0, 1e-9);
}

TEST(CompareChannels, StatesHoldUntilTheNextAndNumbersAreJoined) {
    FlightChannel channel{.name = "x",
                          .group = "x",
                          .title = "x",
                          .unit = "",
                          .kind = ChannelKind::number,
                          .time_s = {1.0, 2.0, 3.0, 9.0},
                          .values = {10.0, 20.0, std::nan(""), 40.0},
                          .gap_s = 2.0};
    EXPECT_NEAR(value_at(channel, 1.25), 12.5, 1e-12);
    EXPECT_TRUE(std::isnan(value_at(channel, 2.5))) << "next to a NaN";
    EXPECT_TRUE(std::isnan(value_at(channel, 5.0))) << "in a gap";
    EXPECT_TRUE(std::isnan(value_at(channel, 0.5))) << "before";
    EXPECT_TRUE(std::isnan(value_at(channel, 9.5))) << "after";
    EXPECT_EQ(value_at(channel, 9.0), 40.0);
    channel.kind = ChannelKind::state;
    EXPECT_EQ(value_at(channel, 1.9), 10.0);
}

TEST(CompareChannels, OfAStateTheRmsIsTheRootOfTheShareNotAlike) {
    ComparedTape a{.truth = [](double) { return Truth{}; },
                   .state = [](double) { return std::string("holding"); }};
    ComparedTape b = a;
    b.state = [](double t) { return std::string(t < 7.5 ? "holding" : "deciding"); };
    const Held held(a, b, {.by = Alignment::By::start});
    const ChannelDifference& state = held.channel("guidance_state");
    EXPECT_EQ(state.largest, 1.0);
    EXPECT_NEAR(state.at_s, 7.5, 1e-9);
    EXPECT_NEAR(state.rms * state.rms, 0.25, 0.002);
}

TEST(CompareLimits, TellWithinFromBeyondAndNameTheWorst) {
    const Held near(tape_with_impact(4.0), tape_with_impact(4.05, 100.0));
    Held far(tape_with_impact(4.0), tape_with_impact(4.3, 300.0));
    far.comparison.other.label = "far";
    const auto checked =
        check_limits({near.comparison, far.comparison},
                     {{"cup_pressure_hPa", 3.1}, {"cup_pressure_hPa", 2.9}, {"event", 0.25}});
    ASSERT_EQ(checked.size(), 3u);
    EXPECT_FALSE(checked[0].exceeded());
    EXPECT_TRUE(checked[1].exceeded());
    EXPECT_NEAR(checked[1].measured, 3.0, 1e-9);
    EXPECT_EQ(checked[2].other, "far");
    EXPECT_NEAR(checked[2].measured, 0.3, 1e-9);
    EXPECT_EQ(checked[2].where, "impact");
    EXPECT_THAT(limits_text(checked), HasSubstr("EXCEEDED"));
}

TEST(CompareLimits, UnknownNamesAndBadValuesAreRefused) {
    const Held held(tape_with_impact(4.0), tape_with_impact(4.0));
    EXPECT_THROW((void)check_limits({held.comparison}, {{"cup_presure", 1.0}}), InputError);
    for (const char* text : {"event", "event=", "=1", "event=fast", "event=-1", "event=nan"}) {
        EXPECT_THROW((void)parse_limit(text), InputError) << text;
    }
    EXPECT_EQ(parse_limit("/topic/a=b=0.5").name, "/topic/a=b");
}

TEST(CompareLimits, OutcomesAreAlikeOrNot) {
    ComparedTape b = tape_with_impact(4.0);
    b.summary = R"({"outcome": "crashed"})";
    const Held held(tape_with_impact(4.0), b);
    EXPECT_TRUE(check_limits({held.comparison}, {{"outcome", 0.0}}).at(0).exceeded());
    EXPECT_THAT(comparison_text(held.comparison), HasSubstr("crashed"));
}

TEST(CompareFigures, MetricsOfTheSummariesStandSideBySide) {
    ComparedTape a = tape_with_impact(4.0);
    a.summary = R"({"outcome": "released", "metrics": {"impact_force_N": 42.0, "only_a": 1.0}})";
    ComparedTape b = tape_with_impact(4.0);
    b.summary = R"({"outcome": "released", "metrics": {"impact_force_N": 44.5, "none": null}})";
    const Held held(a, b);
    EXPECT_NEAR(held.figure("impact_force_N").off(), 2.5, 1e-12);
    EXPECT_TRUE(std::isnan(held.figure("only_a").off()));
    EXPECT_TRUE(check_limits({held.comparison}, {{"only_a", 100.0}}).at(0).exceeded());
    EXPECT_THAT(comparison_markdown({held.comparison}),
                HasSubstr("| impact_force_N | 42 | 44.5 |"));
}

TEST(Compare, AShiftByASampleIsNoDifferenceBeyondIt) {
    const auto tape = [](double impact_s) {
        return ComparedTape{.truth =
                                [=](double t) {
                                    Truth truth;
                                    truth.slider.force_N = t >= impact_s ? -42.0 : 0.0;
                                    return truth;
                                },
                            .events = {{1.0, EventName::level}}};
    };
    const record::Recording a = test::record(tape(4.0)), b = test::record(tape(4.01)),
                            c = test::record(tape(4.1));
    StateNumbers numbers;
    const auto force = [&numbers](const record::Recording& recording) {
        for (FlightChannel& channel : flight_channels(recording, numbers)) {
            if (channel.name == "slider_force_N") {
                return channel;
            }
        }
        throw std::out_of_range("slider_force_N");
    };
    const auto most = [](const Differences& all) {
        double found = 0.0;
        for (const double value : all.values) {
            found = std::isnan(value) ? found : std::max(found, std::abs(value));
        }
        return found;
    };
    const std::vector<Piece> whole = {{"start", {0.0, 10.0}}};
    EXPECT_NEAR(most(differences(force(a), force(b), whole)), 42.0, 1e-9);
    EXPECT_NEAR(most(beyond_shift(force(a), force(b), whole, 0.02)), 0.0, 1e-9);
    EXPECT_NEAR(most(beyond_shift(force(a), force(c), whole, 0.02)), 42.0, 1e-9);
}

TEST(CompareFigures, StatesHaveTheirNames) {
    const auto tape = [](CupPhase phase) {
        return ComparedTape{.truth =
                                [=](double t) {
                                    Truth truth;
                                    truth.cup_status.phase = t > 5.0 ? phase : CupPhase::free;
                                    return truth;
                                },
                            .events = {{1.0, EventName::level}}};
    };
    const record::Recording a = test::record(tape(CupPhase::sealing));
    const record::Recording b = test::record(tape(CupPhase::attached));
    StateNumbers numbers;
    const FlightTrace first{&a, "first", flight_channels(a, numbers)};
    const std::vector<FlightTrace> others = {{&b, "second", flight_channels(b, numbers)}};
    const std::vector<FlightComparison> held = {compare(first, others[0], {})};
    const test::Folder folder;
    const draw::Pictures pictures = draw_comparison(first, others, held, folder.path() / "figures");
    const std::string svg = load_text(folder.path() / "figures/compare_cup.svg");
    for (const char* name : {"free", "sealing", "attached", "not alike"}) {
        EXPECT_THAT(svg, HasSubstr(name));
    }
    const std::string page = comparison_html(held, {}, pictures.files, folder.path(), "limpet");
    for (const char* text : {"first against second", "id=\"picture-cup\"", "cup_phase",
                             "data:image/", "<h3 id=\"events-1\">", "since the last s"}) {
        EXPECT_THAT(page, HasSubstr(text));
    }
    EXPECT_THAT(page, testing::ContainsRegex("number-cell\">[0-9]+[.][0-9][0-9][0-9]<"))
        << "times to a millisecond, as numbers";
    const std::atomic<bool> stop = true;
    EXPECT_THROW((void)draw_comparison(first, others, held, folder.path() / "new", {.stop = &stop}),
                 Interrupted);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
}

TEST(CompareFigures, OverlaysAreDrawnInBothColours) {
    const record::Recording a = test::record(tape_with_impact(4.0));
    const record::Recording b = test::record(tape_with_impact(4.0, 5000.0));
    StateNumbers numbers;
    const FlightTrace first{&a, "first", flight_channels(a, numbers)};
    const std::vector<FlightTrace> others = {{&b, "second", flight_channels(b, numbers)}};
    const test::Folder folder;
    const draw::Pictures pictures =
        draw_comparison(first, others, {compare(first, others[0], {})}, folder.path());
    EXPECT_THAT(pictures.files, testing::Contains(folder.path() / "compare_cup.png"));
    const auto image = test::read_png(folder.path() / "compare_cup.png");
    EXPECT_EQ(image.width_px, 1440);
    EXPECT_GT(pixels(image, draw::colours::kDarkBlue), 500u) << "the reference";
    EXPECT_GT(pixels(image, draw::colours::kOrange), 500u) << "the other and its difference";
}

}  // namespace
}  // namespace limpet::compare
