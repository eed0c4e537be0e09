// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/report/chart.hpp"
#include "limpet/report/sketch.hpp"

/// Where the axes of a chart begin and end, and their ticks.
namespace limpet {

/// @return the panel's own range, or one that holds every number that is drawn: x exactly but for
/// points and bars, y with some air. Never empty: {0, 1} (logarithmic {1, 10}) without a number.
[[nodiscard]] Range x_axis(const ChartPanel& panel);
[[nodiscard]] Range y_axis(const ChartPanel& panel);

/// Round numbers within a range: 1, 2 or 5 times a power of ten apart.
/// @param count  about how many
[[nodiscard]] std::vector<double> ticks(const Range& range, double count);
/// Powers of ten within a range; with 2 and 5 times those where few are.
[[nodiscard]] std::vector<double> log_ticks(const Range& range, double count);

/// As short as it may be: "0.4", "10⁻⁶".
[[nodiscard]] std::string tick_label(double value);

/// These ticks and no others on the plots to come.
/// @param axis  'x' or 'y'
void set_ticks(Sketch& sketch, char axis, const std::vector<double>& values);

/// True where a number can be drawn on the axis.
[[nodiscard]] bool drawable(double value, bool logarithmic);

}  // namespace limpet
