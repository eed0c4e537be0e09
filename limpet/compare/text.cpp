// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace limpet {
namespace {

/// Leftovers shorter than this are of no interest: a few samples.
constexpr double kWorthTelling_s = 0.05;

std::string cell(double value, int width, int digits) {
    return std::isnan(value) ? fmt::format("{:>{}}", "-", width)
                             : fmt::format("{:>{}.{}f}", value, width, digits);
}

/// Four digits, whatever the size.
std::string number(double value, int width) {
    return std::isnan(value) ? fmt::format("{:>{}}", "-", width)
                             : fmt::format("{:>{}.4g}", value, width);
}

std::string flight_line(const FlightIdentity& flight, std::size_t width) {
    const Summary& s = flight.summary;
    return fmt::format("{:<{}}  {}{}: {}{}\n", flight.label, width,
                       s.scenario.empty() ? "flight" : s.scenario,
                       s.seed.empty() ? "" : ", seed " + s.seed,
                       s.outcome.empty() ? "no outcome recorded" : s.outcome,
                       s.reason.empty() ? "" : " (" + s.reason + ")");
}

std::string event_name(const EventPair& event) {
    return event.occurrence > 1 ? fmt::format("{} {}", event.name, event.occurrence) : event.name;
}

std::string events_text(const FlightComparison& c) {
    if (c.events.empty()) {
        return "";
    }
    std::string text = fmt::format("\n{:<20}  {:>11}  {:>11}  {:>12}  {:>17}\n", "event",
                                   "reference s", "other s", "difference s", "since the last s");
    double last_s = 0.0;
    for (const EventPair& event : c.events) {
        const double difference_s = c.event_difference_s(event);
        text += fmt::format("{:<20}  {}  {}  {}  {}\n", event_name(event),
                            cell(event.reference_s, 11, 3), cell(event.other_s, 11, 3),
                            cell(difference_s, 12, 3), cell(difference_s - last_s, 17, 3));
        last_s = event.in_both() ? difference_s : last_s;
    }
    return text;
}

std::string figures_text(const FlightComparison& c) {
    if (c.figures.empty()) {
        return "";
    }
    std::string text = fmt::format("\n{:<28}  {:>11}  {:>11}  {:>11}\n", "figure", "reference",
                                   "other", "difference");
    for (const FlightFigure& figure : c.figures) {
        text += fmt::format("{:<28}  {}  {}  {}\n", figure.name, number(figure.reference, 11),
                            number(figure.other, 11), number(figure.other - figure.reference, 11));
    }
    return text;
}

std::string contacts_text(const FlightComparison& c) {
    if (c.contacts.empty()) {
        return "";
    }
    std::string text =
        fmt::format("\n{:<20}  {:>11}  {:>7}  {:>10}  {:>11}  {:>7}\n", "same contact",
                    "reference s", "for s", "shift s", "largest hPa", "RMS hPa");
    for (const ContactDifference& contact : c.contacts) {
        text += fmt::format("{:<20}  {:11.3f}  {:7.3f}  {:10.4f}  {:11.3f}  {:7.3f}\n",
                            contact.sealing ? "sealing" : "unsealing", contact.reference_from_s,
                            contact.span_s, contact.shift_s, contact.largest_hPa, contact.rms_hPa);
    }
    return text;
}

std::string channels_text(const FlightComparison& c) {
    std::string text = fmt::format("\n{:<28}  {:>10}  {:>9}  {:<16}  {:>10}  {:>7}\n", "channel",
                                   "largest", "at s", "in", "RMS", "samples");
    for (const ChannelDifference& channel : c.channels) {
        text += channel.samples == 0
                    ? fmt::format("{:<28}  no time at which both have a value\n", channel.name)
                    : fmt::format("{:<28}  {}  {:9.3f}  {:<16}  {}  {:>7}\n", channel.name,
                                  number(channel.largest, 10), channel.at_s, channel.phase,
                                  number(channel.rms, 10), channel.samples);
    }
    return text;
}

std::string left_out_text(const FlightComparison& c) {
    std::string text;
    for (const Piece& piece : c.pieces) {
        const bool reference = piece.reference_left_out_s > kWorthTelling_s;
        const bool other = piece.other_left_out_s > kWorthTelling_s;
        if (reference || other) {
            text += fmt::format("left out: {:.3f} s of {} from {} on, where {} is shorter\n",
                                reference ? piece.reference_left_out_s : piece.other_left_out_s,
                                reference ? c.reference.label : c.other.label, piece.from,
                                reference ? c.other.label : c.reference.label);
        }
    }
    for (const auto& [flight, names] :
         {std::pair{&c.reference, &c.only_in_reference}, std::pair{&c.other, &c.only_in_other}}) {
        if (!names->empty()) {
            text += fmt::format("only in {}: {}\n", flight->label, fmt::join(*names, ", "));
        }
    }
    return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string comparison_text(const FlightComparison& comparison) {
    const std::size_t width =
        std::max(comparison.reference.label.size(), comparison.other.label.size());
    return flight_line(comparison.reference, width) + flight_line(comparison.other, width) +
           events_text(comparison) + figures_text(comparison) + contacts_text(comparison) +
           channels_text(comparison) + left_out_text(comparison);
}

std::string limits_text(const std::vector<Excess>& checked) {
    std::string text;
    for (const Excess& check : checked) {
        text += fmt::format("limit {}: {} of {:g}{}, {}{}\n", check.limit.name,
                            std::isinf(check.measured) ? "in one flight only"
                                                       : fmt::format("{:.4g}", check.measured),
                            check.limit.most, check.exceeded() ? ", EXCEEDED" : "", check.other,
                            check.where.empty() ? "" : ", " + check.where);
    }
    return text;
}

}  // namespace limpet
