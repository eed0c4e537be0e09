// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "limpet/draw/chart.hpp"
#include "limpet/draw/sketch.hpp"

/// How the panels of a chart.hpp are drawn, each in a place that the chart gives it.
namespace limpet::draw {

/// A chart's letters [px].
inline constexpr double kChartFont_px = 16.0;
inline constexpr double kChartSmall_px = 15.0;
inline constexpr double kPanelTitle_px = 18.0;
inline constexpr double kLine_px = 22.0;  ///< from one line of text to the next

/// Numbers for gnuplot, in blocks; `blocks` counts them.
struct ChartData {
    std::string text;
    int blocks = 0;

    /// A row an index of the columns, which are of one length; NaN where a number is not finite.
    /// @param row_length  of a grid: an empty line after each row of it
    /// @return the block's index
    int add(std::initializer_list<const std::vector<double>*> columns, std::size_t row_length = 0);
};

/// Space around the axes: at their right for names of levels or a colour bar, above for title, key
/// and names, below for numbers and the name of the axis.
[[nodiscard]] double right_px(const ChartPanel& panel);
[[nodiscard]] double right_px(const HeatPanel& panel);
[[nodiscard]] double head_px(const ChartPanel& panel, double width_px);
[[nodiscard]] double head_px(const HeatPanel& panel, double width_px);
[[nodiscard]] double foot_px(const ChartPanel& panel, double width_px);
[[nodiscard]] double foot_px(const HeatPanel& panel, double width_px);

/// Draws with the axes in `box`.
void draw_panel(Sketch& sketch, ChartData& data, const ChartPanel& panel, const Box& box);
void draw_panel(Sketch& sketch, ChartData& data, const HeatPanel& panel, const Box& box);

/// What gnuplot's `plot` is followed by; empty where no series has a number.
/// @param x, y  the axes, of `width_px`
[[nodiscard]] std::string plot_of(const ChartPanel& panel, ChartData& data, const Range& x,
                                  const Range& y, double width_px);

/// Lines of text from `top_px` down. @return where they end
double draw_lines(Sketch& sketch, const std::vector<std::string>& lines, double left_px,
                  double top_px, double size_px, const char* colour);
/// A panel's title in lines; none without one.
[[nodiscard]] std::vector<std::string> title_lines(const std::string& title, double width_px);

/// The horizontal axis' name, by gnuplot under its numbers.
void name_x_axis(Sketch& sketch, const std::string& name);

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
