// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/report/chart.hpp"

/// The words around a panel and the room that they take.
namespace limpet {

inline constexpr double kSwatch_px = 28.0;
inline constexpr double kLevelNames_px = 150.0;  ///< most that names of levels take
inline constexpr double kSlant_deg = 40.0;       ///< of names that do not fit on a line
inline constexpr double kLeader_px = 20.0;       ///< from a moment's line to its name

/// A place in the legend, which has rows.
struct LegendEntry {
    std::size_t series = 0;
    double left_px = 0.0;  ///< from the plot's left
    std::size_t row = 0;
};
[[nodiscard]] std::vector<LegendEntry> legend(const ChartPanel& panel, double width_px);

/// Whether the names of moments fit beside each other, each to the right of its line.
[[nodiscard]] bool moments_fit(const ChartPanel& panel, double width_px);
/// Height of the names of moments: a line where they fit, else slanted with their leaders.
[[nodiscard]] double moments_px(const ChartPanel& panel, double width_px);

/// Names under the axis: each within its share of it, or slanted when one does not fit.
struct CategoryNames {
    std::vector<std::vector<std::string>> lines;
    bool slanted = false;
    double height_px = 0.0;
};
[[nodiscard]] CategoryNames category_names(const ChartPanel& panel, double width_px);

}  // namespace limpet
