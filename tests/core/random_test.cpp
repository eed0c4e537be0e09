// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet {
namespace {

TEST(Random, SameKeySameNumbers) {
    RandomStream a(7, 3, Stream::test);
    RandomStream b(7, 3, Stream::test);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(a.normal(), b.normal());
        EXPECT_EQ(a.uniform(), b.uniform());
    }
}

TEST(Random, SeedRunAndStreamEachChangeTheNumbers) {
    const double reference = RandomStream(7, 3, Stream::test).uniform();
    EXPECT_NE(reference, RandomStream(8, 3, Stream::test).uniform());
    EXPECT_NE(reference, RandomStream(7, 4, Stream::test).uniform());
    EXPECT_NE(reference, RandomStream(7, 3, Stream::imu).uniform());
    EXPECT_NE(reference, RandomStream(7 + (1ULL << 32U), 3, Stream::test).uniform());
}

TEST(Random, CopyContinuesAlike) {
    RandomStream a(1, 0, Stream::test);
    (void)a.normal();  // leaves one of a pair behind
    RandomStream b = a;
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(a.normal(), b.normal());
    }
}

TEST(Random, MomentsOfTheNormal) {
    RandomStream random(42, 0, Stream::test);
    constexpr int kDraws = 200000;
    double sum = 0.0;
    double square = 0.0;
    double fourth = 0.0;
    for (int i = 0; i < kDraws; ++i) {
        const double x = random.normal();
        sum += x;
        square += x * x;
        fourth += x * x * x * x;
    }
    const double five_sigma = 5.0 / std::sqrt(static_cast<double>(kDraws));
    EXPECT_NEAR(sum / kDraws, 0.0, five_sigma);
    EXPECT_NEAR(square / kDraws, 1.0, std::sqrt(2.0) * five_sigma);
    EXPECT_NEAR(fourth / kDraws, 3.0, std::sqrt(96.0) * five_sigma);
}

TEST(Random, LognormalHasItsMedian) {
    RandomStream random(5, 0, Stream::test);
    constexpr int kDraws = 20000;
    int below = 0;
    for (int i = 0; i < kDraws; ++i) {
        below += random.lognormal(31.5, 0.3) < 31.5 ? 1 : 0;
    }
    EXPECT_NEAR(below / static_cast<double>(kDraws), 0.5, 5.0 * 0.5 / std::sqrt(1.0 * kDraws));
}

}  // namespace
}  // namespace limpet
