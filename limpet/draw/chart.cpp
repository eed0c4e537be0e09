// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/chart.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/draw/chart_parts.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::draw {
namespace {

constexpr double kMargin_px = 14.0;
constexpr double kNumbers_px = 56.0;  ///< left of the vertical axis
constexpr double kTitleFont_px = 22.0;
constexpr double kBetween_px = 14.0;  ///< rows

using AnyPanel = std::variant<ChartPanel, HeatPanel>;

/// Where the panels are: a grid whose columns share their margins, so that axes line up.
class Layout {
public:
    explicit Layout(const Chart& chart)
        : chart_(chart), columns_(static_cast<std::size_t>(std::max(1, chart.columns))) {
        column_px_ = chart.column_px > 0.0 ? chart.column_px : columns_ == 1 ? 640.0 : 600.0;
        const double room_px = width_px() - 2.0 * kMargin_px;
        if (!chart.title.empty()) {
            title_ = wrapped(chart.title, kTitleFont_px, room_px);
        }
        if (!chart.subtitle.empty() || !chart.warning.empty()) {
            subtitle_ = wrapped(chart.subtitle, kChartSmall_px, room_px);
        }
        bottom_px_ = 2.0 * kMargin_px + 4.0 + kLine_px * static_cast<double>(subtitle_.size()) +
                     1.3 * kLine_px * static_cast<double>(title_.size());
        for (std::size_t first = 0; first < chart.panels.size(); first += columns_) {
            add_row(first);
        }
    }

    [[nodiscard]] Canvas canvas() const {
        return {static_cast<int>(width_px()), static_cast<int>(std::ceil(bottom_px_))};
    }
    [[nodiscard]] const Box& box(std::size_t panel) const { return boxes_[panel]; }

    void draw_head(Sketch& sketch) const {
        double y = kMargin_px + 0.5 * kLine_px;
        for (const std::string& line : title_) {
            sketch.label(kMargin_px, y, line, kTitleFont_px, colours::kInk);
            y += 1.3 * kLine_px;
        }
        sketch.label(width_px() - kMargin_px, y, chart_.warning, kChartSmall_px, colours::kWarning,
                     "right");
        draw_lines(sketch, subtitle_, kMargin_px, y - 0.5 * kLine_px, kChartSmall_px,
                   colours::kFaint);
    }

private:
    [[nodiscard]] double width_px() const { return column_px_ * static_cast<double>(columns_); }

    [[nodiscard]] double column_right_px(std::size_t column) const {
        double most = 0.0;
        for (std::size_t i = column; i < chart_.panels.size(); i += columns_) {
            most = std::max(
                most, std::visit([](const auto& p) { return right_px(p); }, chart_.panels[i]));
        }
        return most;
    }

    void add_row(std::size_t first) {
        const std::size_t end = std::min(first + columns_, chart_.panels.size());
        double head = 0.0, foot = 0.0, plot = 0.0;
        for (std::size_t i = first; i < end; ++i) {
            const double left = column_px_ * static_cast<double>(i - first);
            Box box;
            box.left_px = left + kMargin_px + kNumbers_px;
            box.right_px = left + column_px_ - kMargin_px - column_right_px(i - first);
            const double width = box.width_px();
            std::visit(
                [&](const auto& panel) {
                    head = std::max(head, head_px(panel, width));
                    foot = std::max(foot, foot_px(panel, width));
                    plot = std::max(plot, panel.height_px);
                },
                chart_.panels[i]);
            boxes_.push_back(box);
        }
        for (std::size_t i = first; i < end; ++i) {
            boxes_[i].top_px = bottom_px_ - (first == 0 ? kMargin_px : 0.0) + head;
            boxes_[i].bottom_px = boxes_[i].top_px + plot;
        }
        bottom_px_ = boxes_[first].bottom_px + foot + kBetween_px;
    }

    const Chart& chart_;
    std::size_t columns_;
    double column_px_ = 0.0;
    double bottom_px_ = 0.0;
    std::vector<std::string> title_;
    std::vector<std::string> subtitle_;
    std::vector<Box> boxes_;
};

}  // namespace

int ChartData::add(std::initializer_list<const std::vector<double>*> columns,
                   std::size_t row_length) {
    const std::size_t rows = (*columns.begin())->size();
    for (std::size_t i = 0; i < rows; ++i) {
        for (const std::vector<double>* column : columns) {
            text += std::isfinite((*column)[i]) ? fmt::format("{:.10g} ", (*column)[i]) : "NaN ";
        }
        text += row_length > 0 && (i + 1) % row_length == 0 ? "\n\n" : "\n";
    }
    text += rows == 0 ? "NaN NaN NaN NaN\n\n\n" : "\n\n";  // a block must not be empty
    return blocks++;
}

std::vector<std::string> title_lines(const std::string& title, double width_px) {
    return title.empty() ? std::vector<std::string>{} : wrapped(title, kPanelTitle_px, width_px);
}

double draw_lines(Sketch& sketch, const std::vector<std::string>& lines, double left_px,
                  double top_px, double size_px, const char* colour) {
    for (const std::string& line : lines) {
        sketch.label(left_px, top_px + 0.5 * kLine_px, line, size_px, colour);
        top_px += kLine_px;
    }
    return top_px;
}

void name_x_axis(Sketch& sketch, const std::string& name) {
    sketch.add("set xlabel {} noenhanced font 'DejaVu Sans,{}' textcolor rgb '{}'\n",
               gnuplot::literal(name), kChartSmall_px, colours::kFaint);
}

Pictures draw_chart(const Chart& chart, const std::string& stem,
                    const std::filesystem::path& folder) {
    require(!chart.panels.empty(), "a chart has a panel");
    const Layout layout(chart);
    Sketch sketch(layout.canvas(), kChartFont_px);
    layout.draw_head(sketch);
    ChartData data;
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        std::visit([&](const auto& panel) { draw_panel(sketch, data, panel, layout.box(i)); },
                   chart.panels[i]);
        sketch.forget();
    }
    const gnuplot::TemporaryFolder work;
    return {publish(draw(sketch, data.text, stem, work.path()), folder), {}};
}

}  // namespace limpet::draw
