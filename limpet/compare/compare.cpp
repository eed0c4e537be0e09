// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::compare {
namespace {

FlightIdentity identity(const FlightTrace& flight) {
    const record::Window whole = whole_flight(*flight.recording);
    return {flight.label, flight.recording->path.string(), summary(*flight.recording), whole.from_s,
            whole.to_s};
}

Extremes extremes(const FlightChannel& channel) {
    Extremes found{kNaN, kNaN};
    for (const double value : channel.values) {
        found.lowest = std::fmin(found.lowest, value);
        found.highest = std::fmax(found.highest, value);
    }
    return found;
}

/// What an instant of the reference is called: its state of guidance, or the event before.
std::string name_of(double time_s, const std::vector<record::Phase>& phases,
                    const std::vector<Piece>& pieces) {
    std::string name = phases.empty() ? "start" : phases.back().state;
    for (const Piece& piece : pieces) {
        name = phases.empty() && piece.window.from_s <= time_s ? piece.from : name;
    }
    const auto phase =
        std::find_if(phases.begin(), phases.end(), [time_s](const record::Phase& one) {
            return one.window.holds(time_s) && time_s < one.window.to_s;
        });
    return phase == phases.end() ? name : phase->state;
}

ChannelDifference compare_channel(const FlightChannel& reference, const FlightChannel& other,
                                  const std::vector<Piece>& pieces,
                                  const std::vector<record::Phase>& phases) {
    ChannelDifference result{.name = reference.name,
                             .unit = reference.unit,
                             .kind = reference.kind,
                             .reference = extremes(reference),
                             .other = extremes(other)};
    double squares = 0.0;
    const Differences all = differences(reference, other, pieces);
    for (std::size_t i = 0; i < all.time_s.size(); ++i) {
        const double difference = std::abs(all.values[i]);
        if (std::isnan(difference)) {
            continue;
        }
        if (result.samples == 0 || difference > result.largest) {
            result.largest = difference;
            result.at_s = all.time_s[i];
        }
        squares += difference * difference;
        ++result.samples;
    }
    if (result.samples > 0) {
        result.rms = std::sqrt(squares / static_cast<double>(result.samples));
        result.phase = name_of(result.at_s, phases, pieces);
    }
    return result;
}

/// The numbers of a flight's own summary.
std::vector<std::pair<std::string, double>> metrics(const record::Recording& recording) {
    std::vector<std::pair<std::string, double>> found;
    const auto json =
        nlohmann::ordered_json::parse(record::summary_text(recording), nullptr, false);
    if (!json.is_object() || !json.contains("metrics") || !json["metrics"].is_object()) {
        return found;
    }
    for (const auto& [name, value] : json["metrics"].items()) {
        if (value.is_number()) {
            found.emplace_back(name, value.get<double>());
        }
    }
    return found;
}

void add_rest(std::vector<FlightFigure>& figures, const record::Recording& reference,
              const record::Recording& other) {
    const auto a = rest_of(reference);
    const auto b = rest_of(other);
    if (!a && !b) {
        return;
    }
    for (const auto& [name, field] : kRestNumbers) {
        figures.push_back({name, a ? (*a).*field : kNaN, b ? (*b).*field : kNaN});
    }
    const auto share_off = [](const std::optional<Rest>& rest) {
        return rest ? rest->hanging_load_N / rest->weight_N - 1.0 : kNaN;
    };
    figures.push_back({"rest_hanging_load_off_weight", share_off(a), share_off(b), true});
}

std::vector<FlightFigure> figures_of(const record::Recording& reference,
                                     const record::Recording& other) {
    std::vector<FlightFigure> figures;
    for (const auto& [name, value] : metrics(reference)) {
        figures.push_back({name, value, kNaN});
    }
    for (const auto& [name, value] : metrics(other)) {
        if (FlightFigure* same = find_named(figures, name)) {
            same->other = value;
        } else {
            figures.push_back({name, kNaN, value});
        }
    }
    add_rest(figures, reference, other);
    return figures;
}

/// Names the flights that an InputError is about.
std::string both(const FlightComparison& comparison) {
    return comparison.reference.path + " and " + comparison.other.path;
}

void compare_channels(FlightComparison& comparison, const FlightTrace& reference,
                      const FlightTrace& other) {
    const std::vector<record::Phase> phases = record::phases(*reference.recording);
    for (const FlightChannel& channel : reference.channels) {
        const FlightChannel* same = find_named(other.channels, channel.name);
        if (same == nullptr) {
            comparison.only_in_reference.push_back(channel.name);
        } else {
            comparison.channels.push_back(
                compare_channel(channel, *same, comparison.pieces, phases));
        }
    }
    for (const FlightChannel& channel : other.channels) {
        if (find_named(reference.channels, channel.name) == nullptr) {
            comparison.only_in_other.push_back(channel.name);
        }
    }
    if (comparison.channels.empty()) {
        throw InputError(both(comparison) + ": no channel in common");
    }
}

}  // namespace

double FlightFigure::off() const {
    return against_zero ? std::abs(other) : std::abs(other - reference);
}

Differences differences(const FlightChannel& reference, const FlightChannel& other,
                        const std::vector<Piece>& pieces) {
    Differences found;
    const auto& t = reference.time_s;
    for (const Piece& piece : pieces) {
        const auto first = std::lower_bound(t.begin(), t.end(), piece.window.from_s);
        for (auto i = static_cast<std::size_t>(first - t.begin());
             i < t.size() && t[i] < piece.window.to_s; ++i) {
            found.time_s.push_back(t[i]);
            found.values.push_back(difference_of(reference.kind, reference.values[i],
                                                 value_at(other, t[i] + piece.shift_s)));
        }
    }
    return found;
}

Differences beyond_shift(const FlightChannel& reference, const FlightChannel& other,
                         const std::vector<Piece>& pieces, double shift_s) {
    Differences found;
    const auto& t = reference.time_s;
    for (const Piece& piece : pieces) {
        const auto first = std::lower_bound(t.begin(), t.end(), piece.window.from_s);
        for (auto i = static_cast<std::size_t>(first - t.begin());
             i < t.size() && t[i] < piece.window.to_s; ++i) {
            const double at_s = t[i] + piece.shift_s;
            const auto off = [&](double value) {
                return difference_of(reference.kind, reference.values[i], value);
            };
            double least = off(value_at(other, at_s)), low = least, high = least;
            const auto look = [&](double difference) {
                least = std::abs(difference) < std::abs(least) ? difference : least;
                low = std::min(low, difference);
                high = std::max(high, difference);
            };
            auto near = std::lower_bound(other.time_s.begin(), other.time_s.end(), at_s - shift_s);
            for (; near != other.time_s.end() && *near <= at_s + shift_s; ++near) {
                look(off(other.values[static_cast<std::size_t>(near - other.time_s.begin())]));
            }
            look(off(value_at(other, at_s - shift_s)));
            look(off(value_at(other, at_s + shift_s)));
            found.time_s.push_back(t[i]);
            found.values.push_back(low <= 0.0 && high >= 0.0 ? 0.0 : least);
        }
    }
    return found;
}

double FlightComparison::event_difference_s(const EventPair& event) const {
    return event.other_s - event.reference_s - base_shift_s;
}

FlightComparison compare(const FlightTrace& reference, const FlightTrace& other,
                         const Alignment& alignment) {
    FlightComparison comparison{.reference = identity(reference), .other = identity(other)};
    const record::Window of_reference{comparison.reference.from_s, comparison.reference.to_s};
    const record::Window of_other{comparison.other.from_s, comparison.other.to_s};
    comparison.events = pair_events(*reference.recording, *other.recording);
    try {
        comparison.pieces = align(comparison.events, of_reference, of_other, alignment);
        comparison.base_shift_s =
            base_shift_s(comparison.events, of_reference, of_other, alignment);
    } catch (const InputError& problem) {
        throw InputError(fmt::format("{}: {}", both(comparison), problem.what()));
    }
    comparison.figures = figures_of(*reference.recording, *other.recording);
    comparison.contacts = compare_contacts(*reference.recording, reference.channels,
                                           *other.recording, other.channels);
    compare_channels(comparison, reference, other);
    return comparison;
}

}  // namespace limpet::compare
