// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "limpet/compare/compare.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::compare {
namespace {

/// What happened in a recording, as if it were the reference.
std::vector<EventPair> happenings(const record::Recording& recording) {
    std::vector<EventPair> found;
    for (const record::RecordedEvent& event : recording.events) {
        if (!event.is(EventName::parameter_set)) {
            found.push_back({event.name, 1, event.time_s, kNaN});
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.reference_s < b.reference_s; });
    std::map<std::string, int> counts;
    for (EventPair& happening : found) {
        happening.occurrence = ++counts[happening.name];
    }
    return found;
}

/// The longest run of common events that have the same order in both flights.
std::vector<EventPair> in_same_order(const std::vector<EventPair>& events) {
    std::vector<EventPair> common;
    std::copy_if(events.begin(), events.end(), std::back_inserter(common),
                 [](const EventPair& pair) { return pair.in_both(); });
    std::vector<std::size_t> length(common.size(), 1);
    std::vector<std::size_t> before(common.size());
    for (std::size_t i = 0; i < common.size(); ++i) {
        before[i] = i;
        for (std::size_t j = 0; j < i; ++j) {
            if (common[j].other_s <= common[i].other_s && length[j] + 1 > length[i]) {
                length[i] = length[j] + 1;
                before[i] = j;
            }
        }
    }
    std::vector<EventPair> ordered;
    const auto longest = std::max_element(length.begin(), length.end());
    for (auto i = static_cast<std::size_t>(longest - length.begin()); i < common.size();
         i = before[i]) {
        ordered.push_back(common[i]);
        if (before[i] == i) {
            break;
        }
    }
    std::reverse(ordered.begin(), ordered.end());
    return ordered;
}

/// The first common occurrence of the event to align at.
const EventPair& anchor(const std::vector<EventPair>& events, const Alignment& alignment) {
    std::vector<std::string> names;
    for (const EventPair& pair : events) {
        if (pair.in_both() && pair.name == alignment.event) {
            return pair;
        }
        if (pair.in_both() && pair.occurrence == 1) {
            names.push_back(pair.name);
        }
    }
    throw InputError(
        fmt::format("--align {}: no such event in both flights; they share: {}", alignment.event,
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// A stretch that begins at given times in both and ends where the shorter one ends.
Piece piece(std::string from, const record::Window& reference, const record::Window& other) {
    const double span_s = std::max(0.0, std::min(reference.span_s(), other.span_s()));
    return {.from = std::move(from),
            .window = {reference.from_s, reference.from_s + span_s},
            .shift_s = other.from_s - reference.from_s,
            .reference_left_out_s = std::max(0.0, reference.span_s() - span_s),
            .other_left_out_s = std::max(0.0, other.span_s() - span_s)};
}

/// One shift for the whole flight; what lies before the other's beginning is left out too.
Piece shifted(const record::Window& reference, const record::Window& other, double shift_s) {
    const record::Window window{std::max(reference.from_s, other.from_s - shift_s),
                                std::min(reference.to_s, other.to_s - shift_s)};
    const double span_s = std::max(0.0, window.span_s());
    return {.from = "start",
            .window = window,
            .shift_s = shift_s,
            .reference_left_out_s = reference.span_s() - span_s,
            .other_left_out_s = other.span_s() - span_s};
}

std::vector<Piece> by_events(const std::vector<EventPair>& events, const record::Window& reference,
                             const record::Window& other) {
    const std::vector<EventPair> common = in_same_order(events);
    if (common.empty()) {
        throw InputError(
            "no common event to align at; --align start lays the flights over each other");
    }
    std::vector<Piece> pieces;
    std::string from = "start";
    record::Window of_reference = reference;
    record::Window of_other = other;
    const auto end_at = [&](double reference_s, double other_s) {
        of_reference.to_s = reference_s;
        of_other.to_s = other_s;
        if (of_reference.span_s() > 0.0 || of_other.span_s() > 0.0) {
            pieces.push_back(piece(from, of_reference, of_other));
        }
    };
    const auto end_at_event = [&](const EventPair& event) {
        end_at(event.reference_s, event.other_s);
        const double shift_s = event.other_s - event.reference_s;
        if (pieces.empty() || pieces.back().shift_s == shift_s ||
            pieces.back().window.span_s() <= 0.0) {
            return;
        }
        Piece& first = pieces.back();
        const double half_s = first.window.span_s() / 2.0;
        first.window.to_s = first.window.from_s + half_s;
        pieces.push_back({.from = from,
                          .window = {event.reference_s - half_s, event.reference_s},
                          .shift_s = shift_s});
    };
    for (const EventPair& event : common) {
        end_at_event(event);
        from = event.name;
        of_reference.from_s = event.reference_s;
        of_other.from_s = event.other_s;
    }
    end_at(reference.to_s, other.to_s);
    return pieces;
}

}  // namespace

bool EventPair::in_both() const {
    return !std::isnan(reference_s) && !std::isnan(other_s);
}

std::vector<EventPair> pair_events(const record::Recording& reference,
                                   const record::Recording& other) {
    std::vector<EventPair> pairs = happenings(reference);
    for (EventPair event : happenings(other)) {
        std::swap(event.reference_s, event.other_s);
        const auto same = std::find_if(pairs.begin(), pairs.end(), [&event](const EventPair& pair) {
            return pair.name == event.name && pair.occurrence == event.occurrence;
        });
        if (same != pairs.end()) {
            same->other_s = event.other_s;
            continue;
        }
        const auto later =
            std::find_if(pairs.begin(), pairs.end(), [&event](const EventPair& pair) {
                return pair.other_s > event.other_s || pair.reference_s > event.other_s;
            });
        pairs.insert(later, event);
    }
    return pairs;
}

std::vector<Piece> align(const std::vector<EventPair>& events, const record::Window& reference,
                         const record::Window& other, const Alignment& alignment) {
    switch (alignment.by) {
        case Alignment::By::events: return by_events(events, reference, other);
        case Alignment::By::start:
        case Alignment::By::event:
            return {shifted(reference, other, base_shift_s(events, reference, other, alignment))};
    }
    throw InternalError("alignment out of range");
}

double base_shift_s(const std::vector<EventPair>& events, const record::Window& reference,
                    const record::Window& other, const Alignment& alignment) {
    if (alignment.by == Alignment::By::event) {
        const EventPair& at = anchor(events, alignment);
        return at.other_s - at.reference_s;
    }
    return other.from_s - reference.from_s;
}

}  // namespace limpet::compare
