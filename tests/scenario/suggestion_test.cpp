// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/suggestion.hpp"

#include <gtest/gtest.h>

namespace limpet::scenario {
namespace {

const std::vector<std::string_view> kNames = {"hold_s", "hold_depth_m", "dock_speed_m_s", "rest_s"};

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("hold", ""), 4U);
    EXPECT_EQ(edit_distance("", "hold"), 4U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("dock_sped", "dock_speed"), 1U);
}

TEST(Nearest, FindsSlipsOfTheKeyboard) {
    EXPECT_EQ(nearest("hold_S", kNames), "hold_s");
    EXPECT_EQ(nearest("dock_sped_m_s", kNames), "dock_speed_m_s");
}

TEST(Nearest, FindsAForgottenUnit) {
    EXPECT_EQ(nearest("dock_speed", kNames), "dock_speed_m_s");
}

TEST(Nearest, TakesALetterLeftOutBeforeAWrongOne) {
    EXPECT_EQ(nearest("sed", {"set", "seed"}), "seed");
    EXPECT_EQ(nearest("sed", {"seed", "set"}), "seed");
    EXPECT_EQ(nearest("sef", {"set", "seed"}), "set");
}

TEST(Nearest, KeepsSilentWhenNothingIsNear) {
    EXPECT_EQ(nearest("wind", kNames), "");
    EXPECT_EQ(nearest("x", kNames), "");
    EXPECT_EQ(nearest("", kNames), "");
}

TEST(Hint, ShowsTheNearestOrAFewOrWhereToLook) {
    EXPECT_EQ(hint("hold_S", kNames), ", did you mean hold_s?");
    EXPECT_EQ(hint("wind", kNames), "; there are hold_s, hold_depth_m, dock_speed_m_s, rest_s");
    const std::vector<std::string_view> many(30, "hold_s");
    EXPECT_EQ(hint("wind", many, "look there"), "; look there");
}

}  // namespace
}  // namespace limpet::scenario
