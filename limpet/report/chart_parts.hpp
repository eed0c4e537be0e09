// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/report/chart.hpp"
#include "limpet/report/sketch.hpp"

/// How the panels of a chart.hpp are drawn, each in a place that the chart gives it.
namespace limpet {

/// A chart's letters [px].
inline constexpr double kChartFont_px = 16.0;
inline constexpr double kChartSmall_px = 15.0;
inline constexpr double kPanelTitle_px = 18.0;
inline constexpr double kLine_px = 22.0;  ///< from one line of text to the next

/// A plot's axes.
struct PlotBox {
    double left_px = 0.0;
    double top_px = 0.0;
    double right_px = 0.0;
    double bottom_px = 0.0;
    [[nodiscard]] double width_px() const { return right_px - left_px; }
};

/// Room left and right of the axes: tick labels, names of levels, colour bar.
struct Sides {
    double left_px = 0.0;
    double right_px = 0.0;
};

/// Numbers for gnuplot, in blocks; `blocks` counts them.
struct ChartData {
    std::string text;
    int blocks = 0;
    /// Ends a block. @return its index
    int close();
};

[[nodiscard]] Sides sides(const ChartPanel& panel);
[[nodiscard]] Sides sides(const HeatPanel& panel);

/// Room above the axes for title, legend, names, given the plot's width.
[[nodiscard]] double head_px(const ChartPanel& panel, double width_px);
[[nodiscard]] double head_px(const HeatPanel& panel, double width_px);

/// Room below the axes for tick labels and the name of the axis.
[[nodiscard]] double foot_px(const ChartPanel& panel, double width_px);
[[nodiscard]] double foot_px(const HeatPanel& panel, double width_px);

/// Draws into `box`, `head_px` above it and `foot_px` below it.
void draw_panel(Sketch& sketch, ChartData& data, const ChartPanel& panel, const PlotBox& box);
void draw_panel(Sketch& sketch, ChartData& data, const HeatPanel& panel, const PlotBox& box);

/// A panel's title in lines from `top_px` down. @return where it ends
double draw_title(Sketch& sketch, const std::string& title, double left_px, double top_px,
                  double width_px);
[[nodiscard]] double title_px(const std::string& title, double width_px);

}  // namespace limpet
