// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limpet/core/random.hpp"

namespace limpet::study {
namespace {

/// x normal(0, 1), seen once as 1 with a deviation of 1: normal(1/2, 1/sqrt 2), evidence
/// exp(-1/4) / sqrt(4 pi).
TEST(Posterior, ANormalSeenOnceIsTheClosedForm) {
    RandomStream random(1, 0, Stream::test);
    std::vector<double> x;
    Weighted weighted;
    for (int k = 0; k < 40000; ++k) {
        x.push_back(random.normal());
        weighted.weights.push_back(std::exp(-0.5 * std::pow(x.back() - 1.0, 2)) /
                                   std::sqrt(2.0 * kPi));
    }
    EXPECT_NEAR(weighted.evidence(), std::exp(-0.25) / std::sqrt(4.0 * kPi), 0.003);
    EXPECT_NEAR(weighted.mean(x), 0.5, 0.02);
    EXPECT_NEAR(weighted.quantile(x, 0.025), 0.5 - 1.96 * std::sqrt(0.5), 0.05);
    EXPECT_NEAR(weighted.quantile(x, 0.975), 0.5 + 1.96 * std::sqrt(0.5), 0.05);
    EXPECT_GT(weighted.effective(), 20000.0);
    EXPECT_LT(weighted.effective(), 40000.0);
}

/// Two kinds that a measurement parts wholly tell one bit; one that knows nothing, none.
TEST(Posterior, InformationIsOneBitOrNone) {
    RandomStream random(2, 0, Stream::test);
    std::vector<std::size_t> kinds;
    std::vector<double> clear, blind, weights;
    for (int k = 0; k < 20000; ++k) {
        kinds.push_back(random.uniform() < 0.5 ? 0 : 1);
        clear.push_back(10.0 * static_cast<double>(kinds.back()) + random.normal());
        blind.push_back(random.normal());
        weights.push_back(random.uniform());
    }
    EXPECT_NEAR(information_bits(kinds, clear, weights, 20), 1.0, 0.03);
    EXPECT_NEAR(information_bits(kinds, blind, weights, 20), 0.0, 0.005);
}

}  // namespace
}  // namespace limpet::study
