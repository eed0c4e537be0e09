// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/draw/chart.hpp"
#include "limpet/draw/sketch.hpp"

/// Where the axes of a chart begin and end; their ticks are gnuplot's.
namespace limpet::draw {

/// @return the panel's own range, or one that holds every number that is drawn: x exactly but for
/// points and bars, y with some air. Never empty: {0, 1} (logarithmic {1, 10}) without a number.
[[nodiscard]] Range x_axis(const ChartPanel& panel);
[[nodiscard]] Range y_axis(const ChartPanel& panel);

/// 1, 2 or 5 times a power of ten: from one tick to the next.
/// @param count  of ticks, about
[[nodiscard]] double tick_step(const Range& range, double count);

/// Range, scale and ticks of the plots to come; numbers as short as they may be.
/// @param axis  "x" or "y"
/// @param count  of ticks, about
void set_axis(Sketch& sketch, const char* axis, const Range& range, bool logarithmic, double count);

/// Where a value is on an axis: 0 at its low end, 1 at its high one.
[[nodiscard]] double share_of(double value, const Range& range, bool logarithmic);

/// A series with at most four points for each of `bins` equal parts of the axis: first, lowest,
/// highest, last, so that no peak and no gap is lost. One with fewer points stays as it is.
[[nodiscard]] ChartSeries thinned(const ChartSeries& series, const Range& x, std::size_t bins);

/// True where a number can be drawn on the axis.
[[nodiscard]] bool drawable(double value, bool logarithmic);

}  // namespace limpet::draw
