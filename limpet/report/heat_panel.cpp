// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/report/axes.hpp"
#include "limpet/report/chart_parts.hpp"
#include "limpet/report/colours.hpp"
#include "limpet/report/contour.hpp"
#include "limpet/report/gnuplot.hpp"

namespace limpet {
namespace {

constexpr double kBarGap_px = 20.0;
constexpr double kBar_px = 20.0;
constexpr double kNameHalf_px = 10.0;  ///< half the height of a name on the map
constexpr std::size_t kPixels = 200;   ///< of the map along each axis; between them it is smooth

struct Rgb {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

constexpr Rgb kNoValue = {200, 203, 207};
// Blue and orange stay apart for all common kinds of colour blindness.
constexpr std::array<Rgb, 5> kSigned = {
    {{11, 60, 93}, {111, 168, 214}, {250, 250, 250}, {240, 163, 94}, {163, 71, 0}}};
constexpr std::array<Rgb, 3> kUnsigned = {{{250, 250, 250}, {111, 168, 214}, {11, 60, 93}}};

template <std::size_t N>
Rgb along(const std::array<Rgb, N>& stops, double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(N - 1);
    const auto i = std::min(static_cast<std::size_t>(at), N - 2);
    const double t = at - static_cast<double>(i);
    const auto mix = [t](double a, double b) { return std::round(a + t * (b - a)); };
    return {mix(stops[i].red, stops[i + 1].red), mix(stops[i].green, stops[i + 1].green),
            mix(stops[i].blue, stops[i + 1].blue)};
}

/// The values that the colours span; each side of zero has its own scale and white is 0.
Range value_range(const HeatPanel& panel) {
    if (panel.z_range) {
        return *panel.z_range;
    }
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double z : panel.z) {
        if (std::isfinite(z)) {
            low = std::min(low, z);
            high = std::max(high, z);
        }
    }
    if (low > high) {
        return {panel.signed_values ? -1.0 : 0.0, 1.0};
    }
    if (panel.signed_values) {
        low = std::min(low, 0.0);
        high = std::max(high, 0.0);
    }
    return low < high ? Range{low, high} : Range{low - 0.5, high + 0.5};
}

Rgb colour_of(const HeatPanel& panel, const Range& range, double z) {
    if (!std::isfinite(z)) {
        return kNoValue;
    }
    if (!panel.signed_values) {
        return along(kUnsigned, (z - range.low) / (range.high - range.low));
    }
    // One unit has the same strength on both sides.
    const double most = std::max(std::abs(range.low), std::abs(range.high));
    return along(kSigned, 0.5 + 0.5 * z / most);
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
    MapDrawing(Sketch& sketch, ChartData& data, const HeatPanel& panel, const PlotBox& box)
        : sketch_(sketch), data_(data), panel_(panel), box_(box), range_(value_range(panel)) {}

    void draw() {
        draw_title(sketch_, panel_.title, box_.left_px,
                   box_.top_px - head_px(panel_, box_.width_px()), box_.width_px());
        sketch_.label(box_.left_px, box_.top_px - 16.0, panel_.y_label, kChartSmall_px,
                      colours::kFaint);
        sketch_.label(box_.right_px + kBarGap_px + kBar_px, box_.top_px - 16.0, panel_.z_label,
                      kChartSmall_px, colours::kFaint, "right");
        sketch_.label(0.5 * (box_.left_px + box_.right_px), box_.bottom_px + 46.0, panel_.x_label,
                      kChartSmall_px, colours::kFaint, "center");
        colour_bar();
        axes();
        image();
        contours();
        points();
        sketch_.add("set grid noxtics noytics\nplot {}\nset grid xtics ytics\n", clauses_);
    }

private:
    void axes() {
        sketch_.frame(box_.left_px, box_.top_px, box_.right_px, box_.bottom_px);
        sketch_.add("unset logscale x\nunset logscale y\n");
        sketch_.add("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n",
                    panel_.x.front(), panel_.x.back(), panel_.y.front(), panel_.y.back());
        set_ticks(sketch_, 'x', ticks({panel_.x.front(), panel_.x.back()}, box_.width_px() / 90.0));
        set_ticks(sketch_, 'y',
                  ticks({panel_.y.front(), panel_.y.back()}, panel_.height_px / 56.0));
    }

    /// Thin slices that overlap, so that no seam shows; from the top down.
    void colour_bar() {
        constexpr int kSlices = 80;
        const double x0 = box_.right_px + kBarGap_px, x1 = x0 + kBar_px;
        const double height = box_.bottom_px - box_.top_px;
        for (int i = 0; i < kSlices; ++i) {
            const double share = static_cast<double>(i) / kSlices;
            const double z = range_.high - (share + 0.5 / kSlices) * (range_.high - range_.low);
            const Rgb c = colour_of(panel_, range_, z);
            const std::string colour =
                fmt::format("#{:02X}{:02X}{:02X}", static_cast<int>(c.red),
                            static_cast<int>(c.green), static_cast<int>(c.blue));
            sketch_.box(x0, box_.top_px + share * height, x1, box_.bottom_px, colour.c_str());
        }
        for (const double tick : ticks(range_, panel_.height_px / 70.0)) {
            const double y =
                box_.bottom_px - (tick - range_.low) / (range_.high - range_.low) * height;
            sketch_.line(x1, y, x1 + 4.0, y, colours::kFaint, 0.8, "front");
            sketch_.label(x1 + 8.0, y, tick_label(tick), kChartSmall_px, colours::kInk);
        }
    }

    void image() {
        const Grid grid{panel_.x, panel_.y, panel_.z};
        const double dx = (panel_.x.back() - panel_.x.front()) / kPixels;
        const double dy = (panel_.y.back() - panel_.y.front()) / kPixels;
        for (std::size_t j = 0; j < kPixels; ++j) {
            for (std::size_t i = 0; i < kPixels; ++i) {
                const double x = panel_.x.front() + (static_cast<double>(i) + 0.5) * dx;
                const double y = panel_.y.front() + (static_cast<double>(j) + 0.5) * dy;
                const Rgb c = colour_of(panel_, range_, interpolated(grid, x, y));
                data_.text += fmt::format("{:.10g} {:.10g} {:.0f} {:.0f} {:.0f}\n", x, y, c.red,
                                          c.green, c.blue);
            }
        }
        clause(fmt::format("DATA index {} using 1:2:3:4:5 with rgbimage", data_.close()));
    }

    void contours() {
        std::vector<double> levels = panel_.levels;
        if (panel_.signed_values && std::find(levels.begin(), levels.end(), 0.0) == levels.end()) {
            levels.push_back(0.0);
        }
        for (const double level : levels) {
            const auto lines = contour({panel_.x, panel_.y, panel_.z}, level);
            if (lines.empty()) {
                continue;
            }
            for (const ContourLine& line : lines) {
                for (const ContourPoint& point : line) {
                    data_.text += fmt::format("{:.10g} {:.10g}\n", point.x, point.y);
                }
                data_.text += "\n";
            }
            const bool zero = panel_.signed_values && level == 0.0;
            clause(fmt::format("DATA index {} using 1:2 with lines lc rgb '{}' lw {}",
                               data_.close(), colours::kInk, zero ? 3.2 : 0.9));
            name(level,
                 *std::max_element(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
                     return a.size() < b.size();
                 }));
        }
    }

    /// In the middle of its longest line, on a ground of its own.
    void name(double level, const ContourLine& line) {
        const ContourPoint& middle = line[line.size() / 2];
        const std::string text = tick_label(level);
        const double x = x_px(middle.x), y = y_px(middle.y);
        const double half = 0.5 * text_width_px(text, kChartSmall_px);
        sketch_.label(x, y, text, kChartSmall_px, colours::kInk, "center boxed");
        taken_.push_back({x - half, y - kNameHalf_px, x + half, y + kNameHalf_px});
    }

    void points() {
        sketch_.add("set style textbox opaque margins 0.4,0.3 fillcolor rgb '#FFFFFF' noborder\n");
        for (const bool filled : {true, false}) {
            std::string rows;
            for (const HeatPoint& point : panel_.points) {
                if (point.filled == filled && inside(point)) {
                    rows += fmt::format("{:.10g} {:.10g}\n", point.x, point.y);
                }
            }
            if (rows.empty()) {
                continue;
            }
            data_.text += rows;
            const int block = data_.close();
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
                       2.0 * kNameHalf_px, kGap_px, taken_,
                       {box_.left_px, box_.top_px, box_.right_px, box_.bottom_px});
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
               (x - panel_.x.front()) / (panel_.x.back() - panel_.x.front()) * box_.width_px();
    }
    [[nodiscard]] double y_px(double y) const {
        return box_.bottom_px - (y - panel_.y.front()) / (panel_.y.back() - panel_.y.front()) *
                                    (box_.bottom_px - box_.top_px);
    }

    void clause(const std::string& text) {
        clauses_ += clauses_.empty() ? text : ", \\\n  " + text;
    }

    Sketch& sketch_;
    ChartData& data_;
    const HeatPanel& panel_;
    const PlotBox& box_;
    Range range_;
    std::string clauses_;
    std::vector<Box> taken_;  ///< by names and marks
};

}  // namespace

Sides sides(const HeatPanel& panel) {
    check(panel);
    double left = 0.0, right = 0.0;
    for (const double tick : ticks({panel.y.front(), panel.y.back()}, panel.height_px / 56.0)) {
        left = std::max(left, text_width_px(tick_label(tick), kChartFont_px));
    }
    for (const double tick : ticks(value_range(panel), panel.height_px / 70.0)) {
        right = std::max(right, text_width_px(tick_label(tick), kChartSmall_px));
    }
    return {left + 14.0, kBarGap_px + kBar_px + 8.0 + right};
}

double head_px(const HeatPanel& panel, double width_px) {
    return title_px(panel.title, width_px) + kLine_px + 8.0;
}

double foot_px(const HeatPanel& panel, double) {
    return 30.0 + (panel.x_label.empty() ? 4.0 : 28.0);
}

void draw_panel(Sketch& sketch, ChartData& data, const HeatPanel& panel, const PlotBox& box) {
    MapDrawing(sketch, data, panel, box).draw();
}

}  // namespace limpet
