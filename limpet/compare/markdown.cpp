// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "limpet/compare/text.hpp"

namespace limpet {
namespace {

/// Channels of the table: what acts on cup and vehicle, not what is derived or asked for.
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
    "rest_pitch_deg",
    "rest_roll_deg",
    "rest_cup_pull_N",
    "rest_cup_shear_N",
    "rest_hanging_load_N",
    "rest_hanging_load_off_weight",
};

std::string cell(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string digits5(double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", value) : "-";
}

/// A row of cells.
class Row {
public:
    explicit Row(std::string_view first) : text_(fmt::format("| {} |", first)) {}
    Row& add(std::string_view cell) {
        text_ += fmt::format(" {} |", cell);
        return *this;
    }
    [[nodiscard]] std::string end() const { return text_ + "\n"; }

private:
    std::string text_;
};

std::string head(const std::vector<FlightComparison>& comparisons) {
    Row names("");
    Row line("---");
    names.add(comparisons.front().reference.label);
    line.add("---");
    for (const FlightComparison& comparison : comparisons) {
        names.add(comparison.other.label);
        line.add("---");
    }
    return names.end() + line.end();
}

std::string outcome_row(const std::vector<FlightComparison>& comparisons) {
    Row row("outcome");
    row.add(comparisons.front().reference.summary.outcome);
    for (const FlightComparison& comparison : comparisons) {
        row.add(comparison.other.summary.outcome);
    }
    return row.end();
}

/// Times of the events of the reference; of the others with their difference.
std::string event_rows(const std::vector<FlightComparison>& comparisons) {
    std::string text;
    for (const EventPair& event : comparisons.front().events) {
        if (std::isnan(event.reference_s)) {
            continue;
        }
        Row row(fmt::format("{}{} [s]", event.name,
                            event.occurrence > 1 ? fmt::format(" {}", event.occurrence) : ""));
        row.add(cell(event.reference_s, 3));
        for (const FlightComparison& c : comparisons) {
            const auto same =
                std::find_if(c.events.begin(), c.events.end(), [&event](const EventPair& e) {
                    return e.name == event.name && e.occurrence == event.occurrence;
                });
            row.add(same == c.events.end() || !same->in_both()
                        ? "-"
                        : fmt::format("{} ({:+.3f})", cell(same->other_s, 3),
                                      c.event_difference_s(*same)));
        }
        text += row.end();
    }
    return text;
}

std::string figure_rows(const std::vector<FlightComparison>& comparisons) {
    std::string text;
    for (const FlightFigure& figure : comparisons.front().figures) {
        if (std::find(std::begin(kShownFigures), std::end(kShownFigures), figure.name) ==
            std::end(kShownFigures)) {
            continue;
        }
        Row row(figure.name);
        row.add(digits5(figure.reference));
        for (const FlightComparison& c : comparisons) {
            const auto same =
                std::find_if(c.figures.begin(), c.figures.end(),
                             [&figure](const FlightFigure& f) { return f.name == figure.name; });
            row.add(same == c.figures.end() ? "-" : digits5(same->other));
        }
        text += row.end();
    }
    return text;
}

double worst_contact_hPa(const FlightComparison& comparison) {
    double worst = comparison.contacts.empty() ? std::nan("") : 0.0;
    for (const ContactDifference& contact : comparison.contacts) {
        worst = std::max(worst, contact.largest_hPa);
    }
    return worst;
}

/// Largest and RMS of a channel, each stretch of the flight laid over its own.
std::string channel_rows(const std::vector<FlightComparison>& comparisons) {
    Row contact("pressure on the same contact, largest [hPa]");
    contact.add("");
    for (const FlightComparison& c : comparisons) {
        contact.add(cell(worst_contact_hPa(c), 2));
    }
    std::string text = contact.end();
    for (const std::string_view name : kShownChannels) {
        Row row(fmt::format("{}: largest, RMS", name));
        row.add("");
        for (const FlightComparison& c : comparisons) {
            const auto channel =
                std::find_if(c.channels.begin(), c.channels.end(),
                             [name](const ChannelDifference& d) { return d.name == name; });
            row.add(channel == c.channels.end() || channel->samples == 0
                        ? "-"
                        : fmt::format("{:.3g}, {:.2g}", channel->largest, channel->rms));
        }
        text += row.end();
    }
    return text;
}

}  // namespace

std::string comparison_markdown(const std::vector<FlightComparison>& comparisons) {
    return head(comparisons) + outcome_row(comparisons) + event_rows(comparisons) +
           figure_rows(comparisons) + channel_rows(comparisons);
}

}  // namespace limpet
