// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/enum_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limpet {
namespace {

enum class Paint {
    red,
    dark_green,
    blue
};

TEST(EnumNames, AreThoseOfTheCode) {
    EXPECT_THAT(kNamesOf<Paint>, testing::ElementsAre("red", "dark_green", "blue"));
    EXPECT_EQ(name_of(Paint::dark_green), "dark_green");
    EXPECT_EQ(enumerator_of<Paint>("blue"), Paint::blue);
    EXPECT_EQ(enumerator_of<Paint>("green"), std::nullopt);
    EXPECT_THROW((void)name_of(static_cast<Paint>(3)), InternalError);
    EXPECT_THROW((void)name_of(static_cast<Paint>(-1)), InternalError);
}

}  // namespace
}  // namespace limpet
