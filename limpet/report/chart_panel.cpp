// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/report/axes.hpp"
#include "limpet/report/chart_names.hpp"
#include "limpet/report/chart_parts.hpp"
#include "limpet/report/colours.hpp"
#include "limpet/report/gnuplot.hpp"

namespace limpet {
namespace {

using Mark = ChartSeries::Mark;

constexpr double kMomentGap_px = 24.0;
constexpr double kMostBar_px = 80.0;

constexpr const char* kPalette[] = {colours::kDarkBlue, colours::kOrange, colours::kBlue,
                                    colours::kRust,     colours::kGreen,  colours::kPlum};
// Dark intervals are seen on these.
constexpr const char* kBarPalette[] = {colours::kBlue, colours::kPeach, colours::kGreen,
                                       colours::kPlum, colours::kOrange};
constexpr int kShapes[] = {7, 5, 9, 13, 11, 6};  // gnuplot's: disc, square, triangle, ...

std::string colour_of(const ChartPanel& panel, std::size_t index) {
    const std::string& own = panel.series[index].colour;
    if (own.empty()) {
        return panel.series[index].mark == Mark::bars ? kBarPalette[index % std::size(kBarPalette)]
                                                      : kPalette[index % std::size(kPalette)];
    }
    require(own.size() == 7 && own[0] == '#' &&
                own.find_first_not_of("0123456789abcdefABCDEF", 1) == own.npos,
            "a colour is #RRGGBB");
    return own;
}

/// Each series of points has its own.
int shape_of(const ChartPanel& panel, std::size_t index) {
    const auto before = std::count_if(panel.series.begin(),
                                      panel.series.begin() + static_cast<std::ptrdiff_t>(index),
                                      [](const ChartSeries& s) { return s.mark == Mark::points; });
    return kShapes[static_cast<std::size_t>(before) % std::size(kShapes)];
}

bool has_number(const ChartPanel& panel) {
    for (const ChartSeries& s : panel.series) {
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            const bool interval = !s.low.empty() && drawable(s.low[i], panel.log_y) &&
                                  drawable(s.high[i], panel.log_y);
            if (drawable(s.x[i], panel.log_x) &&
                (s.mark == Mark::none ? s.band && interval : drawable(s.y[i], panel.log_y))) {
                return true;
            }
        }
    }
    return false;
}

/// Rows of `x y low high`, an empty line where a line breaks.
/// @param foot  where an interval ends that reaches below a logarithmic axis
int put_block(ChartData& data, const ChartPanel& panel, const ChartSeries& s, double shift,
              double foot) {
    bool gap = true;  // also keeps empty lines from the start of a block
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (!drawable(s.x[i], panel.log_x) || !drawable(s.y[i], panel.log_y)) {
            data.text += gap ? "" : "\n";
            gap = true;
            continue;
        }
        data.text += fmt::format("{:.10g} {:.10g}", s.x[i] + shift, s.y[i]);
        if (!s.low.empty()) {
            const double low = panel.log_y && s.low[i] <= 0.0 ? foot : s.low[i];
            data.text += fmt::format(" {:.10g} {:.10g}", low, s.high[i]);
        }
        data.text += "\n";
        gap = false;
    }
    if (gap) {
        data.text += "NaN NaN NaN NaN\n";  // a block must not be empty
    }
    return data.close();
}

class PanelDrawing {
public:
    PanelDrawing(Sketch& sketch, ChartData& data, const ChartPanel& panel, const PlotBox& box)
        : sketch_(sketch),
          data_(data),
          panel_(panel),
          box_(box),
          x_(x_axis(panel)),
          y_(y_axis(panel)) {}

    void draw() {
        double y = box_.top_px - head_px(panel_, box_.width_px());
        y = draw_title(sketch_, panel_.title, box_.left_px, y, box_.width_px());
        draw_legend(y);
        if (!panel_.y_label.empty()) {
            sketch_.label(box_.left_px, box_.top_px - 16.0, panel_.y_label, kChartSmall_px,
                          colours::kFaint);
        }
        levels();
        moments();
        axes();
        plot();
    }

private:
    [[nodiscard]] static double share(double value, const Range& range, bool logarithmic) {
        return logarithmic ? std::log(value / range.low) / std::log(range.high / range.low)
                           : (value - range.low) / (range.high - range.low);
    }
    [[nodiscard]] double x_px(double value) const {
        return box_.left_px + share(value, x_, panel_.log_x) * box_.width_px();
    }
    [[nodiscard]] double y_px(double value) const {
        return box_.bottom_px - share(value, y_, panel_.log_y) * (box_.bottom_px - box_.top_px);
    }

    void draw_legend(double top_px) {
        for (const LegendEntry& entry : legend(panel_, box_.width_px())) {
            const ChartSeries& s = panel_.series[entry.series];
            const std::string colour = colour_of(panel_, entry.series);
            const double y = top_px + kLine_px * (static_cast<double>(entry.row) + 0.5);
            const double x0 = box_.left_px + entry.left_px, x1 = x0 + kSwatch_px;
            if (s.band) {
                const std::string pale = "#B0" + colour.substr(1);
                sketch_.box(x0, y - 8.0, x1, y + 8.0, pale.c_str());
            }
            switch (s.mark) {
                case Mark::line:
                case Mark::steps: sketch_.line(x0, y, x1, y, colour.c_str(), 2.6, "front"); break;
                case Mark::dashes:
                    sketch_.line(x0, y, x1, y, colour.c_str(), 2.6, "front dt (7,4)");
                    break;
                case Mark::bars: sketch_.box(x0 + 6.0, y - 8.0, x1, y + 8.0, colour.c_str()); break;
                case Mark::points: {
                    const std::string point = fmt::format("point pt {} ps 1.1*MARK lc rgb '{}'",
                                                          shape_of(panel_, entry.series), colour);
                    sketch_.label(0.5 * (x0 + x1), y, "", kChartSmall_px, colours::kInk,
                                  point.c_str());
                    break;
                }
                case Mark::none: break;
            }
            sketch_.label(x1 + 8.0, y, s.name, kChartSmall_px, colours::kInk);
        }
    }

    /// Lines at their heights, names at the right, moved apart where they would touch.
    void levels() {
        struct Name {
            double y_px;
            std::vector<std::string> lines;
        };
        std::vector<Name> names;
        double gap = 18.0;
        for (const ChartLine& level : panel_.levels) {
            if (!drawable(level.at, panel_.log_y) || level.at < y_.low || level.at > y_.high) {
                continue;
            }
            const double y = y_px(level.at);
            sketch_.line(box_.left_px, y, box_.right_px, y, colours::kLevel, 1.2, "back dt (8,5)");
            names.push_back({y, wrapped(level.label, kChartSmall_px, kLevelNames_px)});
            gap = std::max(gap, 18.0 * static_cast<double>(names.back().lines.size()));
        }
        std::sort(names.begin(), names.end(),
                  [](const Name& a, const Name& b) { return a.y_px < b.y_px; });
        std::vector<double> wanted;
        wanted.reserve(names.size());
        for (const Name& name : names) {
            wanted.push_back(name.y_px);
        }
        const std::vector<double> placed = spread(wanted, gap, box_.top_px, box_.bottom_px);
        for (std::size_t i = 0; i < names.size(); ++i) {
            double y = placed[i] - 9.0 * static_cast<double>(names[i].lines.size() - 1);
            for (const std::string& line : names[i].lines) {
                sketch_.label(box_.right_px + 10.0, y, line, kChartSmall_px, colours::kLevel);
                y += 18.0;
            }
        }
    }

    void moments() {
        std::vector<ChartLine> inside;
        for (const ChartLine& moment : panel_.moments) {
            if (drawable(moment.at, panel_.log_x) && moment.at >= x_.low && moment.at <= x_.high) {
                inside.push_back(moment);
            }
        }
        std::stable_sort(inside.begin(), inside.end(),
                         [](const ChartLine& a, const ChartLine& b) { return a.at < b.at; });
        std::vector<double> wanted;
        wanted.reserve(inside.size());
        for (const ChartLine& moment : inside) {
            wanted.push_back(x_px(moment.at));
        }
        if (moments_fit(panel_, box_.width_px())) {
            const double top = box_.top_px - (panel_.y_label.empty() ? 0.0 : kLine_px + 4.0);
            for (std::size_t i = 0; i < inside.size(); ++i) {
                sketch_.line(wanted[i], top - 0.8 * kLine_px, wanted[i], box_.bottom_px,
                             colours::kMoment, 1.2);
                sketch_.label(wanted[i] + 5.0, top - 0.4 * kLine_px, inside[i].label,
                              kChartSmall_px, colours::kInk);
            }
            return;
        }
        const auto placed = spread(wanted, kMomentGap_px, box_.left_px, box_.right_px);
        const std::string slanted = fmt::format("left rotate by {}", kSlant_deg);
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const double foot = box_.top_px - (panel_.y_label.empty() ? 0.0 : kLine_px + 4.0);
            const double head = foot - kLeader_px;
            sketch_.line(wanted[i], foot, wanted[i], box_.bottom_px, colours::kMoment, 1.2);
            sketch_.line(wanted[i], foot, placed[i], head, colours::kMoment, 1.2);
            sketch_.label(placed[i] + 2.0, head - 5.0, inside[i].label, kChartSmall_px,
                          colours::kInk, slanted.c_str());
        }
    }

    void axes() {
        sketch_.frame(box_.left_px, box_.top_px, box_.right_px, box_.bottom_px);
        sketch_.add("{} logscale x\n{} logscale y\n", panel_.log_x ? "set" : "unset",
                    panel_.log_y ? "set" : "unset");
        sketch_.add("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n", x_.low, x_.high,
                    y_.low, y_.high);
        const double high = (box_.bottom_px - box_.top_px) / 56.0;
        set_ticks(sketch_, 'y', panel_.log_y ? log_ticks(y_, high) : ticks(y_, high));
        double below = 30.0;
        if (panel_.categories.empty()) {
            const double wide = box_.width_px() / 90.0;
            set_ticks(sketch_, 'x', panel_.log_x ? log_ticks(x_, wide) : ticks(x_, wide));
        } else {
            set_ticks(sketch_, 'x', {});
            below = categories();
        }
        sketch_.label(0.5 * (box_.left_px + box_.right_px), box_.bottom_px + below + 16.0,
                      panel_.x_label, kChartSmall_px, colours::kFaint, "center");
    }

    double categories() {
        const CategoryNames names = category_names(panel_, box_.width_px());
        const std::string slanted = fmt::format("right rotate by {}", kSlant_deg);
        for (std::size_t i = 0; i < names.lines.size(); ++i) {
            const double x = x_px(static_cast<double>(i));
            if (x < box_.left_px || x > box_.right_px) {
                continue;
            }
            if (names.slanted) {
                sketch_.label(x + 4.0, box_.bottom_px + 12.0, panel_.categories[i], kChartSmall_px,
                              colours::kInk, slanted.c_str());
                continue;
            }
            double y = box_.bottom_px + 15.0;
            for (const std::string& line : names.lines[i]) {
                sketch_.label(x, y, line, kChartSmall_px, colours::kInk, "center");
                y += 0.86 * kLine_px;
            }
        }
        return names.height_px;
    }

    void plot() {
        if (!has_number(panel_)) {
            sketch_.label(0.5 * (box_.left_px + box_.right_px),
                          0.5 * (box_.top_px + box_.bottom_px), "no data", kPanelTitle_px,
                          colours::kFaint, "center");
            // Axes of a plot without a point would not be drawn.
            sketch_.add("plot {:.10g} with lines lc rgb '#FFFFFF' lw 0.1\n",
                        0.5 * (y_.low + y_.high));
            return;
        }
        for (std::size_t i = 0; i < panel_.series.size(); ++i) {
            bands(i);
        }
        for (std::size_t i = 0; i < panel_.series.size(); ++i) {
            series(i);
        }
        sketch_.add("plot {}\n", clauses_);
    }

    void clause(const std::string& text) {
        clauses_ += clauses_.empty() ? text : ", \\\n  " + text;
    }

    /// Each unbroken stretch is a polygon of its own.
    void bands(std::size_t index) {
        const ChartSeries& s = panel_.series[index];
        if (!s.band || s.low.empty()) {
            return;
        }
        std::string rows;
        const auto finish = [&] {
            if (!rows.empty()) {
                data_.text += rows;
                rows.clear();
                clause(fmt::format(
                    "DATA index {} using 1:2:3 with filledcurves fs noborder fc rgb '#B0{}'",
                    data_.close(), colour_of(panel_, index).substr(1)));
            }
        };
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (drawable(s.x[i], panel_.log_x) && drawable(s.low[i], panel_.log_y) &&
                drawable(s.high[i], panel_.log_y)) {
                rows += fmt::format("{:.10g} {:.10g} {:.10g}\n", s.x[i], s.low[i], s.high[i]);
            } else {
                finish();
            }
        }
        finish();
    }

    void series(std::size_t index) {
        const ChartSeries& s = panel_.series[index];
        const std::string colour = colour_of(panel_, index);
        const double shift = s.mark == Mark::bars ? bar_shift(index) : 0.0;
        const std::string block =
            fmt::format("DATA index {} using ", put_block(data_, panel_, s, shift, y_.low));
        const bool errors = !s.low.empty() && !s.band;
        switch (s.mark) {
            case Mark::line:
                clause(fmt::format("{}1:2 with lines lc rgb '{}' lw 2", block, colour));
                break;
            case Mark::dashes:
                clause(fmt::format("{}1:2 with lines dt (9,5) lc rgb '{}' lw 2", block, colour));
                break;
            case Mark::steps:
                clause(fmt::format("{}1:2 with steps lc rgb '{}' lw 2", block, colour));
                break;
            case Mark::bars: bars(block, colour); break;
            case Mark::points:
            case Mark::none: break;
        }
        if (errors) {
            const char* pen = s.mark == Mark::bars ? colours::kInk : colour.c_str();
            clause(fmt::format(
                "{}1:3:(0):($4-$3) with vectors heads size screen 0.005,90 lw 1.6 lc rgb '{}'",
                block, pen));
        }
        if (s.mark == Mark::points) {
            clause(fmt::format("{}1:2 with points pt {} ps 0.9*MARK lc rgb '{}'", block,
                               shape_of(panel_, index), colour));
        }
    }

    [[nodiscard]] std::size_t bar_count() const {
        return static_cast<std::size_t>(
            std::count_if(panel_.series.begin(), panel_.series.end(),
                          [](const ChartSeries& s) { return s.mark == Mark::bars; }));
    }

    /// Width of a bar: what is between neighbours is shared by the series.
    [[nodiscard]] double bar_width() const {
        double pitch = panel_.categories.empty() ? x_.high - x_.low : 1.0;
        for (const ChartSeries& s : panel_.series) {
            for (std::size_t i = 1; s.mark == Mark::bars && i < s.x.size(); ++i) {
                const double apart = std::abs(s.x[i] - s.x[i - 1]);
                pitch = apart > 0.0 ? std::min(pitch, apart) : pitch;
            }
        }
        const double most = kMostBar_px / box_.width_px() * (x_.high - x_.low);
        return std::min(0.76 * pitch / static_cast<double>(bar_count()), most);
    }

    [[nodiscard]] double bar_shift(std::size_t index) const {
        double before = 0.0;
        for (std::size_t i = 0; i < index; ++i) {
            before += panel_.series[i].mark == Mark::bars ? 1.0 : 0.0;
        }
        return bar_width() * (before - 0.5 * static_cast<double>(bar_count() - 1));
    }

    void bars(const std::string& block, const std::string& colour) {
        const double half = 0.47 * bar_width();
        const double foot = panel_.log_y ? y_.low : std::clamp(0.0, y_.low, y_.high);
        clause(
            fmt::format("{}1:2:($1-{:.10g}):($1+{:.10g}):(${}<{:.10g}?$2:{:.10g}):($2<{:.10g}?"
                        "{:.10g}:$2) with boxxyerror fs solid noborder fc rgb '{}'",
                        block, half, half, 2, foot, foot, foot, foot, colour));
    }

    Sketch& sketch_;
    ChartData& data_;
    const ChartPanel& panel_;
    const PlotBox& box_;
    Range x_;
    Range y_;
    std::string clauses_;
};

}  // namespace

void draw_panel(Sketch& sketch, ChartData& data, const ChartPanel& panel, const PlotBox& box) {
    PanelDrawing(sketch, data, panel, box).draw();
}

}  // namespace limpet
