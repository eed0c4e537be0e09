// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/compare/compare.hpp"
#include "limpet/compare/limits.hpp"

namespace limpet::compare {

/// For people: outcomes, events, figures, contacts, channels, what was left out.
[[nodiscard]] std::string comparison_text(const FlightComparison& comparison);

/// A line a limit: what was measured, what is allowed, where.
[[nodiscard]] std::string limits_text(const std::vector<Excess>& checked);

/// The same as one JSON object; what is not there is null.
[[nodiscard]] std::string comparison_json(const std::vector<FlightComparison>& comparisons,
                                          const std::vector<Excess>& checked);

/// A table of Markdown, a column a flight: outcome, events, what perching is judged by.
[[nodiscard]] std::string comparison_markdown(const std::vector<FlightComparison>& comparisons);

}  // namespace limpet::compare
