// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "limpet/core/errors.hpp"

namespace limpet::compare {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

/// Size of something and where it is.
struct Found {
    double size = 0.0;
    std::string where;
};

Found worst_event(const FlightComparison& comparison) {
    Found worst;
    for (const EventPair& event : comparison.events) {
        const double off =
            event.in_both() ? std::abs(comparison.event_difference_s(event)) : kBeyond;
        if (off > worst.size) {
            worst = {off, event.occurrence > 1
                              ? fmt::format("{}, time {}", event.name, event.occurrence)
                              : event.name};
        }
    }
    return worst;
}

std::optional<Found> worst_contact(const FlightComparison& comparison) {
    if (comparison.contacts.empty()) {
        return std::nullopt;
    }
    Found worst;
    for (const ContactDifference& contact : comparison.contacts) {
        if (contact.largest_hPa >= worst.size) {
            worst = {contact.largest_hPa,
                     fmt::format("{} from {:.3f} s", contact.sealing ? "sealing" : "unsealing",
                                 contact.reference_from_s)};
        }
    }
    return worst;
}

/// @return nullopt when the comparison knows no such name
std::optional<Found> size_of(const FlightComparison& comparison, const std::string& name) {
    if (name == "event") {
        return worst_event(comparison);
    }
    if (name == "outcome") {
        // Flights of which none says how it ended are not told as alike.
        const std::string& expected = comparison.reference.summary.outcome;
        const bool alike = !expected.empty() && expected == comparison.other.summary.outcome;
        return Found{alike ? 0.0 : 1.0, comparison.other.summary.outcome};
    }
    if (name == "contact_pressure_hPa") {
        return worst_contact(comparison);
    }
    for (const FlightFigure& figure : comparison.figures) {
        if (figure.name == name) {
            return Found{std::isnan(figure.off()) ? kBeyond : figure.off(), ""};
        }
    }
    for (const ChannelDifference& channel : comparison.channels) {
        if (channel.name == name && channel.samples > 0) {
            return Found{channel.largest,
                         fmt::format("at {:.3f} s, {}", channel.at_s, channel.phase)};
        }
    }
    return std::nullopt;
}

std::vector<std::string> names_of(const FlightComparison& comparison) {
    std::vector<std::string> names = {"event", "outcome"};
    if (!comparison.contacts.empty()) {
        names.emplace_back("contact_pressure_hPa");
    }
    for (const FlightFigure& figure : comparison.figures) {
        names.push_back(figure.name);
    }
    for (const ChannelDifference& channel : comparison.channels) {
        if (channel.samples > 0) {
            names.push_back(channel.name);
        }
    }
    return names;
}

}  // namespace

DifferenceLimit parse_limit(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
    char* end = nullptr;
    const double most = std::strtod(value.c_str(), &end);
    if (equals == 0 || value.empty() || *end != '\0' || !std::isfinite(most) || most < 0.0) {
        throw InputError(fmt::format(
            "--limit {}: must be NAME=VALUE with a value of 0 or more, as in event=0.15", text));
    }
    return {text.substr(0, equals), most};
}

std::vector<Excess> check_limits(const std::vector<FlightComparison>& comparisons,
                                 const std::vector<DifferenceLimit>& limits) {
    std::vector<Excess> checked;
    for (const DifferenceLimit& limit : limits) {
        Excess worst{limit, "", -1.0, ""};
        for (const FlightComparison& comparison : comparisons) {
            const auto found = size_of(comparison, limit.name);
            if (!found) {
                throw InputError(
                    fmt::format("--limit {}: {} and {} have no such difference; there are: {}",
                                limit.name, comparison.reference.label, comparison.other.label,
                                fmt::join(names_of(comparison), ", ")));
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
