// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/library.hpp"
#include "limpet/loaded/mujoco.hpp"

namespace limpet::loaded {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(Library, FunctionsAreFoundByName) {
    double (*cosine)(double) = nullptr;
    Library("libm.so.6").take(cosine, "cos");
    EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Library, WhatItLacksIsNamed) {
    void (*nothing)() = nullptr;
    EXPECT_THAT([&] { Library("libm.so.6").take(nothing, "no_such_function"); },
                ThrowsMessage<NotInstalled>("libm.so.6: has no no_such_function"));
}

TEST(Mujoco, IsOfTheHeadersVersion) {
    EXPECT_EQ(mujoco_version(),
              fmt::format("{:.1f}.{}", mjVERSION_HEADER / 10 / 10.0, mjVERSION_HEADER % 10));
    mjvCamera camera{};
    mujoco().mjv_defaultCamera(&camera);
    EXPECT_EQ(camera.fixedcamid, -1);
}

TEST(Mujoco, MissingIsOneLineThatNamesThePackage) {
    EXPECT_THAT([] { Mujoco("libno_mujoco.so"); },
                ThrowsMessage<NotInstalled>(
                    AllOf(StartsWith("MuJoCo " + mujoco_version() + " is not there"),
                          HasSubstr("apt-get install " + mujoco_package()),
                          HasSubstr("libno_mujoco.so"), Not(HasSubstr("\n")))));
}

TEST(Mujoco, AnotherLibraryIsNotTakenForIt) {
    EXPECT_THAT([] { Mujoco("libm.so.6"); },
                ThrowsMessage<NotInstalled>(HasSubstr("libm.so.6: has no mj_version")));
}

}  // namespace
}  // namespace limpet::loaded
