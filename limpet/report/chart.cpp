// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/chart.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/report/chart_parts.hpp"
#include "limpet/report/colours.hpp"
#include "limpet/report/gnuplot.hpp"

namespace limpet {
namespace {

constexpr double kMargin_px = 14.0;
constexpr double kTitleFont_px = 22.0;
constexpr double kTitleLine_px = 29.0;
constexpr double kBetween_px = 22.0;  ///< rows

using AnyPanel = std::variant<ChartPanel, HeatPanel>;

double plot_height_px(const AnyPanel& panel) {
    return std::visit([](const auto& p) { return p.height_px; }, panel);
}

/// Where the panels are: a grid whose columns share their margins, so that axes line up.
class Layout {
public:
    explicit Layout(const Chart& chart)
        : chart_(chart), columns_(static_cast<std::size_t>(std::max(1, chart.columns))) {
        const double column_px = columns_ == 1 ? 640.0 : 600.0;
        width_px_ = column_px * static_cast<double>(columns_);
        column_sides();
        titles();
        rows(column_px);
    }

    [[nodiscard]] Canvas canvas() const {
        return {static_cast<int>(width_px_), static_cast<int>(std::ceil(bottom_px_))};
    }
    [[nodiscard]] const PlotBox& box(std::size_t panel) const { return boxes_[panel]; }

    void draw_head(Sketch& sketch) const {
        double y = kMargin_px + 0.5 * kTitleLine_px;
        for (const std::string& line : title_) {
            sketch.label(kMargin_px, y, line, kTitleFont_px, colours::kInk);
            y += kTitleLine_px;
        }
        for (const std::string& line : subtitle_) {
            sketch.label(kMargin_px, y, line, kChartSmall_px, colours::kFaint);
            y += kLine_px;
        }
    }

private:
    void column_sides() {
        sides_.resize(columns_);
        for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
            const Sides own =
                std::visit([](const auto& panel) { return sides(panel); }, chart_.panels[i]);
            Sides& column = sides_[i % columns_];
            column.left_px = std::max(column.left_px, own.left_px);
            column.right_px = std::max(column.right_px, own.right_px);
        }
    }

    void titles() {
        const double room_px = width_px_ - 2.0 * kMargin_px;
        bottom_px_ = kMargin_px;
        if (!chart_.title.empty()) {
            title_ = wrapped(chart_.title, kTitleFont_px, room_px);
            bottom_px_ += kTitleLine_px * static_cast<double>(title_.size());
        }
        if (!chart_.subtitle.empty()) {
            subtitle_ = wrapped(chart_.subtitle, kChartSmall_px, room_px);
            bottom_px_ += kLine_px * static_cast<double>(subtitle_.size());
        }
    }

    void rows(double column_px) {
        boxes_.resize(chart_.panels.size());
        for (std::size_t first = 0; first < boxes_.size(); first += columns_) {
            const std::size_t end = std::min(first + columns_, boxes_.size());
            double head = 0.0, foot = 0.0, plot = 0.0;
            for (std::size_t i = first; i < end; ++i) {
                const Sides& side = sides_[i - first];
                const double left = column_px * static_cast<double>(i - first);
                boxes_[i].left_px = left + kMargin_px + side.left_px;
                boxes_[i].right_px = left + column_px - kMargin_px - side.right_px;
                const double width = boxes_[i].width_px();
                const AnyPanel& panel = chart_.panels[i];
                head = std::max(
                    head, std::visit([&](const auto& p) { return head_px(p, width); }, panel));
                foot = std::max(
                    foot, std::visit([&](const auto& p) { return foot_px(p, width); }, panel));
                plot = std::max(plot, plot_height_px(panel));
            }
            const double top = bottom_px_ + (first == 0 ? 8.0 : kBetween_px) + head;
            for (std::size_t i = first; i < end; ++i) {
                boxes_[i].top_px = top;
                boxes_[i].bottom_px = top + plot;
            }
            bottom_px_ = top + plot + foot;
        }
        bottom_px_ += kMargin_px;
    }

    const Chart& chart_;
    std::size_t columns_;
    double width_px_ = 0.0;
    double bottom_px_ = 0.0;
    std::vector<Sides> sides_;
    std::vector<std::string> title_;
    std::vector<std::string> subtitle_;
    std::vector<PlotBox> boxes_;
};

}  // namespace

int ChartData::close() {
    text += "\n\n";
    return blocks++;
}

double title_px(const std::string& title, double width_px) {
    return title.empty()
               ? 0.0
               : kLine_px * static_cast<double>(wrapped(title, kPanelTitle_px, width_px).size()) +
                     4.0;
}

double draw_title(Sketch& sketch, const std::string& title, double left_px, double top_px,
                  double width_px) {
    if (title.empty()) {
        return top_px;
    }
    double y = top_px + 0.5 * kLine_px;
    for (const std::string& line : wrapped(title, kPanelTitle_px, width_px)) {
        sketch.label(left_px, y, line, kPanelTitle_px, colours::kInk);
        y += kLine_px;
    }
    return y - 0.5 * kLine_px + 4.0;
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

}  // namespace limpet
