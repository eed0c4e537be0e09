// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/compare/compare.hpp"
#include "limpet/core/work.hpp"
#include "limpet/draw/pictures.hpp"

namespace limpet::compare {

/// `name` may be a channel (its largest difference), a figure, "event" (the largest difference of
/// an event's time [s]; one that only one flight has is beyond any limit), "contact_pressure_hPa"
/// (the largest on the same contact) or "outcome" (1 when they are not alike).
struct DifferenceLimit {
    std::string name;
    double most = 0.0;
};

/// @param text  "NAME=VALUE"
/// @throws InputError saying what is wrong with it
[[nodiscard]] DifferenceLimit parse_limit(const std::string& text);

/// What was measured against a limit.
struct Excess {
    DifferenceLimit limit;
    std::string other;      ///< label of the flight that is the furthest off
    double measured = 0.0;  ///< infinity: only one of them has it
    std::string where;      ///< "detached", "at 5.22 s, approaching"; may be empty
    [[nodiscard]] bool exceeded() const { return !(measured <= limit.most); }
};

/// One a limit, the worst of all flights.
/// @throws InputError for a name that none of the comparisons knows, naming those that there are
[[nodiscard]] std::vector<Excess> check_limits(const std::vector<FlightComparison>& comparisons,
                                               const std::vector<DifferenceLimit>& limits);

/// For people: outcomes, events, figures, contacts, channels, what was left out.
[[nodiscard]] std::string comparison_text(const FlightComparison& comparison);

/// Names of the columns, then the rows.
using TextTable = std::vector<std::vector<std::string>>;
/// Tables of that text and of the page; without a row where there is nothing to show.
[[nodiscard]] TextTable events_table(const FlightComparison& comparison);
[[nodiscard]] TextTable figures_table(const FlightComparison& comparison);
[[nodiscard]] TextTable contacts_table(const FlightComparison& comparison);
[[nodiscard]] TextTable channels_table(const FlightComparison& comparison);

/// A line a limit: what was measured, what is allowed, where.
[[nodiscard]] std::string limits_text(const std::vector<Excess>& checked);

/// The same as one JSON object; what is not there is null.
[[nodiscard]] std::string comparison_json(const std::vector<FlightComparison>& comparisons,
                                          const std::vector<Excess>& checked);

/// A table of Markdown, a column a flight: outcome, events, what perching is judged by.
[[nodiscard]] std::string comparison_markdown(const std::vector<FlightComparison>& comparisons);

/// Draws flights over each other, a figure a group of channels (`compare_cup`, `compare_attitude`,
/// ...): on the left the curves against the reference's time, every other flight shifted piece by
/// piece, with the events of the reference; on the right how far they are off, less what a shift by
/// a sample or two explains. PNG and SVG.
/// @param comparisons  of the same reference, in the order of `others`
/// @param folder       made when it is not there
/// @throws InputError for an unwritable folder, or when gnuplot is not installed; Interrupted, with
///         nothing in the folder
[[nodiscard]] draw::Pictures draw_comparison(const FlightTrace& reference,
                                             const std::vector<FlightTrace>& others,
                                             const std::vector<FlightComparison>& comparisons,
                                             const std::filesystem::path& folder,
                                             const Work& work = {});

/// Tables and figures as one page that needs nothing but itself.
/// @param figures  as draw_comparison() returned them, in `folder` or below it
/// @param command  that made it
/// @throws InputError naming a figure that cannot be read
[[nodiscard]] std::string comparison_html(const std::vector<FlightComparison>& comparisons,
                                          const std::vector<Excess>& checked,
                                          const std::vector<std::filesystem::path>& figures,
                                          const std::filesystem::path& folder,
                                          const std::string& command);

}  // namespace limpet::compare
