// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "limpet/compare/report.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/user_text.hpp"

namespace limpet::compare {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

/// A difference that can be limited: its size and where it is.
struct Found {
    std::string name;
    double size = 0.0;
    std::string where = {};
};

Found worst_event(const FlightComparison& comparison) {
    Found worst{"event"};
    for (const EventPair& event : comparison.events) {
        const double off =
            event.in_both() ? std::abs(comparison.event_difference_s(event)) : kBeyond;
        if (off > worst.size) {
            worst.size = off;
            worst.where = event.occurrence > 1
                              ? fmt::format("{}, time {}", event.name, event.occurrence)
                              : event.name;
        }
    }
    return worst;
}

Found worst_contact(const FlightComparison& comparison) {
    const auto worst = std::max_element(
        comparison.contacts.rbegin(), comparison.contacts.rend(),
        [](const auto& a, const auto& b) { return a.largest_hPa < b.largest_hPa; });
    return {"contact_pressure_hPa", worst->largest_hPa,
            fmt::format("{} from {:.3f} s", worst->sealing ? "sealing" : "unsealing",
                        worst->reference_from_s)};
}

std::vector<Found> all_of(const FlightComparison& comparison) {
    // Flights without a recorded outcome are not alike.
    const std::string& expected = comparison.reference.summary.outcome;
    const std::string& outcome = comparison.other.summary.outcome;
    const bool alike = !expected.empty() && expected == outcome;
    std::vector<Found> all = {worst_event(comparison), {"outcome", alike ? 0.0 : 1.0, outcome}};
    if (!comparison.contacts.empty()) {
        all.push_back(worst_contact(comparison));
    }
    for (const FlightFigure& figure : comparison.figures) {
        all.push_back({figure.name, std::isnan(figure.off()) ? kBeyond : figure.off()});
    }
    for (const ChannelDifference& channel : comparison.channels) {
        if (channel.samples > 0) {
            all.push_back({channel.name, channel.largest,
                           fmt::format("at {:.3f} s, {}", channel.at_s, channel.phase)});
        }
    }
    return all;
}

}  // namespace

DifferenceLimit parse_limit(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    const auto most = equals == std::string::npos ? std::nullopt : decimal(text.substr(equals + 1));
    if (equals == 0 || !most || *most < 0.0) {
        throw InputError(fmt::format(
            "--limit {}: must be NAME=VALUE with a value of 0 or more, as in event=0.15", text));
    }
    return {text.substr(0, equals), *most};
}

std::vector<Excess> check_limits(const std::vector<FlightComparison>& comparisons,
                                 const std::vector<DifferenceLimit>& limits) {
    std::vector<Excess> checked;
    for (const DifferenceLimit& limit : limits) {
        Excess worst{limit, "", -1.0, ""};
        for (const FlightComparison& comparison : comparisons) {
            const std::vector<Found> all = all_of(comparison);
            const Found* found = find_named(all, limit.name);
            if (found == nullptr) {
                throw InputError(
                    fmt::format("--limit {}: {} and {} have no such difference; there are: {}",
                                limit.name, comparison.reference.label, comparison.other.label,
                                fmt::join(names_of(all), ", ")));
            }
            if (found->size > worst.measured) {
                worst = {limit, comparison.other.label, found->size, found->where};
            }
        }
        checked.push_back(worst);
    }
    return checked;
}

}  // namespace limpet::compare
