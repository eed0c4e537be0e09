// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/enum_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limpet {
namespace {

enum class Colour {
    red,
    dark_green,
    blue
};

TEST(EnumNames, AreThoseOfTheCode) {
    EXPECT_THAT(kNamesOf<Colour>, testing::ElementsAre("red", "dark_green", "blue"));
    EXPECT_EQ(name_of(Colour::dark_green), "dark_green");
    EXPECT_EQ(enumerator_of<Colour>("blue"), Colour::blue);
    EXPECT_EQ(enumerator_of<Colour>("green"), std::nullopt);
    EXPECT_THROW((void)name_of(static_cast<Colour>(3)), InternalError);
    EXPECT_THROW((void)name_of(static_cast<Colour>(-1)), InternalError);
}

}  // namespace
}  // namespace limpet
