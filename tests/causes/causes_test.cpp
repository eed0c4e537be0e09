// SPDX-License-Identifier: Apache-2.0
#include "limpet/causes/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "limpet/core/errors.hpp"

namespace limpet::causes {
namespace {

constexpr std::size_t kSets = 1U << kCauses;

TEST(Causes, EveryInputSaysItsSourceAndIsDrawnAboutWhereItWasSimulated) {
    for (const CauseInput& input : cause_inputs()) {
        SCOPED_TRACE(input.name);
        EXPECT_FALSE(input.prior.empty());
        EXPECT_FALSE(input.source.empty());
        RandomStream random(1, 0, Stream::test);
        double least = input.draw(random), most = least;
        for (int k = 0; k < 1000; ++k) {
            const double drawn = input.draw(random);
            least = std::min(least, drawn);
            most = std::max(most, drawn);
        }
        EXPECT_LT(least, most);
        EXPECT_GE(input.as_simulated, least - 0.5 * (most - least));
        EXPECT_LE(input.as_simulated, most + 0.5 * (most - least));
    }
}

/// Sets that differ in nothing that the loop knows share a swing; each is that of its own point.
TEST(Causes, ADrawsSwingsAreTheLinearisedLoops) {
    const PriorDraws prior = draw_prior(2, 7, 2);
    std::size_t resting = 0;
    for (const std::size_t set : {std::size_t{0}, std::size_t{0b100101}, kSets - 1}) {
        for (const CauseDraw& draw : prior[set]) {
            const auto linear = [&] {
                return stability::linear_swing("perch_metal", overrides_of(draw.point));
            };
            if (!draw.swing.rests) {
                EXPECT_FALSE(linear()) << set;
            } else if (const stability::Mode mode = linear().value();
                       is_swing(mode) || mode.growth_1_s > 0.0) {
                EXPECT_EQ(draw.swing.growth_1_s, mode.growth_1_s) << set;
                EXPECT_EQ(draw.swing.frequency_Hz, mode.frequency_Hz) << set;
            } else {
                EXPECT_EQ(draw.swing.growth_1_s, PointSwing::kNone_1_s) << set;
            }
            resting += draw.swing.rests ? 1 : 0;
        }
    }
    EXPECT_GE(resting, 3U);
    // As simulated it swings with neither motors nor air.
    constexpr std::size_t kMotorsAndAir = 0b100001;
    EXPECT_EQ(prior[kMotorsAndAir][1].simulated.growth_1_s, prior[0][1].swing.growth_1_s);
}

TEST(Causes, AFaultComesOutAndNoRestIsNone) {
    const auto with = [](const stability::SwingOf& linear) {
        return swing_of(as_simulated(), linear);
    };
    EXPECT_THROW((void)with([](const auto&, const auto&) -> std::optional<stability::Mode> {
                     throw InternalError("a broken promise");
                 }),
                 InternalError);
    EXPECT_FALSE(with([](const auto&, const auto&) { return std::nullopt; }).rests);
    EXPECT_TRUE(swing_of(as_simulated()).rests);
}

/// Where nothing is pushed and nothing grows the swing stays; a constant density adds up.
TEST(Causes, TheSwingsSizeIsTheClosedForm) {
    const SwingSize size{.start_deg = 0.3};
    CausePoint point = as_simulated();
    const auto swings = [](double growth_1_s) { return PointSwing{true, growth_1_s, 0.6}; };
    EXPECT_DOUBLE_EQ(swing_deg(size, point, swings(0.0), 16.0), 0.3);
    EXPECT_DOUBLE_EQ(swing_deg(size, point, swings(-0.4), 16.0), 0.3);
    EXPECT_NEAR(swing_deg(size, point, swings(0.1), 10.0), 0.3 * std::exp(1.0), 1e-12);
    point[kMoment] = 0.05;
    const double turn = 2.0 * kPi * 0.6, inertia = 0.1 + 3.2 * 0.46 * 0.46;
    const double density = 2.0 * 0.05 * 0.05 * 0.5 / (1.0 + turn * turn * 0.25);
    const double pushed = density / std::pow(inertia * turn, 2) * 16.0;
    EXPECT_NEAR(swing_deg(size, point, swings(0.0), 16.0),
                std::sqrt(0.09 + std::pow(degrees(1.0), 2) * pushed), 1e-9);
}

/// Vehicles of the prior show a swing; said to within a tenth, the posterior's interval of the
/// growth holds theirs, and which causes took part is told better than by guessing.
TEST(Causes, SyntheticTruthsAreRecovered) {
    constexpr int kTruths = 100;
    const PriorDraws prior = draw_prior(24, 7, 2);  // some seconds
    const SwingSize size{.start_deg = 0.2, .metal_scatter = 0.35, .concrete_scatter = 0.35};
    int held = 0, asked = 0;
    double surprise = 0.0;
    for (std::uint32_t k = 0; asked < kTruths; ++k) {
        RandomStream random(77, k, Stream::test);
        const auto set = static_cast<std::size_t>(random.uniform() * kSets);
        const CausePoint truth = draw_point(set, random);
        const PointSwing swing = swing_of(truth);
        if (!swing.rests) {
            continue;  // shows nothing
        }
        const auto shown = [&](double wait_s, double scatter) {
            return swing_deg(size, truth, swing, wait_s) * std::exp(scatter * random.normal());
        };
        const double metal = shown(kMetalWait_s, size.metal_scatter);
        const double concrete = shown(kConcreteWait_s, size.concrete_scatter);
        const SwingStatement said{.metal_from_deg = metal / 1.1,
                                  .metal_to_deg = metal * 1.1,
                                  .concrete_from_deg = concrete / 1.1,
                                  .concrete_to_deg = concrete * 1.1,
                                  .simulated_to_deg = 1e9};
        const CausePosterior posterior = weigh(prior, size, said);
        const auto of = [](const CauseDraw& draw) { return draw.swing.growth_1_s; };
        ++asked;
        held += posterior.quantile(of, 0.025) <= swing.growth_1_s &&
                        swing.growth_1_s <= posterior.quantile(of, 0.975)
                    ? 1
                    : 0;
        const std::vector<double> all = posterior.set_probabilities();
        surprise -= std::log2(all[set]);
        EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1.0, 1e-9);
    }
    SCOPED_TRACE(testing::Message() << held << " of " << asked);
    EXPECT_GE(held, 0.90 * asked);
    EXPECT_LE(held, 0.99 * asked);
    EXPECT_LT(surprise / kTruths, kCauses - 0.1);  // bits: guessing has six
}

}  // namespace
}  // namespace limpet::causes
