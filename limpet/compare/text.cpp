// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>

#include "limpet/compare/report.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/signals/true_end.hpp"

namespace limpet::compare {
namespace {

/// Leftovers shorter than this are of no interest: a few samples.
constexpr double kWorthTelling_s = 0.05;

/// Channels of the table: what acts on cup and vehicle, neither what is derived nor set-points.
constexpr std::string_view kShownChannels[] = {
    "pitch_deg",      "north_m",    "down_m",   "cup_pressure_hPa",
    "slider_force_N", "cup_pull_N", "thrust_N",
};

/// Figures of the table; the text and the JSON have them all.
constexpr std::string_view kShownFigures[] = {
    "impact_speed_m_s",
    "impact_force_N",
    "cup_press_max_N",
    "cup_pull_max_N",
    "cup_margin_min_N",
    "time_to_land_pressure_s",
    "pressure_at_hold_end_Pa",
    "pressure_min_Pa",
    "release_s",
    "pitch_oscillation_max_deg",
    "energy_flying_Wh",
    "rest_pitch_deg",
    "rest_roll_deg",
    "rest_cup_pull_N",
    "rest_cup_shear_N",
    "rest_hanging_load_N",
    "rest_hanging_load_off_weight",
};

/// Columns as wide as their widest cell, numbers at their right; nothing without a row.
std::string aligned(const TextTable& table) {
    std::string text = table.size() > 1 ? "\n" : "";
    for (std::size_t row = 0; table.size() > 1 && row < table.size(); ++row) {
        for (std::size_t column = 0; column < table[row].size(); ++column) {
            std::size_t width = 0;
            for (const auto& other : table) {
                width = std::max(width, column < other.size() ? other[column].size() : 0);
            }
            const std::string& first = table[1][column];
            const bool words =
                !first.empty() && std::isalpha(static_cast<unsigned char>(first[0])) != 0;
            const std::string& cell = table[row][column];
            const bool last = column + 1 == table[row].size();
            text += !words ? fmt::format("{:>{}}", cell, width)
                    : last ? cell
                           : fmt::format("{:<{}}", cell, width);
            text += last ? "\n" : "  ";
        }
    }
    return text;
}

std::string markdown(const TextTable& table) {
    std::string text;
    for (const auto& row : table) {
        text += fmt::format("| {} |\n", fmt::join(row, " | "));
        if (&row == &table.front()) {
            text += "|";
            for (std::size_t i = 0; i < row.size(); ++i) {
                text += "---|";
            }
            text += "\n";
        }
    }
    return text;
}

/// A time in milliseconds and the like.
std::string fixed(double value, int digits = 3) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

/// So many digits, whatever the size.
std::string short_of(double value, int digits = 4) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

/// As recorded, and the truth where it does not bear it out.
std::string outcome_text(const record::Summary& summary) {
    const auto outcome = outcome_from(summary.outcome);
    const auto truth = true_end_from(summary.true_end);
    return outcome && truth ? told_with_truth(*outcome, *truth) : summary.outcome;
}

std::string flight_line(const FlightIdentity& flight, std::size_t width) {
    const record::Summary& s = flight.summary;
    return fmt::format("{:<{}}  {}{}: {}{}\n", flight.label, width,
                       s.scenario.empty() ? "flight" : s.scenario,
                       s.seed.empty() ? "" : ", seed " + s.seed,
                       s.outcome.empty() ? "no outcome recorded" : outcome_text(s),
                       s.reason.empty() ? "" : " (" + s.reason + ")");
}

std::string event_name(const EventPair& event) {
    return event.occurrence > 1 ? fmt::format("{} {}", event.name, event.occurrence) : event.name;
}

std::string left_out_text(const FlightComparison& c) {
    std::string none, text;
    for (const ChannelDifference& channel : c.channels) {
        if (channel.samples == 0) {
            none += fmt::format("{}: no time at which both have a value\n", channel.name);
        }
    }
    for (const Piece& piece : c.pieces) {
        const bool reference = piece.reference_left_out_s > kWorthTelling_s;
        const bool other = piece.other_left_out_s > kWorthTelling_s;
        if (reference || other) {
            text += fmt::format("left out: {:.3f} s of {} after {}, where {} is shorter\n",
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
    return none + (text.empty() ? text : "\n" + text);
}

std::string worst_contact_text(const FlightComparison& comparison) {
    double worst = comparison.contacts.empty() ? std::nan("") : 0.0;
    for (const ContactDifference& contact : comparison.contacts) {
        worst = std::max(worst, contact.largest_hPa);
    }
    return fixed(worst, 2);
}

/// A row: what it is, of the reference, and of each other flight.
template <class Cell>
void add_row(TextTable& table, const std::string& name, const std::string& reference,
             const std::vector<FlightComparison>& comparisons, const Cell& cell) {
    auto& row = table.emplace_back(std::vector<std::string>{name, reference});
    std::transform(comparisons.begin(), comparisons.end(), std::back_inserter(row), cell);
}

}  // namespace

TextTable events_table(const FlightComparison& c) {
    TextTable table = {{"event", "reference s", "other s", "difference s", "since the last s"}};
    double last_s = 0.0;
    for (const EventPair& event : c.events) {
        const double difference_s = c.event_difference_s(event);
        table.push_back({event_name(event), fixed(event.reference_s), fixed(event.other_s),
                         fixed(difference_s), fixed(difference_s - last_s)});
        last_s = event.in_both() ? difference_s : last_s;
    }
    return table;
}

TextTable figures_table(const FlightComparison& c) {
    TextTable table = {{"figure", "reference", "other", "difference"}};
    for (const FlightFigure& figure : c.figures) {
        table.push_back({figure.name, short_of(figure.reference), short_of(figure.other),
                         short_of(figure.other - figure.reference)});
    }
    return table;
}

TextTable contacts_table(const FlightComparison& c) {
    TextTable table = {
        {"same contact", "reference s", "for s", "shift s", "largest hPa", "RMS hPa"}};
    for (const ContactDifference& contact : c.contacts) {
        table.push_back({contact.sealing ? "sealing" : "unsealing", fixed(contact.reference_from_s),
                         fixed(contact.span_s), fixed(contact.shift_s, 4),
                         fixed(contact.largest_hPa), fixed(contact.rms_hPa)});
    }
    return table;
}

TextTable channels_table(const FlightComparison& c) {
    TextTable table = {{"channel", "largest", "at s", "RMS", "samples", "in"}};
    for (const ChannelDifference& channel : c.channels) {
        if (channel.samples > 0) {
            table.push_back({channel.name, short_of(channel.largest), fixed(channel.at_s),
                             short_of(channel.rms), fmt::format("{}", channel.samples),
                             channel.phase});
        }
    }
    return table;
}

std::string comparison_text(const FlightComparison& comparison) {
    const std::size_t width =
        std::max(comparison.reference.label.size(), comparison.other.label.size());
    return flight_line(comparison.reference, width) + flight_line(comparison.other, width) +
           aligned(events_table(comparison)) + aligned(figures_table(comparison)) +
           aligned(contacts_table(comparison)) + aligned(channels_table(comparison)) +
           left_out_text(comparison);
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

std::string comparison_markdown(const std::vector<FlightComparison>& comparisons) {
    using C = FlightComparison;
    const C& first = comparisons.front();
    TextTable table;
    add_row(table, "", first.reference.label, comparisons,
            [](const C& c) { return c.other.label; });
    add_row(table, "outcome", first.reference.summary.outcome, comparisons,
            [](const C& c) { return c.other.summary.outcome; });
    // Times of the events of the reference; of the others with their difference.
    for (const EventPair& event : first.events) {
        if (std::isnan(event.reference_s)) {
            continue;
        }
        add_row(
            table, event_name(event) + " [s]", fixed(event.reference_s), comparisons,
            [&event](const C& c) -> std::string {
                for (const EventPair& e : c.events) {
                    if (e.name == event.name && e.occurrence == event.occurrence && e.in_both()) {
                        return fmt::format("{} ({:+.3f})", fixed(e.other_s),
                                           c.event_difference_s(e));
                    }
                }
                return "-";
            });
    }
    for (const FlightFigure& figure : first.figures) {
        if (std::find(std::begin(kShownFigures), std::end(kShownFigures), figure.name) !=
            std::end(kShownFigures)) {
            add_row(table, figure.name, short_of(figure.reference, 5), comparisons,
                    [&figure](const C& c) {
                        const FlightFigure* same = find_named(c.figures, figure.name);
                        return same == nullptr ? "-" : short_of(same->other, 5);
                    });
        }
    }
    add_row(table, "pressure on the same contact, largest [hPa]", "", comparisons,
            worst_contact_text);
    for (const std::string_view name : kShownChannels) {
        // Each stretch of the flight laid over its own.
        add_row(table, fmt::format("{}: largest, RMS", name), "", comparisons,
                [name](const C& c) -> std::string {
                    const ChannelDifference* channel = find_named(c.channels, name);
                    return channel == nullptr || channel->samples == 0
                               ? "-"
                               : fmt::format("{:.3g}, {:.2g}", channel->largest, channel->rms);
                });
    }
    return markdown(table);
}

}  // namespace limpet::compare
