// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figure_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/report/axes.hpp"
#include "limpet/report/colours.hpp"

namespace limpet {
namespace {

using colours::kFaint;
using colours::kInk;

constexpr int kWidth_px = 1400;
constexpr double kLeft_px = 84.0;
constexpr double kRight_px = kWidth_px - 108.0;
constexpr double kTitle_px = 38.0;
constexpr double kSubtitle_px = 66.0;
constexpr double kNoEventsTop_px = 92.0;
constexpr double kEventsTop_px = 292.0;  ///< room for slanted names and their leaders
constexpr double kRibbon_px = 24.0;
constexpr double kHeader_px = 30.0;
constexpr double kPlot_px = 186.0;
constexpr double kAxis_px = 58.0;
constexpr double kBelow_px = 12.0;  ///< between a panel and the next one's title
constexpr double kFont_px = 15.0;
constexpr double kSmall_px = 14.0;

struct Pen {
    const char* colour;
    double width;
};

Pen pen_of(Trace trace) {
    switch (trace) {
        case Trace::measured: return {colours::kBlue, 1.8};
        case Trace::measured_2: return {colours::kOrange, 1.2};
        case Trace::truth: return {colours::kDarkBlue, 1.6};
        case Trace::estimated: return {colours::kPeach, 2.8};
    }
    throw InternalError("trace out of range");
}

/// The figure's canvas and where its parts are on it.
struct Layout {
    Canvas canvas;
    double ribbon_top_px = 0.0;
    double panels_top_px = 0.0;

    [[nodiscard]] double plot_top_px(std::size_t panel) const {
        return panels_top_px + kHeader_px + static_cast<double>(panel) * (kHeader_px + kPlot_px);
    }
    [[nodiscard]] double plot_bottom_px(std::size_t panel) const {
        return plot_top_px(panel) + kPlot_px - kBelow_px;
    }
};

Layout layout_of(const Figure& figure) {
    Layout layout;
    layout.ribbon_top_px = figure.events.empty() ? kNoEventsTop_px : kEventsTop_px;
    layout.panels_top_px = layout.ribbon_top_px + (figure.phases.empty() ? 0.0 : kRibbon_px);
    layout.canvas.width_px = kWidth_px;
    layout.canvas.height_px =
        static_cast<int>(layout.plot_top_px(figure.panels.size()) - kHeader_px + kAxis_px);
    return layout;
}

class FigureDrawing {
public:
    FigureDrawing(const Figure& figure, const Layout& layout)
        : figure_(figure), layout_(layout), sketch_(layout.canvas, kFont_px) {}

    [[nodiscard]] Sketch draw() {
        title();
        ribbon();
        events();
        for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
            panel(i);
        }
        return std::move(sketch_);
    }

private:
    [[nodiscard]] double x_of(double time_s) const {
        const Window& w = figure_.window;
        const double share = std::clamp((time_s - w.from_s) / w.span_s(), 0.0, 1.0);
        return kLeft_px + share * (kRight_px - kLeft_px);
    }

    [[nodiscard]] double bottom_px() const {
        return layout_.plot_bottom_px(figure_.panels.size() - 1);
    }

    void title() {
        sketch_.label(kLeft_px, kTitle_px, figure_.title, 26.0, kInk);
        sketch_.label(kLeft_px, kSubtitle_px, figure_.subtitle, kFont_px, kFaint);
        if (!figure_.warning.empty()) {
            sketch_.label(kRight_px, kSubtitle_px, figure_.warning, kFont_px, colours::kWarning,
                          "right");
        }
    }

    /// Guidance's states: shaded in turns through all panels, named where the name fits.
    void ribbon() {
        bool shaded = false;
        for (const Phase& phase : figure_.phases) {
            const double x0 = x_of(phase.window.from_s), x1 = x_of(phase.window.to_s);
            if (shaded) {
                sketch_.box(x0, layout_.ribbon_top_px, x1, bottom_px(), colours::kShade);
            }
            shaded = !shaded;
            const std::string name = words(phase.state);
            if (text_width_px(name, kSmall_px) < x1 - x0) {
                sketch_.label(0.5 * (x0 + x1), layout_.ribbon_top_px + 0.5 * kRibbon_px, name,
                              kSmall_px, kFaint, "center");
            }
        }
    }

    /// Names stand slanted above, apart from each other, with leaders to their instants.
    void events() {
        constexpr double kGap_px = 21.0, kLeader_px = 24.0, kFoot_px = 5.0;
        std::vector<double> wanted;
        for (const RecordedEvent& event : figure_.events) {
            wanted.push_back(x_of(event.time_s));
        }
        const std::vector<double> placed = spread(wanted, kGap_px, kLeft_px, kRight_px);
        const double top = layout_.ribbon_top_px;
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const RecordedEvent& event = figure_.events[i];
            for (std::size_t panel = 0; panel < figure_.panels.size(); ++panel) {
                sketch_.line(wanted[i], layout_.plot_top_px(panel), wanted[i],
                             layout_.plot_bottom_px(panel), colours::kMoment, 1.0);
            }
            sketch_.line(wanted[i], top - kFoot_px, placed[i], top - kLeader_px, colours::kMoment,
                         1.0);
            sketch_.label(placed[i] + 3.0, top - kLeader_px - 5.0,
                          fmt::format("{}  {:.2f}", words(event.name), event.time_s), kFont_px,
                          kInk, "left rotate by 60");
        }
    }

    void panel(std::size_t index) {
        const Panel& panel = figure_.panels[index];
        const double top = layout_.plot_top_px(index), bottom = layout_.plot_bottom_px(index);
        const bool last = index + 1 == figure_.panels.size();
        const Range range = axis_range(panel);
        sketch_.label(kLeft_px, top - 12.0, fmt::format("{}  [{}]", panel.title, panel.unit), 17.0,
                      kInk);
        key(panel, top - 12.0);
        for (const Level& level : panel.levels) {
            const double share = (level.value - range.low) / (range.high - range.low);
            const double y = bottom - share * (bottom - top);
            sketch_.line(kLeft_px, y, kRight_px, y, colours::kLevel, 1.0, "back dt (8,5)");
            sketch_.label(kRight_px + 8.0, y, level.label, kSmall_px, colours::kLevel,
                          "left enhanced");
        }
        sketch_.frame(kLeft_px, top, kRight_px, bottom);
        sketch_.add("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n",
                    figure_.window.from_s, figure_.window.to_s, range.low, range.high);
        set_ticks(sketch_, 'y', ticks(range, 5.0));
        sketch_.add("set format x {}\n", last ? "'%g'" : "''");
        if (last) {
            sketch_.label(0.5 * (kLeft_px + kRight_px), bottom + 44.0, "time  [s]", kFont_px, kInk,
                          "center");
        }
        plot(panel);
        sketch_.forget();
    }

    /// From right to left: a stroke and a name for each curve.
    void key(const Panel& panel, double y_px) {
        double x = kRight_px;
        for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
            const Pen pen = pen_of(curve->trace);
            sketch_.label(x, y_px, curve->label, kSmall_px, kInk, "right");
            x -= text_width_px(curve->label, kSmall_px) + 6.0;
            sketch_.line(x - 26.0, y_px, x, y_px, pen.colour, 1.4 * pen.width, "front");
            x -= 50.0;
        }
    }

    void plot(const Panel& panel) {
        const char* joint = "plot ";
        for (const Curve& curve : panel.curves) {
            const Pen pen = pen_of(curve.trace);
            sketch_.add("{}DATA index {} with lines lc rgb '{}' lw {}", joint, block_++, pen.colour,
                        pen.width);
            joint = ", \\\n  ";
        }
        sketch_.add("\n");
    }

    const Figure& figure_;
    const Layout& layout_;
    Sketch sketch_;
    int block_ = 0;
};

}  // namespace

std::string figure_data(const Figure& figure) {
    std::string text;
    for (const Panel& panel : figure.panels) {
        for (const Curve& curve : panel.curves) {
            bool gap = true;  // also keeps empty lines from the start of a block
            for (std::size_t i = 0; i < curve.values.size(); ++i) {
                if (std::isfinite(curve.values[i])) {
                    text += fmt::format("{:.10g} {:.10g}\n", curve.time_s[i], curve.values[i]);
                    gap = false;
                } else if (!gap) {
                    text += "\n";
                    gap = true;
                }
            }
            text += gap ? "\n" : "\n\n";
        }
    }
    return text;
}

Sketch figure_sketch(const Figure& figure) {
    const Layout layout = layout_of(figure);
    return FigureDrawing(figure, layout).draw();
}

}  // namespace limpet
