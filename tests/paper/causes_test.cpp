// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace limpet::paper {
namespace {

/// Fitted once for all tests: four hundred points of the linearised loop, some seconds.
const SwingSurrogate& swing() {
    static const SwingSurrogate fitted = fit_swing(400, 2);
    return fitted;
}

TEST(Causes, EveryInputSaysItsSourceAndStaysWithinWhatTheSurrogateSaw) {
    for (const CauseInput& input : cause_inputs()) {
        SCOPED_TRACE(input.name);
        EXPECT_FALSE(input.prior.empty());
        EXPECT_FALSE(input.source.empty());
        EXPECT_GE(input.as_simulated, input.range.low);
        EXPECT_LE(input.as_simulated, input.range.high);
        RandomStream random(1, 0, Stream::test);
        for (int k = 0; k < 1000; ++k) {
            const double drawn = input.draw(random);
            EXPECT_GE(drawn, input.range.low);
            EXPECT_LE(drawn, input.range.high);
        }
    }
}

/// What the map of the page says at its own points (docs/decisions/0010).
TEST(Causes, TheSurrogateIsTheLinearisedLoop) {
    EXPECT_LT(swing().growth_1_s.left_out_rms(), 0.05);
    EXPECT_GT(swing().growth_1_s.predicted_share(), 0.9);
    const CausePoint nominal = as_simulated();
    const stability::Mode exact = stability::linear_swing("perch_metal", overrides_of(nominal));
    EXPECT_NEAR(swing().growth_1_s(nominal.head(swing_columns())), exact.growth_1_s, 0.1);
    EXPECT_NEAR(swing().frequency_Hz(nominal.head(swing_columns())), exact.frequency_Hz, 0.06);
}

/// Where nothing is pushed and nothing grows the swing stays; a constant density adds up.
TEST(Causes, TheSwingsSizeIsTheClosedForm) {
    const SwingSize size{.start_deg = 0.3};
    CausePoint point = as_simulated();
    EXPECT_DOUBLE_EQ(swing_deg(size, point, 0.0, 0.6, 16.0), 0.3);
    EXPECT_NEAR(swing_deg(size, point, 0.1, 0.6, 10.0), 0.3 * std::exp(1.0), 1e-12);
    for (Eigen::Index i = 0; i < point.size(); ++i) {
        if (cause_inputs()[static_cast<std::size_t>(i)].name.find("unsteady") == 0) {
            point[i] = 0.05;
        }
    }
    const double turn = 2.0 * kPi * 0.6, inertia = 0.1 + 3.2 * 0.46 * 0.46;
    const double density = 2.0 * 0.05 * 0.05 * 0.5 / (1.0 + turn * turn * 0.25);
    const double pushed = density / std::pow(inertia * turn, 2) * 16.0;
    EXPECT_NEAR(swing_deg(size, point, 0.0, 0.6, 16.0),
                std::sqrt(0.09 + std::pow(degrees(1.0), 2) * pushed), 1e-9);
}

/// Vehicles drawn from the prior show a swing; said to within a tenth, the posterior's interval of
/// the growth holds theirs, and which causes took part is told better than by guessing.
TEST(Causes, SyntheticTruthsAreRecovered) {
    constexpr int kTruths = 100;
    constexpr std::size_t kDraws = 400;
    const SwingSize size{.start_deg = 0.2, .metal_scatter = 0.35, .concrete_scatter = 0.35};
    int held = 0, asked = 0;
    double surprise = 0.0;
    for (int k = 0; k < kTruths; ++k) {
        RandomStream random(77, static_cast<std::uint32_t>(k), Stream::test);
        const auto subset = static_cast<std::size_t>(random.uniform() * (1U << kCauses));
        const CausePoint truth = draw_point(subset, random);
        const double growth = swing().growth_1_s(truth.head(swing_columns()));
        const double frequency = swing().frequency_Hz(truth.head(swing_columns()));
        const double missed = swing().growth_1_s.left_out_rms();
        const auto shown = [&](double wait_s, double scatter) {
            return swing_deg(size, truth, growth, frequency, wait_s) *
                   std::exp(scatter * random.normal());
        };
        const double metal = shown(kMetalWait_s, std::hypot(size.metal_scatter, 16.0 * missed));
        const double concrete = shown(kConcreteWait_s, size.concrete_scatter);
        const SwingSaid said{.metal_from_deg = metal / 1.1,
                             .metal_to_deg = metal * 1.1,
                             .concrete_from_deg = concrete / 1.1,
                             .concrete_to_deg = concrete * 1.1,
                             .simulated_to_deg = 1e9};
        const CausePosterior posterior = weigh(swing(), size, said, kDraws, 1000U + k);
        const auto of = [](const SubsetDraws& draws, std::size_t i) { return draws.growth_1_s[i]; };
        ++asked;
        held += posterior.quantile(of, 0.025) <= growth && growth <= posterior.quantile(of, 0.975)
                    ? 1
                    : 0;
        const std::vector<double> all = posterior.subset_probabilities();
        surprise -= std::log2(all[subset]);
        EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, 1e-9);
    }
    SCOPED_TRACE(testing::Message() << held << " of " << asked);
    EXPECT_GE(held, 0.90 * asked);
    EXPECT_LE(held, 0.99 * asked);
    EXPECT_LT(surprise / kTruths, static_cast<double>(kCauses));  // bits: guessing has six
}

}  // namespace
}  // namespace limpet::paper
