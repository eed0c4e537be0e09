// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/draw/axes.hpp"
#include "limpet/draw/chart_parts.hpp"
#include "limpet/draw/colours.hpp"

namespace limpet::draw {
namespace {

constexpr double kBarGap_px = 20.0;
constexpr double kBar_px = 20.0;
constexpr double kNameHalf_px = 10.0;  ///< half the height of a name on the map
constexpr std::size_t kPixels = 200;   ///< of the map along each axis; between them it is smooth

constexpr const char* kNoValue = "#C8CBCF";
// Blue and orange stay apart for all common kinds of colour blindness.
constexpr const char* kSigned = "-2 '#0B3C5D', -1 '#6FA8D6', 0 '#FAFAFA', 1 '#F0A35E', 2 '#A34700'";
constexpr const char* kUnsigned = "0 '#FAFAFA', 1 '#6FA8D6', 2 '#0B3C5D'";

/// The values that the colours span; signed ones as far below 0 as above it, so that one unit has
/// the same strength on both sides.
Range value_range(const HeatPanel& panel) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double z : panel.z) {
        if (std::isfinite(z)) {
            range = {std::min(range.low, z), std::max(range.high, z)};
        }
    }
    range = panel.z_range ? *panel.z_range : range.low > range.high ? Range{0.0, 1.0} : range;
    if (panel.signed_values) {
        const double most = std::max(std::abs(range.low), std::abs(range.high));
        return most > 0.0 ? Range{-most, most} : Range{-1.0, 1.0};
    }
    return range.low < range.high ? range : Range{range.low - 0.5, range.high + 0.5};
}

/// @return the cell that holds `value` and how far into it, or false
bool locate(const std::vector<double>& axis, double value, std::size_t& cell, double& share) {
    if (!(value >= axis.front() && value <= axis.back())) {
        return false;
    }
    const auto after = std::upper_bound(axis.begin(), axis.end(), value);
    const auto last = static_cast<std::ptrdiff_t>(axis.size()) - 2;
    cell = static_cast<std::size_t>(std::clamp(after - axis.begin() - 1, std::ptrdiff_t{0}, last));
    share = (value - axis[cell]) / (axis[cell + 1] - axis[cell]);
    return true;
}

void check(const HeatPanel& panel) {
    require(panel.x.size() >= 2 && panel.y.size() >= 2, "a map has two points along each axis");
    require(panel.z.size() == panel.x.size() * panel.y.size(), "a map has a value for each point");
    for (const auto* axis : {&panel.x, &panel.y}) {
        const double step = (axis->back() - axis->front()) / static_cast<double>(axis->size() - 1);
        for (std::size_t i = 1; i < axis->size(); ++i) {
            require(step > 0.0 && std::abs((*axis)[i] - (*axis)[i - 1] - step) < 1e-6 * step,
                    "a map's points ascend evenly");
        }
    }
    require(!panel.z_range || panel.z_range->low < panel.z_range->high,
            "a range has a low end and a high end");
}

class MapDrawing {
public:
    MapDrawing(Sketch& sketch, ChartData& data, const HeatPanel& panel, const Box& box)
        : sketch_(sketch), data_(data), panel_(panel), box_(box) {}

    void draw() {
        draw_lines(sketch_, title_lines(panel_.title, box_.width_px()), box_.left_px,
                   box_.top_px - head_px(panel_, box_.width_px()), kPanelTitle_px, colours::kInk);
        sketch_.label(box_.left_px, box_.top_px - 16.0, panel_.y_label, kChartSmall_px,
                      colours::kFaint);
        sketch_.label(box_.right_px + kBarGap_px + kBar_px, box_.top_px - 16.0, panel_.z_label,
                      kChartSmall_px, colours::kFaint, "right");
        sketch_.frame(box_);
        set_axis(sketch_, "x", {panel_.x.front(), panel_.x.back()}, false, box_.width_px() / 90.0);
        set_axis(sketch_, "y", {panel_.y.front(), panel_.y.back()}, false, box_.height_px() / 56.0);
        name_x_axis(sketch_, panel_.x_label);
        sketch_.add("unset key\nunset grid\n");
        image();
        contours();
        points();
        sketch_.add("plot {}\n", clauses_);
    }

private:
    void image() {
        const Range range = value_range(panel_);
        const double x1 = box_.right_px + kBarGap_px, wide = kBar_px / box_.width_px();
        sketch_.box(box_.left_px, box_.top_px, box_.right_px, box_.bottom_px, kNoValue);
        sketch_.add("set palette defined ({})\n", panel_.signed_values ? kSigned : kUnsigned);
        sketch_.add("set colorbox user noborder origin {} size graph {:.5f}, graph 1\n",
                    sketch_.at(x1, box_.bottom_px), wide);
        sketch_.add("set cbrange [{:.10g}:{:.10g}]\nset cbtics {:.10g}\nset format cb '%h'\n",
                    range.low, range.high, tick_step(range, box_.height_px() / 70.0));
        std::vector<double> x, y, z;
        for (std::size_t k = 0; k < kPixels * kPixels; ++k) {
            const auto along = [](const std::vector<double>& axis, std::size_t i) {
                return axis.front() +
                       (static_cast<double>(i) + 0.5) * (axis.back() - axis.front()) / kPixels;
            };
            x.push_back(along(panel_.x, k % kPixels));
            y.push_back(along(panel_.y, k / kPixels));
            z.push_back(interpolated({panel_.x, panel_.y, panel_.z}, x.back(), y.back()));
        }
        // A point alone keeps gnuplot from giving up where there is no value at all.
        clause(fmt::format("'+' using ({:.10g}):({:.10g}) with dots lc rgb '{}'", panel_.x.front(),
                           panel_.y.front(), kNoValue));
        if (std::any_of(z.begin(), z.end(), [](double value) { return std::isfinite(value); })) {
            clause(fmt::format("DATA index {} using 1:2:3 with image", data_.add({&x, &y, &z})));
        }
    }

    /// gnuplot's, from the grid's own points; each line's name a few points from its beginning.
    void contours() {
        std::string levels = panel_.signed_values ? "0" : "";
        for (const double level : panel_.levels) {
            if (level != 0.0 || !panel_.signed_values) {
                levels += fmt::format("{}{:.10g}", levels.empty() ? "" : ",", level);
            }
        }
        const bool any = std::any_of(panel_.z.begin(), panel_.z.end(),
                                     [](double value) { return std::isfinite(value); });
        if (levels.empty() || !any) {
            return;
        }
        std::vector<double> x, y;
        for (std::size_t k = 0; k < panel_.z.size(); ++k) {
            x.push_back(panel_.x[k % panel_.x.size()]);
            y.push_back(panel_.y[k / panel_.x.size()]);
        }
        const int block = data_.add({&x, &y, &panel_.z}, panel_.x.size());
        sketch_.prepare(
            "set contour base\nunset surface\nset cntrparam levels discrete {0}\n"
            "set table $C{1}\nsplot DATA index {1} using 1:2:3 with lines\nunset table\nreset\n",
            levels, block);
        const char* zero = panel_.signed_values ? "abs($3)<1e-12" : "0";
        clause(fmt::format("$C{} using 1:({}?NaN:$2) with lines lc rgb '{}' lw 0.9", block, zero,
                           colours::kInk));
        clause(fmt::format("$C{} using 1:({}?$2:NaN) with lines lc rgb '{}' lw 3.2", block, zero,
                           colours::kInk));
        clause(fmt::format(
            "$C{0} using 1:2:(sprintf('%g',$3)) every ::{1}::{1} with labels boxed font "
            "'DejaVu Sans,{2}' textcolor rgb '{3}'",
            block, (panel_.x.size() + panel_.y.size()) / 6, kChartSmall_px, colours::kInk));
    }

    void points() {
        sketch_.add("set style textbox opaque margins 0.4,0.3 fillcolor rgb '#FFFFFF' noborder\n");
        for (const bool filled : {true, false}) {
            std::vector<double> x, y;
            for (const HeatPoint& point : panel_.points) {
                if (point.filled == filled && inside(point)) {
                    x.push_back(point.x);
                    y.push_back(point.y);
                }
            }
            if (x.empty()) {
                continue;
            }
            const int block = data_.add({&x, &y});
            // A white ground first: ink on dark colours would not be seen.
            clause(fmt::format(
                "DATA index {} using 1:2 with points pt 7 ps 1.5*MARK lc rgb '#FFFFFF'", block));
            clause(fmt::format(
                "DATA index {} using 1:2 with points pt {} ps {}*MARK lw 1.8 lc rgb '{}'", block,
                filled ? 7 : 6, filled ? 1.0 : 1.1, colours::kInk));
        }
        names();
    }

    void names() {
        constexpr double kMark_px = 7.0, kGap_px = 12.0;
        for (const HeatPoint& point : panel_.points) {
            const double x = x_px(point.x), y = y_px(point.y);
            taken_.push_back({x - kMark_px, y - kMark_px, x + kMark_px, y + kMark_px});
        }
        for (const HeatPoint& point : panel_.points) {
            if (point.label.empty() || !inside(point)) {
                continue;
            }
            const Box place =
                beside(x_px(point.x), y_px(point.y), text_width_px(point.label, kChartSmall_px),
                       2.0 * kNameHalf_px, kGap_px, taken_, box_);
            // The estimate of the width is generous: the name keeps to the mark's side.
            const bool right = place.left_px > x_px(point.x), left = place.right_px < x_px(point.x);
            sketch_.label(right  ? place.left_px
                          : left ? place.right_px
                                 : x_px(point.x),
                          0.5 * (place.top_px + place.bottom_px), point.label, kChartSmall_px,
                          colours::kInk,
                          right  ? "left boxed"
                          : left ? "right boxed"
                                 : "center boxed");
            taken_.push_back(place);
        }
    }

    [[nodiscard]] bool inside(const HeatPoint& point) const {
        return point.x >= panel_.x.front() && point.x <= panel_.x.back() &&
               point.y >= panel_.y.front() && point.y <= panel_.y.back();
    }

    [[nodiscard]] double x_px(double x) const {
        return box_.left_px +
               share_of(x, {panel_.x.front(), panel_.x.back()}, false) * box_.width_px();
    }
    [[nodiscard]] double y_px(double y) const {
        return box_.bottom_px -
               share_of(y, {panel_.y.front(), panel_.y.back()}, false) * box_.height_px();
    }

    void clause(const std::string& text) {
        clauses_ += clauses_.empty() ? text : ", \\\n  " + text;
    }

    Sketch& sketch_;
    ChartData& data_;
    const HeatPanel& panel_;
    const Box& box_;
    std::string clauses_;
    std::vector<Box> taken_;  ///< by names and marks
};

}  // namespace

double interpolated(const Grid& grid, double x, double y) {
    std::size_t i = 0, j = 0;
    double u = 0.0, v = 0.0;
    if (!locate(grid.x, x, i, u) || !locate(grid.y, y, j, v)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double low = grid.at(i, j) * (1.0 - u) + grid.at(i + 1, j) * u;
    const double high = grid.at(i, j + 1) * (1.0 - u) + grid.at(i + 1, j + 1) * u;
    return low * (1.0 - v) + high * v;
}

double right_px(const HeatPanel& panel) {
    check(panel);
    return kBarGap_px + kBar_px + 56.0;
}

double head_px(const HeatPanel& panel, double width_px) {
    return kLine_px * static_cast<double>(title_lines(panel.title, width_px).size() + 1) + 8.0;
}

double foot_px(const HeatPanel& panel, double) {
    return 30.0 + (panel.x_label.empty() ? 4.0 : 28.0);
}

void draw_panel(Sketch& sketch, ChartData& data, const HeatPanel& panel, const Box& box) {
    MapDrawing(sketch, data, panel, box).draw();
}

}  // namespace limpet::draw
