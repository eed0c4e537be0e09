// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/compare/compare.hpp"

/// How far a flight may be off its reference.
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

}  // namespace limpet::compare
