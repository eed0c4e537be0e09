// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "limpet/campaign/results.hpp"

namespace limpet::rare {

/// A rare event, and the figure of a flight by which a search comes nearer to it.
struct RareEvent {
    std::string text;                ///< "failed_to_seal", "cup_margin_min_N<0"
    std::optional<Outcome> outcome;  ///< the event is that; none: `figure` is beyond `limit`
    std::string figure;              ///< a metric, `attempts` or `simulated_s`
    bool rising = false;             ///< towards the event; else the figure falls
    double limit = 0.0;
    bool inclusive = false;  ///< the limit itself is the event as well

    /// NaN: did not come to pass.
    [[nodiscard]] double value(const campaign::RunRow& row) const;
    /// RareSample::fall: falls towards the event, infinite where there is no value.
    [[nodiscard]] double fall(const campaign::RunRow& row) const;
    [[nodiscard]] bool happened(const campaign::RunRow& row) const;
    /// The figure's value at a fall.
    [[nodiscard]] double value_at(double fall) const { return rising ? -fall : fall; }
};

/// How the figure for an outcome's levels is given.
struct RareGuide {
    std::string falling;  ///< name of a figure, or empty
    std::string rising;   ///< likewise
};

/// Whether a flight has a figure of this name: a metric, `attempts` or `simulated_s`.
[[nodiscard]] bool is_figure(std::string_view name);

/// @param text    an outcome, or a figure with <, <=, > or >= and a number
/// @param guide   of an outcome; failed_to_seal and timed_out have a default
/// @param option  that the text was given to, for messages
/// @throws InputError one line: what is unknown and what is near, or what is missing
[[nodiscard]] RareEvent parse_rare_event(const std::string& text, const RareGuide& guide = {},
                                         const std::string& option = "--rare");

}  // namespace limpet::rare
