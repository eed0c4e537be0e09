// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/compare/compare.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/signals/cup_status.hpp"

namespace limpet::compare {
namespace {

/// A touch that seals and is lost at once has no curve to compare.
constexpr double kLeast_s = 0.1;
constexpr double kSearch_samples = 2.0;
constexpr int kSearchSteps = 40;  ///< of a golden section: to a billionth of the search

bool is(double phase, CupPhase wanted) {
    return phase == static_cast<double>(static_cast<int>(wanted));
}

/// A difference over a stretch at a shift.
struct Misfit {
    double largest = 0.0;
    double squares = 0.0;
    std::size_t samples = 0;
    [[nodiscard]] double rms() const {
        return samples == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(samples));
    }
};

Misfit misfit(const FlightChannel& reference, const FlightChannel& other,
              const record::Window& window, double shift_s) {
    Misfit sum;
    const auto& t = reference.time_s;
    auto i =
        static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), window.from_s) - t.begin());
    for (; i < t.size() && t[i] <= window.to_s; ++i) {
        const double difference = value_at(other, t[i] + shift_s) - reference.values[i];
        if (!std::isnan(difference)) {
            sum.largest = std::max(sum.largest, std::abs(difference));
            sum.squares += difference * difference;
            ++sum.samples;
        }
    }
    return sum;
}

double best_shift_s(const FlightChannel& reference, const FlightChannel& other,
                    const record::Window& window, double guess_s, double reach_s) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = guess_s - reach_s;
    double high = guess_s + reach_s;
    const auto cost = [&](double shift_s) {
        return misfit(reference, other, window, shift_s).squares;
    };
    for (int k = 0; k < kSearchSteps; ++k) {
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);
        (cost(a) < cost(b) ? high : low) = cost(a) < cost(b) ? b : a;
    }
    return 0.5 * (low + high);
}

/// The pressure that acts [hPa].
FlightChannel acting_pressure(const record::Recording& recording,
                              const std::vector<FlightChannel>& channels) {
    FlightChannel acting = *find_named(channels, "cup_pressure_hPa");
    const record::Table* table = find_table(recording, "/cup");
    const auto [pull, margin, pressure, phase] =
        columns_of<4>(table, {"pull_N", "pull_margin_N", "pressure_Pa", "phase"});
    if (pull == nullptr || !std::is_sorted(table->time_s.begin(), table->time_s.end())) {
        return acting;
    }
    // F = A (P_atm - P), the ripple adds to P alone: A by least squares over the sealed stretches.
    // Open, before the first touch, the cup has the pressure of the air.
    const bool opens = !phase->values.empty() && phase->values.front() == 0.0;
    const double ambient_Pa = opens ? pressure->values.front() : kAtmosphere_Pa;
    double force_force = 0.0;
    double force_vacuum = 0.0;
    std::vector<double> force(pull->values.size(), 0.0);
    for (std::size_t i = 0; i < force.size(); ++i) {
        if (phase->values[i] >= static_cast<double>(static_cast<int>(CupPhase::sealing))) {
            force[i] = pull->values[i] + margin->values[i];
            force_force += force[i] * force[i];
            force_vacuum += force[i] * (ambient_Pa - pressure->values[i]);
        }
    }
    if (!(force_force > 0.0 && force_vacuum > 0.0)) {
        return acting;
    }
    for (std::size_t i = 0; i < force.size(); ++i) {
        const double vacuum_Pa = force[i] * force_vacuum / force_force;
        acting.values[i] = hectopascals(ambient_Pa - vacuum_Pa);
    }
    return acting;
}

double sample_s(const FlightChannel& channel) {
    return channel.time_s.size() < 2 ? 0.0
                                     : (channel.time_s.back() - channel.time_s.front()) /
                                           static_cast<double>(channel.time_s.size() - 1);
}

/// A stretch of a flight in which the cup is sealed and the air flows one way.
struct SealStage {
    bool sealing = true;  ///< the pump draws, eq. (5); else the air comes back, eq. (6)
    record::Window window;
};

/// In time; none when the cup's phase was not recorded.
std::vector<SealStage> seal_stages(const std::vector<FlightChannel>& channels) {
    std::vector<SealStage> stages;
    const FlightChannel* phase = find_named(channels, "cup_phase");
    bool open = false;
    for (std::size_t i = 0; phase != nullptr && i < phase->values.size(); ++i) {
        const double value = phase->values[i];
        const bool sealing = is(value, CupPhase::sealing) || is(value, CupPhase::attached);
        const bool sealed = sealing || is(value, CupPhase::unsealing);
        if (sealed && (!open || stages.back().sealing != sealing)) {
            stages.push_back({sealing, {phase->time_s[i], phase->time_s[i]}});
        }
        open = sealed;
        if (open) {
            stages.back().window.to_s = phase->time_s[i];
        }
    }
    std::erase_if(stages, [](const SealStage& s) { return s.window.span_s() < kLeast_s; });
    return stages;
}

}  // namespace

std::vector<ContactDifference> compare_contacts(
    const record::Recording& reference, const std::vector<FlightChannel>& reference_channels,
    const record::Recording& other, const std::vector<FlightChannel>& other_channels) {
    const std::vector<SealStage> first = seal_stages(reference_channels);
    const std::vector<SealStage> second = seal_stages(other_channels);
    std::vector<ContactDifference> found;
    if (first.empty() || second.empty() ||
        find_named(reference_channels, "cup_pressure_hPa") == nullptr ||
        find_named(other_channels, "cup_pressure_hPa") == nullptr) {
        return found;
    }
    const FlightChannel a = acting_pressure(reference, reference_channels);
    const FlightChannel b = acting_pressure(other, other_channels);
    const double reach_s = kSearch_samples * std::max(sample_s(a), sample_s(b));
    for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k) {
        if (first[k].sealing != second[k].sealing) {
            break;  // from here on the flights differ
        }
        const double from_s = first[k].window.from_s;
        const double span_s = std::min(first[k].window.span_s(), second[k].window.span_s());
        // Both ends move with the shift: what lies within its reach may be of the stage next door.
        const record::Window window{from_s + reach_s, from_s + span_s - reach_s};
        const double guess_s = second[k].window.from_s - from_s;
        const double shift_s = best_shift_s(a, b, window, guess_s, reach_s);
        const Misfit left = misfit(a, b, window, shift_s);
        if (left.samples == 0) {
            continue;  // nothing was compared, which is not agreement
        }
        found.push_back({.sealing = first[k].sealing,
                         .reference_from_s = from_s,
                         .other_from_s = second[k].window.from_s,
                         .span_s = span_s,
                         .shift_s = shift_s,
                         .largest_hPa = left.largest,
                         .rms_hPa = left.rms()});
    }
    return found;
}

}  // namespace limpet::compare
