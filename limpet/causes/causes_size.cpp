// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/causes/causes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::causes {
namespace {

/// Beyond this nothing is linear any more: a swing there is only known to be as large.
constexpr double kMost_deg = 12.0;

/// Of the vehicle that waits.
double mass_kg() {
    static const double known = scenario::load_scenario(kMetalMission).airframe.mass_kg;
    return known;
}

/// A mission that has been flown, and what the closed form knows of it.
struct Mission {
    CausePoint point;
    double waited_s = 0.0;
    PointSwing swing;
    double flown_deg = kNaN;
    [[nodiscard]] bool counts() const { return swing.rests && flown_deg > 0.0; }
};

/// Of what a mission has shown; a swing of a hundred has another cause that the form does not know.
double log_likelihood(const WaitSize& size, const Mission& one) {
    constexpr double kStrange = 0.01;
    const ExpectedSwing expected = expected_swing(size, one.point, one.swing, one.waited_s);
    const double z =
        std::log(std::min(one.flown_deg, kMost_deg) / expected.middle_deg) / expected.scatter;
    const double density = one.flown_deg < kMost_deg
                               ? std::exp(-0.5 * z * z) / (expected.scatter * std::sqrt(2.0 * kPi))
                               : 1.0 - normal_probability(z);
    return std::log((1.0 - kStrange) * density + kStrange);
}

double log_likelihood(const WaitSize& size, const std::vector<const Mission*>& missions) {
    double sum = 0.0;
    for (const Mission* one : missions) {
        sum += log_likelihood(size, *one);
    }
    return sum;
}

/// Maximum likelihood by a search along each number in turn, its steps halved when none gains.
WaitSize fitted(const std::vector<const Mission*>& missions) {
    require(missions.size() > 3, "flights enough to measure the swing");
    WaitSize best{.settled_deg = 0.5, .start_deg = 0.5, .scatter = 0.3, .growth_error_1_s = 0.03};
    struct Range {
        double WaitSize::*number;
        double least, most;
    };
    constexpr std::array<Range, 4> kRanges = {{{&WaitSize::settled_deg, 0.01, 3.0},
                                               {&WaitSize::start_deg, 0.01, 3.0},
                                               {&WaitSize::scatter, 0.05, 2.0},
                                               {&WaitSize::growth_error_1_s, 0.001, 0.3}}};
    double most = log_likelihood(best, missions);
    for (double step = 0.4; step > 0.005;) {
        bool gained = false;
        for (const Range& range : kRanges) {
            for (const double sign : {-1.0, 1.0}) {
                WaitSize tried = best;
                tried.*range.number =
                    std::clamp(best.*range.number * std::exp(sign * step), range.least, range.most);
                const double found = log_likelihood(tried, missions);
                if (found > most + 1e-9) {
                    most = found;
                    best = tried;
                    gained = true;
                }
            }
        }
        step *= gained ? 1.0 : 0.5;
    }
    return best;
}

bool is_held(const WaitSize& size, const Mission& one) {
    const ExpectedSwing expected = expected_swing(size, one.point, one.swing, one.waited_s);
    const double z = std::log(one.flown_deg / expected.middle_deg) / expected.scatter;
    const double at_most_z = std::log(kMost_deg / expected.middle_deg) / expected.scatter;
    return std::abs(z) <= statistics::kNormal95 ||
           (one.flown_deg >= kMost_deg && at_most_z <= statistics::kNormal95);
}

}  // namespace

double ExpectedSwing::probability(double from_deg, double to_deg) const {
    const auto below = [this](double deg) {
        return deg > 0.0 ? normal_probability(std::log(deg / middle_deg) / scatter) : 0.0;
    };
    return below(to_deg) - below(from_deg);
}

ExpectedSwing expected_swing(const WaitSize& size, const CausePoint& point, const PointSwing& swing,
                             double waited_s) {
    constexpr double kSlowest_Hz = 0.2, kStanding_1_s = 1e-6;
    const double turn_rad_s = 2.0 * kPi * std::max(kSlowest_Hz, swing.frequency_Hz);
    const double inertia = point[kInertia] + mass_kg() * point[kJointX] * point[kJointX];
    const double memory_s = point[kCorrelation];
    // Two-sided spectral density of the moment at the swing's frequency; what it adds to the
    // squared amplitude in a second.
    const double density = 2.0 * point[kMoment] * point[kMoment] * memory_s /
                           (1.0 + std::pow(turn_rad_s * memory_s, 2));
    const double pushed = std::pow(degrees(1.0), 2) * density / std::pow(inertia * turn_rad_s, 2);
    const double growth_1_s = swing.growth_1_s;
    const double grown = std::exp(2.0 * growth_1_s * waited_s);
    const double gathered_s =
        std::abs(growth_1_s) < kStanding_1_s ? waited_s : (grown - 1.0) / (2.0 * growth_1_s);
    const double stays = size.settled_deg * size.settled_deg;
    const double grows = size.start_deg * size.start_deg * grown + pushed * gathered_s;
    const double by_growth = size.growth_error_1_s * waited_s * grows / (stays + grows);
    return {std::sqrt(stays + grows), std::hypot(size.scatter, by_growth)};
}

double flown_swing_deg(const char* wait, const CausePoint& point, std::uint32_t run) {
    stability::Overrides overrides = overrides_of(point);
    overrides.emplace_back("guidance.oscillation_limit_deg=60");
    // The paper's method holds the attitude level; here a lean before the wall would be taken for
    // wind, in which the altitude is held as well.
    overrides.emplace_back("guidance.calm_lean_deg=60");
    const auto model =
        simulation::build_model(scenario::load_scenario(wait, {.overrides = overrides}));
    return simulation::fly(model, {}, {}, run).metrics.pitch_swing_deg;
}

SwingSize measure_size(std::size_t points, int jobs) {
    constexpr std::size_t kSeeds = 2;
    std::vector<Mission> missions(2 * kSeeds * points);
    for_each_index(missions.size(), jobs, [&](std::size_t k) {
        Mission& one = missions[k];
        const bool metal = k % 2 == 0;
        const auto place = static_cast<std::uint32_t>(k / (2 * kSeeds));
        RandomStream random(29, place, Stream::scenario);
        const auto set = static_cast<std::size_t>(random.uniform() * (1U << kCauses));
        one.point = draw_point(set, random);
        one.waited_s = metal ? kMetalWait_s : kConcreteWait_s;
        one.swing = swing_of(one.point);
        one.flown_deg = flown_swing_deg(metal ? kMetalMission : kConcreteMission, one.point,
                                        static_cast<std::uint32_t>(k));
    });
    SwingSize found;
    std::size_t asked = 0, held = 0;
    for (const bool metal : {true, false}) {
        std::array<std::vector<const Mission*>, 2> halves;
        for (std::size_t k = 0; k < missions.size(); ++k) {
            if ((k % 2 == 0) == metal && missions[k].counts()) {
                halves[k / (2 * kSeeds) % 2].push_back(&missions[k]);
            }
        }
        WaitSize& wait = metal ? found.metal : found.concrete;
        wait = fitted(halves[0]);
        found.flights += halves[0].size();
        for (const Mission* one : halves[1]) {
            ++asked;
            held += is_held(wait, *one) ? 1 : 0;
        }
    }
    require(asked > 0, "flights to hold the swing's size against");
    found.held = static_cast<double>(held) / static_cast<double>(asked);
    found.without_figure = static_cast<double>(std::count_if(
                               missions.begin(), missions.end(),
                               [](const Mission& one) { return !(one.flown_deg > 0.0); })) /
                           static_cast<double>(missions.size());
    return found;
}

}  // namespace limpet::causes
