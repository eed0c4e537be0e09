// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/random.hpp"

#include <Random123/philox.h>
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

/// As the stream made them one block at a time: a block's second number first.
TEST(Random, TheNumbersAreThoseOfCountersInTurn) {
    constexpr std::uint64_t kSeed = 7 + (5ULL << 32U);
    RandomStream stream(kSeed, 3, Stream::test);
    for (std::uint32_t counter = 0; counter < 50; ++counter) {
        const auto block = r123::Philox4x32{}(
            {{counter, 0, 3, static_cast<std::uint32_t>(Stream::test)}}, {{7, 5}});
        for (const std::size_t word : {2U, 0U}) {
            const std::uint64_t bits = (std::uint64_t{block.v[word]} << 32U) | block.v[word + 1];
            EXPECT_EQ(stream.uniform(), static_cast<double>(bits >> 11U) * 0x1.0p-53) << counter;
        }
    }
}

/// Whatever the machine: counters over the edge of 32 and of 64 bits among them.
TEST(Random, EveryKindOfMachineDrawsTheSame) {
    for (const std::uint64_t counter : {0ULL, 12ULL, 0xfffffffdULL, 0xfffffffffffffffdULL}) {
        for (std::uint32_t run = 0; run < 50; ++run) {
            const std::uint64_t seed = 0x9e3779b97f4a7c15ULL * run;
            double here[kDrawn];
            double anywhere[kDrawn];
            draw_uniforms(seed, counter, run, 1000 - run, here);
            draw_uniforms_anywhere(seed, counter, run, 1000 - run, anywhere);
            for (std::size_t i = 0; i < kDrawn; ++i) {
                EXPECT_EQ(here[i], anywhere[i]) << counter << ' ' << run << ' ' << i;
            }
        }
    }
}

/// Normals are found several at once; in what order the two kinds are asked for is all the same.
TEST(Random, EveryNormalIsTheQuantileOfItsUniform) {
    RandomStream uniform(7, 3, Stream::test);
    RandomStream normal = uniform;
    for (int i = 0; i < 1000; ++i) {
        const double probability = uniform.uniform();
        if (i % 3 == 1) {
            EXPECT_EQ(normal.uniform(), probability);
        } else {
            EXPECT_EQ(normal.normal(), normal_quantile(probability + 0x1.0p-54));
        }
    }
}

TEST(NormalQuantile, InvertsTheDistributionInCentreFlankAndTail) {
    for (const double p : {1e-300, 1e-20, 1e-12, 1e-6, 0.01, 0.07, 0.08, 0.3, 0.5}) {
        const double z = normal_quantile(p);
        EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1.0, 1e-12) << p;
    }
    for (const double p : {0.6, 0.92, 0.93, 0.999}) {
        EXPECT_NEAR(normal_quantile(p), -normal_quantile(1.0 - p), 1e-13);
    }
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);  // any table
}

TEST(Random, CopyContinuesAlike) {
    RandomStream a(1, 0, Stream::test);
    (void)a.normal();  // leaves half of a block behind
    RandomStream b = a;
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(a.normal(), b.normal());
    }
}

TEST(Random, ABlendIsTheWeightedSumOfItsNoises) {
    RandomStream one(7, 3, Stream::test);
    RandomStream two(8, 3, Stream::test);
    RandomStream blend(99, 3, Stream::test, {{7, 3.0}, {8, -4.0}});
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
        const double z = blend.normal();
        EXPECT_NEAR(z, 0.6 * one.normal() - 0.8 * two.normal(), 1e-9);
        sum += z;
        squares += z * z;
    }
    EXPECT_NEAR(sum / kDraws, 0.0, 0.03);
    EXPECT_NEAR(squares / kDraws, 1.0, 0.05);
    RandomStream uniform(99, 3, Stream::test, {{7, 3.0}, {8, -4.0}});
    RandomStream normal(99, 3, Stream::test, {{7, 3.0}, {8, -4.0}});
    for (int i = 0; i < 100; ++i) {
        EXPECT_NEAR(uniform.uniform(), normal_probability(normal.normal()), 1e-12);
    }
}

TEST(Random, ABlendOfOneIsItsSeedAlone) {
    RandomStream seed(7, 3, Stream::test);
    RandomStream blend(99, 3, Stream::test, {{7, 0.2}});
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(seed.uniform(), blend.uniform());
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
