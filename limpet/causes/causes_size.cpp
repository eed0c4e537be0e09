// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/campaign/statistics.hpp"
#include "limpet/causes/causes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::causes {
namespace {

constexpr const char* kWaits[] = {"perch_metal", "perch_concrete"};

/// Of the vehicle that waits.
double mass_kg() {
    static const double known = scenario::load_scenario(kWaits[0]).airframe.mass_kg;
    return known;
}

double mean_square_left(const std::vector<double>& logs) {
    double squares = 0.0;
    for (const double one : logs) {
        squares += one * one;
    }
    return squares / static_cast<double>(logs.size());
}

}  // namespace

double swing_deg(const SwingSize& size, const CausePoint& point, const PointSwing& swing,
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
    // Of a swing that decays the largest is the start.
    return std::sqrt(size.start_deg * size.start_deg * std::max(1.0, grown) + pushed * gathered_s);
}

SwingSize measure_size(std::size_t points, int jobs) {
    constexpr std::size_t kAll = (1U << kCauses) - 1, kSeeds = 2;
    constexpr double kLeast_deg = 0.01, kMost_deg = 12.0;  // beyond nothing is linear any more
    struct Mission {
        CausePoint point;
        double waited_s = 0.0;
        PointSwing swing;
        double flown_deg = kNaN;
    };
    std::vector<Mission> missions(2 * kSeeds * points);
    for_each_index(missions.size(), jobs, [&](std::size_t k) {
        Mission& one = missions[k];
        const std::size_t place = k / (2 * kSeeds);
        const bool metal = k % 2 == 0;
        RandomStream random(29, static_cast<std::uint32_t>(place), Stream::scenario);
        one.point = draw_point(kAll, random);
        one.waited_s = metal ? kMetalWait_s : kConcreteWait_s;
        one.swing = swing_of(one.point);
        stability::Overrides overrides = overrides_of(one.point);
        overrides.emplace_back("guidance.oscillation_limit_deg=60");
        const auto model = simulation::build_model(
            scenario::load_scenario(kWaits[metal ? 0 : 1], {.overrides = overrides}));
        one.flown_deg =
            simulation::fly(model, {}, {}, static_cast<std::uint32_t>(k)).metrics.pitch_swing_deg;
    });
    const auto logs_of = [&](const SwingSize& size, bool metal, std::size_t half) {
        std::vector<double> logs;
        for (std::size_t k = 0; k < missions.size(); ++k) {
            const Mission& one = missions[k];
            // The same ones whatever size is tried.
            const bool counts =
                one.swing.rests && one.flown_deg > kLeast_deg && one.flown_deg < kMost_deg &&
                swing_deg(SwingSize{}, one.point, one.swing, one.waited_s) < kMost_deg;
            if ((k % 2 == 0) == metal && k / (2 * kSeeds) % 2 == half && counts) {
                const double expected = swing_deg(size, one.point, one.swing, one.waited_s);
                logs.push_back(std::log(one.flown_deg / expected));
            }
        }
        return logs;
    };
    SwingSize best;
    double least = std::numeric_limits<double>::infinity();
    constexpr int kStarts = 108;  // from 0.01 to 1.9 deg
    for (int k = 0; k < kStarts; ++k) {
        const double start_deg = 0.01 * std::pow(1.05, k);
        const SwingSize tried{.start_deg = start_deg};
        const auto metal = logs_of(tried, true, 0), concrete = logs_of(tried, false, 0);
        require(metal.size() > 3 && concrete.size() > 3, "flights enough to measure the swing");
        const double left = mean_square_left(metal) + mean_square_left(concrete);
        if (left < least) {
            least = left;
            best = {.start_deg = start_deg,
                    .metal_scatter = std::sqrt(mean_square_left(metal)),
                    .concrete_scatter = std::sqrt(mean_square_left(concrete)),
                    .flights = metal.size() + concrete.size()};
        }
    }
    std::size_t held = 0, asked = 0;
    for (const bool metal : {true, false}) {
        const double most =
            campaign::kNormal95 * (metal ? best.metal_scatter : best.concrete_scatter);
        for (const double left : logs_of(best, metal, 1)) {
            ++asked;
            held += std::abs(left) <= most ? 1 : 0;
        }
    }
    require(asked > 0, "flights to hold the swing's size against");
    best.held = static_cast<double>(held) / static_cast<double>(asked);
    return best;
}

}  // namespace limpet::causes
