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

/// Room around the axes: at their right for names of levels or a colour bar, above for title, key
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

/// Lines of text from `top_px` down. @return where they end
double draw_lines(Sketch& sketch, const std::vector<std::string>& lines, double left_px,
                  double top_px, double size_px, const char* colour);
/// A panel's title in lines; none without one.
[[nodiscard]] std::vector<std::string> title_lines(const std::string& title, double width_px);

/// The horizontal axis' name, by gnuplot under its numbers.
void name_x_axis(Sketch& sketch, const std::string& name);

/// Values over a grid: value of (x[i], y[j]) at j * x.size() + i.
struct Grid {
    const std::vector<double>& x;
    const std::vector<double>& y;
    const std::vector<double>& z;
    [[nodiscard]] double at(std::size_t i, std::size_t j) const { return z[j * x.size() + i]; }
};
/// The value between four points of the grid, bilinear; NaN next to what is no number and outside.
[[nodiscard]] double interpolated(const Grid& grid, double x, double y);

}  // namespace limpet::draw
