// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/report/gnuplot.hpp"
#include "limpet/report/layout.hpp"

namespace limpet {
namespace {

// Restrained, told apart by lightness as well as by hue (Okabe and Ito's set, toned down).
constexpr const char* kInk = "#222B33";
constexpr const char* kFaint = "#6B7680";
constexpr const char* kGrid = "#DDE2E7";
constexpr const char* kShade = "#F4F6F8";
constexpr const char* kEventLine = "#B4BDC6";
constexpr const char* kWarning = "#B3261E";
constexpr const char* kLevel = "#C0504D";

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
        case Trace::measured: return {"#6FA8D6", 1.8};
        case Trace::measured_2: return {"#D98E04", 1.2};
        case Trace::truth: return {"#0B3C5D", 1.6};
        case Trace::estimated: return {"#F0A35E", 2.8};
    }
    throw InternalError("trace out of range");
}

/// About five ticks over a span, 1, 2 or 5 times a power of ten apart.
double tick_step(double span) {
    const double rough = span / 5.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    return power * (share < 1.5 ? 1.0 : share < 3.0 ? 2.0 : share < 7.0 ? 5.0 : 10.0);
}

/// The figure's page and where its parts are on it.
struct Layout {
    Canvas page;
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
    layout.page.width_px = kWidth_px;
    layout.page.height_px =
        static_cast<int>(layout.plot_top_px(figure.panels.size()) - kHeader_px + kAxis_px);
    return layout;
}

/// Writes gnuplot's commands; positions are in pixels of the page.
class Script {
public:
    Script(const Figure& figure, const Layout& layout) : figure_(figure), layout_(layout) {}

    [[nodiscard]] std::string body() {
        add("set multiplot\nset encoding utf8\nunset key\nset tics scale 0.4\n");
        add("set border 3 lc rgb '{}' lw 0.8\n", kFaint);
        add("set tics nomirror textcolor rgb '{}'\nset grid lt 1 lc rgb '{}' lw 0.8\n", kInk,
            kGrid);
        title();
        ribbon();
        events();
        for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
            panel(i);
        }
        add("unset multiplot\nunset output\n");
        return std::move(text_);
    }

private:
    template <class... Values>
    void add(const char* format, const Values&... values) {
        text_ += fmt::vformat(format, fmt::make_format_args(values...));
    }

    [[nodiscard]] std::string at(double x_px, double y_px) const {
        return fmt::format("screen {:.5f}, screen {:.5f}", layout_.page.x(x_px),
                           layout_.page.y(y_px));
    }

    void label(double x_px, double y_px, const std::string& text, double size_px,
               const std::string& colour, const char* options = "left noenhanced") {
        add("set label {} at {} {} font 'DejaVu Sans,{}' textcolor rgb '{}' front\n",
            gnuplot::literal(text), at(x_px, y_px), options, size_px, colour);
    }

    void line(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour,
              double width, const char* options = "back") {
        add("set arrow from {} to {} nohead {} lc rgb '{}' lw {}\n", at(x0_px, y0_px),
            at(x1_px, y1_px), options, colour, width);
    }

    void box(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour) {
        add("set object rectangle from {} to {} behind fs solid noborder fc rgb '{}'\n",
            at(x0_px, y0_px), at(x1_px, y1_px), colour);
    }

    [[nodiscard]] double x_of(double time_s) const {
        const Window& w = figure_.window;
        const double share = std::clamp((time_s - w.from_s) / w.span_s(), 0.0, 1.0);
        return kLeft_px + share * (kRight_px - kLeft_px);
    }

    [[nodiscard]] double bottom_px() const {
        return layout_.plot_bottom_px(figure_.panels.size() - 1);
    }

    void title() {
        label(kLeft_px, kTitle_px, figure_.title, 26.0, kInk);
        label(kLeft_px, kSubtitle_px, figure_.subtitle, kFont_px, kFaint);
        if (!figure_.warning.empty()) {
            label(kRight_px, kSubtitle_px, figure_.warning, kFont_px, kWarning, "right noenhanced");
        }
    }

    /// Guidance's states: shaded in turns through all panels, named where the name fits.
    void ribbon() {
        bool shaded = false;
        for (const Phase& phase : figure_.phases) {
            const double x0 = x_of(phase.window.from_s), x1 = x_of(phase.window.to_s);
            if (shaded) {
                box(x0, layout_.ribbon_top_px, x1, bottom_px(), kShade);
            }
            shaded = !shaded;
            const std::string name = words(phase.state);
            if (text_width_px(name, kSmall_px) < x1 - x0) {
                label(0.5 * (x0 + x1), layout_.ribbon_top_px + 0.5 * kRibbon_px, name, kSmall_px,
                      kFaint, "center noenhanced");
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
                line(wanted[i], layout_.plot_top_px(panel), wanted[i],
                     layout_.plot_bottom_px(panel), kEventLine, 1.0);
            }
            line(wanted[i], top - kFoot_px, placed[i], top - kLeader_px, kEventLine, 1.0);
            label(placed[i] + 3.0, top - kLeader_px - 5.0,
                  fmt::format("{}  {:.2f}", words(event.name), event.time_s), kFont_px, kInk,
                  "left noenhanced rotate by 60");
        }
    }

    void panel(std::size_t index) {
        const Panel& panel = figure_.panels[index];
        const double top = layout_.plot_top_px(index), bottom = layout_.plot_bottom_px(index);
        const bool last = index + 1 == figure_.panels.size();
        const Range range = axis_range(panel);
        label(kLeft_px, top - 12.0, fmt::format("{}  [{}]", panel.title, panel.unit), 17.0, kInk);
        key(panel, top - 12.0);
        for (const Level& level : panel.levels) {
            const double share = (level.value - range.low) / (range.high - range.low);
            const double y = bottom - share * (bottom - top);
            line(kLeft_px, y, kRight_px, y, kLevel, 1.0, "back dt (8,5)");
            label(kRight_px + 8.0, y, level.label, kSmall_px, kLevel, "left enhanced");
        }
        add("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n",
            layout_.page.x(kLeft_px), layout_.page.x(kRight_px));
        add("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n", layout_.page.y(top),
            layout_.page.y(bottom));
        add("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n", figure_.window.from_s,
            figure_.window.to_s, range.low, range.high);
        add("set ytics {:.9g}\n", tick_step(range.high - range.low));
        add("set format x {}\n", last ? "'%g'" : "''");
        if (last) {
            label(0.5 * (kLeft_px + kRight_px), bottom + 44.0, "time  [s]", kFont_px, kInk,
                  "center noenhanced");
        }
        plot(panel);
        add("unset label\nunset arrow\nunset object\n");
    }

    /// From right to left: a stroke and a name for each curve.
    void key(const Panel& panel, double y_px) {
        double x = kRight_px;
        for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
            const Pen pen = pen_of(curve->trace);
            label(x, y_px, curve->label, kSmall_px, kInk, "right noenhanced");
            x -= text_width_px(curve->label, kSmall_px) + 6.0;
            line(x - 26.0, y_px, x, y_px, pen.colour, 1.4 * pen.width, "front");
            x -= 50.0;
        }
    }

    void plot(const Panel& panel) {
        const char* joint = "plot ";
        for (const Curve& curve : panel.curves) {
            const Pen pen = pen_of(curve.trace);
            add("{}DATA index {} with lines lc rgb '{}' lw {}", joint, block_++, pen.colour,
                pen.width);
            joint = ", \\\n  ";
        }
        add("\n");
    }

    const Figure& figure_;
    const Layout& layout_;
    std::string text_;
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

std::string figure_script(const Figure& figure, const std::string& stem) {
    const Layout layout = layout_of(figure);
    const std::string body = Script(figure, layout).body();
    const std::string size = fmt::format("size {},{} font 'DejaVu Sans,{}' background '#FFFFFF'",
                                         layout.page.width_px, layout.page.height_px, kFont_px);
    const std::string data = fmt::format("DATA = '{}.txt'\n", stem);
    return data +
           // Fonts are measured in points of 1/72 in at 96 dpi there, in pixels here.
           fmt::format("set terminal pngcairo {} fontscale 0.75\nset output '{}.png'\n", size,
                       stem) +
           body + fmt::format("reset\nset terminal svg {}\nset output '{}.svg'\n", size, stem) +
           body;
}

}  // namespace limpet
