// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/draw/chart_parts.hpp"
#include "limpet/draw/colours.hpp"

namespace limpet::draw {
namespace {

constexpr double kBarGap_px = 20.0;
constexpr double kBar_px = 20.0;
constexpr std::size_t kPixels = 200;  ///< of the map along each axis; between them it is smooth

// Blue and orange stay apart for all common kinds of colour blindness.
constexpr const char* kGrowthPalette =
    "-2 '#0B3C5D', -1 '#6FA8D6', 0 '#FAFAFA', 1 '#F0A35E', 2 '#A34700'";

void check(const HeatPanel& panel) {
    require(panel.x.size() >= 2 && panel.y.size() >= 2, "a map has two points along each axis");
    require(
        panel.z.size() == panel.x.size() * panel.y.size() &&
            std::all_of(panel.z.begin(), panel.z.end(), [](double z) { return std::isfinite(z); }),
        "a map has a value for each point");
    for (const auto* axis : {&panel.x, &panel.y}) {
        const double step = (axis->back() - axis->front()) / static_cast<double>(axis->size() - 1);
        for (std::size_t i = 1; i < axis->size(); ++i) {
            require(step > 0.0 && std::abs((*axis)[i] - (*axis)[i - 1] - step) < 1e-6 * step,
                    "a map's points ascend evenly");
        }
    }
    require(panel.z_most > 0.0, "a map's colours span something");
}

constexpr const char* kNextPlot = ", \\\n  ";

/// A place between the points of an even axis.
struct Between {
    std::size_t below;
    double share;  ///< of the way to the next one

    /// @param along  0..1 of the axis
    Between(double along, std::size_t points) {
        const double at = along * static_cast<double>(points - 1);
        below = std::min(static_cast<std::size_t>(at), points - 2);
        share = at - static_cast<double>(below);
    }
    [[nodiscard]] double mix(double low, double high) const {
        return low * (1.0 - share) + high * share;
    }
};

class MapDrawing {
public:
    MapDrawing(Sketch& sketch, ChartData& data, const HeatPanel& panel, const Box& box)
        : sketch_(sketch),
          data_(data),
          panel_(panel),
          box_(box),
          x_{panel.x.front(), panel.x.back()},
          y_{panel.y.front(), panel.y.back()} {}

    void draw() {
        draw_lines(sketch_, title_lines(panel_.title, box_.width_px()), box_.left_px,
                   box_.top_px - head_px(panel_, box_.width_px()), kPanelTitle_px, colours::kInk);
        sketch_.label(box_.left_px, box_.top_px - 16.0, panel_.y_label, kChartSmall_px,
                      colours::kFaint);
        sketch_.label(box_.right_px + kBarGap_px + kBar_px, box_.top_px - 16.0, panel_.z_label,
                      kChartSmall_px, colours::kFaint, "right");
        sketch_.frame(box_);
        set_axis(sketch_, "x", x_, false, box_.width_px() / 90.0);
        set_axis(sketch_, "y", y_, false, box_.height_px() / 56.0);
        name_x_axis(sketch_, panel_.x_label);
        sketch_.add("unset key\nunset grid\n");
        const std::string plots = image() + contours() + points();
        sketch_.add("plot {}\n", plots);
    }

private:
    [[nodiscard]] std::string image() {
        const double x1 = box_.right_px + kBarGap_px, wide = kBar_px / box_.width_px();
        sketch_.add("set palette defined ({})\n", kGrowthPalette);
        sketch_.add("set colorbox user noborder origin {} size graph {:.5f}, graph 1\n",
                    sketch_.at(x1, box_.bottom_px), wide);
        sketch_.add("set cbrange [{:.10g}:{:.10g}]\nset cbtics {:.10g}\nset format cb '%h'\n",
                    -panel_.z_most, panel_.z_most,
                    tick_step({-panel_.z_most, panel_.z_most}, box_.height_px() / 70.0));
        std::vector<double> x, y, z;
        const auto pixel = [](std::size_t k) { return (static_cast<double>(k) + 0.5) / kPixels; };
        for (std::size_t k = 0; k < kPixels * kPixels; ++k) {
            const double along = pixel(k % kPixels), up = pixel(k / kPixels);
            const Between i(along, panel_.x.size()), j(up, panel_.y.size());
            const double* corner = &panel_.z[j.below * panel_.x.size() + i.below];
            const double* above = corner + panel_.x.size();
            x.push_back(x_.low + along * (x_.high - x_.low));
            y.push_back(y_.low + up * (y_.high - y_.low));
            z.push_back(j.mix(i.mix(corner[0], corner[1]), i.mix(above[0], above[1])));
        }
        return fmt::format("DATA index {} using 1:2:3 with image", data_.add({&x, &y, &z}));
    }

    /// gnuplot's, from the grid's own points; each line's name a few points from its beginning.
    [[nodiscard]] std::string contours() {
        std::vector<double> x, y;
        for (std::size_t k = 0; k < panel_.z.size(); ++k) {
            x.push_back(panel_.x[k % panel_.x.size()]);
            y.push_back(panel_.y[k / panel_.x.size()]);
        }
        const int block = data_.add({&x, &y, &panel_.z}, panel_.x.size());
        std::vector<double> levels = {0.0};
        levels.insert(levels.end(), panel_.levels.begin(), panel_.levels.end());
        sketch_.prepare(
            "set contour base\nunset surface\nset cntrparam levels discrete {0}\n"
            "set table $C{1}\nsplot DATA index {1} using 1:2:3 with lines\nunset table\nreset\n",
            fmt::format("{:.10g}", fmt::join(levels, ",")), block);
        return fmt::format(
            "{0}$C{1} using 1:(abs($3)<1e-12?NaN:$2) with lines lc rgb '{2}' lw 0.9"
            "{0}$C{1} using 1:(abs($3)<1e-12?$2:NaN) with lines lc rgb '{2}' lw 3.2"
            "{0}$C{1} using 1:2:(sprintf('%g',$3)) every ::{3}::{3} with labels boxed font "
            "'DejaVu Sans,{4}' textcolor rgb '{2}'",
            kNextPlot, block, colours::kInk, (panel_.x.size() + panel_.y.size()) / 6,
            kChartSmall_px);
    }

    /// Each with its name above it; near the top below.
    [[nodiscard]] std::string points() {
        constexpr double kGap_px = 17.0, kNearTheTop = 0.9;
        sketch_.add("set style textbox opaque margins 0.4,0.3 fillcolor rgb '#FFFFFF' noborder\n");
        std::vector<double> x, y;
        for (const HeatPoint& point : panel_.points) {
            const double along = share_of(point.x, x_, false), up = share_of(point.y, y_, false);
            if (along < 0.0 || along > 1.0 || up < 0.0 || up > 1.0) {
                continue;
            }
            x.push_back(point.x);
            y.push_back(point.y);
            sketch_.label(
                box_.left_px + along * box_.width_px(),
                box_.bottom_px - up * box_.height_px() + (up < kNearTheTop ? -kGap_px : kGap_px),
                point.label, kChartSmall_px, colours::kInk, "center boxed");
        }
        if (x.empty()) {
            return "";
        }
        const int block = data_.add({&x, &y});
        // A white ground first: ink on dark colours would not be seen.
        return fmt::format(
            "{0}DATA index {1} using 1:2 with points pt 7 ps 1.5*MARK lc rgb '#FFFFFF'"
            "{0}DATA index {1} using 1:2 with points pt 7 ps 1.0*MARK lw 1.8 lc rgb '{2}'",
            kNextPlot, block, colours::kInk);
    }

    Sketch& sketch_;
    ChartData& data_;
    const HeatPanel& panel_;
    const Box& box_;
    Range x_;
    Range y_;
};

}  // namespace

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
