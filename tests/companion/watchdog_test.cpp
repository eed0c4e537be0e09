// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/watchdog.hpp"

#include <gtest/gtest.h>

#include <array>

namespace limpet::companion {
namespace {

using enum Action;
using enum Place;

constexpr std::array kPlaces = {in_air, pressed, leaving, on_cup, at_rest};

struct Line {
    const char* name;
    Cause cause;
    Signs signs;
    std::array<Action, 5> expected;
};

Signs with(mavlink::OffboardState state) {
    return {.autopilot = state};
}

/// As docs/decisions/0013-handing-back.md has it.
const std::array kLines = {
    Line{"mode taken",
         Cause::mode_taken,
         with(mavlink::OffboardState::taken_away),
         {let_go, let_go, let_go, let_go, let_go}},
    Line{"disarmed",
         Cause::disarmed,
         {.disarmed = true},
         {let_go, let_go, let_go, let_go, carry_on}},
    Line{"interrupted",
         Cause::interrupted,
         {.interrupted = true},
         {hold, finish, finish, finish, let_go}},
    Line{"silent",
         Cause::autopilot_silent,
         with(mavlink::OffboardState::silent),
         {hold, finish, hold, finish, finish}},
    Line{"late", Cause::loop_late, {.late = true}, {hold, finish, hold, finish, finish}},
    Line{"pose", Cause::pose_stale, {.pose_fresh = false}, {hold, finish, hold, finish, finish}},
    Line{"estimate",
         Cause::estimate_stale,
         {.estimate_fresh = false},
         {hold, finish, hold, finish, finish}},
};

TEST(Watchdog, EveryCellIsAsDecided) {
    for (const Line& line : kLines) {
        for (std::size_t i = 0; i < kPlaces.size(); ++i) {
            const Judgement verdict = judge(line.signs, kPlaces[i]);
            EXPECT_EQ(verdict.action, line.expected[i])
                << line.name << ", " << to_string(kPlaces[i]);
            EXPECT_EQ(action_for(line.cause, kPlaces[i]), line.expected[i]) << line.name;
            if (verdict.action != carry_on) {
                EXPECT_EQ(verdict.cause, line.cause) << line.name;
            }
        }
    }
}

TEST(Watchdog, CarriesOnWhenAllIsWell) {
    for (const Place place : kPlaces) {
        EXPECT_EQ(judge({}, place).action, carry_on);
        for (const auto state : {mavlink::OffboardState::engaged, mavlink::OffboardState::streaming,
                                 mavlink::OffboardState::unready}) {
            EXPECT_EQ(judge(with(state), place).action, carry_on);
        }
    }
}

TEST(Watchdog, NeverHoldsWhereTheCupMayHold) {
    for (const Line& line : kLines) {
        for (const Place place : {pressed, on_cup, at_rest}) {
            EXPECT_NE(judge(line.signs, place).action, hold) << line.name;
        }
    }
}

TEST(Watchdog, TheGravestOfSeveralCounts) {
    Signs signs{.autopilot = mavlink::OffboardState::taken_away,
                .disarmed = true,
                .interrupted = true,
                .late = true,
                .pose_fresh = false,
                .estimate_fresh = false};
    EXPECT_EQ(judge(signs, in_air).cause, Cause::mode_taken);
    signs.autopilot = mavlink::OffboardState::engaged;
    EXPECT_EQ(judge(signs, in_air).cause, Cause::disarmed);
    EXPECT_EQ(judge(signs, at_rest).cause, Cause::interrupted)
        << "at rest disarmed is as it should";
    signs.disarmed = false;
    EXPECT_EQ(judge(signs, in_air).cause, Cause::interrupted);
    signs.interrupted = false;
    EXPECT_EQ(judge(signs, in_air).cause, Cause::loop_late);
}

TEST(Watchdog, KnowsThePlaceOfEveryState) {
    const auto place = [](guidance::PerchingState state, bool armed = true) {
        guidance::PerchingMemory memory;
        memory.state = state;
        memory.setpoint.armed = armed;
        return place_of(memory);
    };
    for (const auto state :
         {guidance::PerchingState::hovering, guidance::PerchingState::pre_positioning,
          guidance::PerchingState::aligning, guidance::PerchingState::approaching}) {
        EXPECT_EQ(place(state), in_air) << to_string(state);
    }
    for (const auto state : {guidance::PerchingState::holding, guidance::PerchingState::deciding}) {
        EXPECT_EQ(place(state), pressed) << to_string(state);
    }
    for (const auto state :
         {guidance::PerchingState::retreating, guidance::PerchingState::backing_off,
          guidance::PerchingState::braking}) {
        EXPECT_EQ(place(state), leaving) << to_string(state);
    }
    for (const auto state :
         {guidance::PerchingState::pitching_up, guidance::PerchingState::unloading,
          guidance::PerchingState::spinning_up, guidance::PerchingState::pitching_down,
          guidance::PerchingState::levelled, guidance::PerchingState::releasing,
          guidance::PerchingState::resealing}) {
        EXPECT_EQ(place(state), on_cup) << to_string(state);
    }
    for (const auto state : {guidance::PerchingState::standing, guidance::PerchingState::resting}) {
        EXPECT_EQ(place(state, false), at_rest) << to_string(state);
    }
    EXPECT_EQ(place(guidance::PerchingState::finished, true), in_air);
    EXPECT_EQ(place(guidance::PerchingState::finished, false), at_rest);
}

TEST(ArmingWatch, SeesWhoWasArmedAndIsNoLonger) {
    ArmingWatch watch;
    EXPECT_FALSE(watch_arming(watch, true, false, 2.0, 0.0)) << "not armed yet";
    EXPECT_FALSE(watch_arming(watch, true, true, 2.0, 1.0)) << "perhaps an old heartbeat";
    EXPECT_FALSE(watch_arming(watch, true, false, 2.0, 1.5)) << "it was an old one";
    EXPECT_FALSE(watch_arming(watch, true, true, 2.0, 2.0));
    EXPECT_TRUE(watch_arming(watch, true, false, 2.0, 2.1));
    EXPECT_FALSE(watch_arming(watch, false, false, 2.0, 2.2)) << "as asked";
    EXPECT_FALSE(watch_arming(watch, true, false, 2.0, 2.3)) << "asked for anew";
}

}  // namespace
}  // namespace limpet::companion
