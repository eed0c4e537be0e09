// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limpet/draw/pictures.hpp"

/// Charts of any numbers: curves, points with intervals, bars, maps. Texts are shown as they are
/// and carry their units: "impact speed  [m/s]". What comes in is not checked for sense; lengths
/// that do not agree are a broken promise (InternalError).
namespace limpet::draw {

/// Ends of an axis.
struct Range {
    double low = 0.0;
    double high = 1.0;
};

/// Numbers against numbers. NaN breaks a line and leaves out a point; on a logarithmic axis so does
/// what is not positive.
struct ChartSeries {
    enum class Mark {
        line,
        dashes,
        steps,   ///< holds each value until the next
        points,  ///< each series with a shape of its own
        bars,    ///< from 0 up or down; several series stand side by side
    };
    std::string name = {};  ///< in the legend; without one it is not there
    Mark mark = Mark::line;
    std::vector<double> x = {};
    std::vector<double> y = {};
    std::vector<double> low = {};   ///< lower ends of intervals around points or bars, or empty
    std::vector<double> high = {};  ///< upper ends
    std::string colour = {};        ///< "#RRGGBB" (colours.hpp); empty: the palette's next
    double width = 2.0;             ///< of the line

    void add(double at_x, double at_y) {
        x.push_back(at_x);
        y.push_back(at_y);
    }
    void add(double at_x, double at_y, const Range& interval) {
        add(at_x, at_y);
        low.push_back(interval.low);
        high.push_back(interval.high);
    }
    /// A function's values at the ends of so many equal parts of a range.
    template <class Function>
    void add(const Range& range, int parts, const Function& function) {
        for (int i = 0; i <= parts; ++i) {
            const double at_x = range.low + (range.high - range.low) * i / parts;
            add(at_x, function(at_x));
        }
    }
};

/// A line across the panel that means something.
struct ChartLine {
    double at = 0.0;
    std::string label = {};
};

/// A part of the horizontal axis; every second one is shaded.
struct ChartStretch {
    Range x;
    std::string name = {};  ///< above the axes; where it does not fit a letter, and it in the list
};

struct ChartPanel {
    std::string title = {};
    std::string x_label = {};
    std::string y_label = {};
    std::vector<ChartSeries> series = {};
    std::vector<ChartLine> levels = {};  ///< horizontal: a threshold; named at the right
    /// Vertical: an event; named above, by numbers and a list where the names do not fit.
    std::vector<ChartLine> moments = {};
    std::vector<ChartStretch> stretches = {};  ///< in their order, without a gap
    std::vector<ChartLine> y_names = {};       ///< of values: at the right, in place of the numbers
    std::vector<std::string> categories = {};  ///< names of x = 0, 1, 2, ...
    std::optional<Range> x_range = {};         ///< without: what the series need
    std::optional<Range> y_range = {};         ///< without: what series and levels need, with air
    bool log_x = false;
    bool log_y = false;
    double least_span = 0.0;   ///< the vertical axis never shows less: noise shall not fill a panel
    bool from_zero = false;    ///< it begins at 0
    bool x_numbers = true;     ///< false: they stand under the panel below
    double height_px = 280.0;  ///< of the plot itself

    /// Adds a category. @return its x
    double category(const std::string& name) {
        categories.push_back(name);
        return static_cast<double>(categories.size() - 1);
    }
};

/// A marked place on a map; not shown where it lies outside.
struct HeatPoint {
    double x = 0.0;
    double y = 0.0;
    std::string label = {};
};

/// A value over a grid as colours, with contour lines, a thick one at 0. Colours run from blue
/// below 0 over white at 0 to orange above it.
struct HeatPanel {
    std::string title = {};
    std::string x_label = {};
    std::string y_label = {};
    std::string z_label = {};         ///< over the colour bar
    std::vector<double> x = {};       ///< ascending, at least two, evenly spaced
    std::vector<double> y = {};       ///< likewise
    std::vector<double> z = {};       ///< value of (x[i], y[j]) at j * x.size() + i
    std::vector<double> levels = {};  ///< contour lines, with their values; without that of 0
    double z_most = 1.0;              ///< colours end here, below 0 and above
    std::vector<HeatPoint> points = {};
    double height_px = 380.0;
};

struct Chart {
    std::string title = {};
    std::string subtitle = {};
    std::string warning = {};  ///< in red at the subtitle's right
    std::vector<std::variant<ChartPanel, HeatPanel>> panels = {};  ///< row by row, at least one
    int columns = 1;
    double column_px = 0.0;  ///< 0: one column is 640 px wide, fit for a phone; several 600 each
};

/// Draws STEM.png and STEM.svg; a panel without a number has the text "no data".
/// @param stem    of letters, digits, '_' and '-'
/// @param folder  made when it is not there
/// @return both files
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
[[nodiscard]] Pictures draw_chart(const Chart& chart, const std::string& stem,
                                  const std::filesystem::path& folder);

}  // namespace limpet::draw
