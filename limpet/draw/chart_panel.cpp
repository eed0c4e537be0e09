// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/draw/chart_parts.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::draw {
namespace {

using Mark = ChartSeries::Mark;

constexpr double kSample_px = 64.0;   ///< of the key: a stroke and the air around it and its name
constexpr double kMarkGap_px = 24.0;  ///< between numbers that stand for names
constexpr double kLevelLine_px = 18.0;
constexpr double kLevelNames_px = 150.0;  ///< most that names of levels take

void check(const ChartPanel& panel) {
    for (const ChartSeries& s : panel.series) {
        require(s.x.size() == s.y.size(), "a series has as many x as y");
        require(s.low.size() == s.high.size() && (s.low.empty() || s.low.size() == s.x.size()),
                "a series has an interval for each point, or none");
        require(s.low.empty() || s.mark == Mark::points || s.mark == Mark::bars,
                "intervals stand around points and bars");
    }
    for (const auto& range : {panel.x_range, panel.y_range}) {
        require(!range || range->low < range->high, "a range has a low end and a high end");
    }
    require((!panel.log_x || x_axis(panel).low > 0.0) && (!panel.log_y || y_axis(panel).low > 0.0),
            "a logarithmic axis is positive");
}

/// The key: next to what stands above the axes when it fits, else in rows below it.
struct Key {
    std::size_t columns = 0;
    std::size_t rows = 0;
};

Key key_of(const ChartPanel& panel, double width_px) {
    double widest = 0.0, entries = 0.0;
    for (const ChartSeries& s : panel.series) {
        widest = std::max(widest, text_width_px(s.name, kChartSmall_px));
        entries += s.name.empty() ? 0.0 : 1.0;
    }
    if (entries == 0.0) {
        return {};
    }
    const double entry = widest + kSample_px;
    const double inline_key = panel.y_label.empty() ? text_width_px(panel.title, kPanelTitle_px)
                                                    : text_width_px(panel.y_label, kChartSmall_px);
    if (inline_key > 0.0 && inline_key + entries * entry <= width_px) {
        return {static_cast<std::size_t>(entries), 0};
    }
    const double columns = std::clamp(std::floor(width_px / entry), 1.0, entries);
    return {static_cast<std::size_t>(columns),
            static_cast<std::size_t>(std::ceil(entries / columns))};
}

/// Those within an axis, ascending.
std::vector<ChartLine> within(std::vector<ChartLine> lines, const Range& axis, bool logarithmic) {
    const auto outside = [&](const ChartLine& line) {
        return !drawable(line.at, logarithmic) || line.at < axis.low || line.at > axis.high;
    };
    lines.erase(std::remove_if(lines.begin(), lines.end(), outside), lines.end());
    std::stable_sort(lines.begin(), lines.end(),
                     [](const ChartLine& a, const ChartLine& b) { return a.at < b.at; });
    return lines;
}

/// Names over the axes: moments, and stretches. Where they do not fit at their places, numbers and
/// letters stand there, and a list above explains them.
struct PanelNames {
    std::vector<ChartLine> moments = {};  ///< within the axes, from left to right
    std::vector<double> moment_px = {};   ///< from the plot's left
    bool numbered = false;                ///< moments do not fit next to each other
    std::vector<std::string> letters =
        {};  ///< of each stretch; empty: its name fits, or it has none
    std::vector<std::string> list = {};
    std::size_t list_columns = 1;
    double list_column_px = 0.0;

    [[nodiscard]] std::size_t list_rows() const {
        return (list.size() + list_columns - 1) / list_columns;
    }
    /// Of what stands over the plot for the moments.
    [[nodiscard]] double height_px() const {
        const bool named = std::any_of(moments.begin(), moments.end(),
                                       [](const ChartLine& line) { return !line.label.empty(); });
        return kLine_px * static_cast<double>(list_rows() + (named ? 1 : 0)) +
               (list.empty() ? 0.0 : 6.0);
    }
};

/// Where a stretch lies in the plot; {0, 0} when it is not in it.
Range stretch_px(const ChartPanel& panel, const ChartStretch& stretch, const Range& x,
                 double width_px) {
    const double low = std::max(stretch.x.low, x.low), high = std::min(stretch.x.high, x.high);
    return low < high ? Range{share_of(low, x, panel.log_x) * width_px,
                              share_of(high, x, panel.log_x) * width_px}
                      : Range{0.0, 0.0};
}

PanelNames names_of(const ChartPanel& panel, double width_px) {
    const Range x = x_axis(panel);
    PanelNames names{.moments = within(panel.moments, x, panel.log_x)};
    double taken = 0.0;
    for (const ChartLine& line : names.moments) {
        const double at =
            names.moment_px.emplace_back(share_of(line.at, x, panel.log_x) * width_px);
        if (!line.label.empty()) {
            const double end = at + 10.0 + text_width_px(line.label, kChartSmall_px);
            names.numbered = names.numbered || at < taken || end > width_px;
            taken = end;
        }
    }
    for (const ChartLine& line : names.moments) {
        if (names.numbered && !line.label.empty()) {
            names.list.push_back(fmt::format("{}  {}", names.list.size() + 1, line.label));
        }
    }
    char letter = 'a';
    for (const ChartStretch& stretch : panel.stretches) {
        const Range px = stretch_px(panel, stretch, x, width_px);
        const bool fits = text_width_px(stretch.name, kChartSmall_px) < px.high - px.low;
        std::string& own = names.letters.emplace_back();
        if (px.low < px.high && !stretch.name.empty() && !fits && letter <= 'z') {
            own = letter++;
            names.list.push_back(fmt::format("{}  {}", own, stretch.name));
        }
    }
    for (const std::string& line : names.list) {
        names.list_column_px =
            std::max(names.list_column_px, text_width_px(line, kChartSmall_px) + 12.0);
    }
    if (!names.list.empty()) {
        names.list_columns = static_cast<std::size_t>(
            std::max(1.0, std::floor((width_px + 12.0) / names.list_column_px)));
    }
    return names;
}

bool has_names(const ChartPanel& panel) {
    return std::any_of(panel.stretches.begin(), panel.stretches.end(),
                       [](const ChartStretch& s) { return !s.name.empty(); });
}

/// Names under the axis: each within its share of it, or slanted when one does not fit.
struct CategoryNames {
    std::string tics;  ///< gnuplot's list
    bool slanted = false;
    double height_px = 0.0;
};

CategoryNames category_names(const ChartPanel& panel, double width_px) {
    CategoryNames names;
    const double slot = width_px / static_cast<double>(panel.categories.size()) - 8.0;
    double longest = 0.0;
    std::size_t most = 1;
    for (const std::string& name : panel.categories) {
        const auto lines = wrapped(name, kChartSmall_px, slot);
        most = std::max(most, lines.size());
        longest = std::max(longest, text_width_px(name, kChartSmall_px));
        for (const std::string& line : lines) {
            names.slanted = names.slanted || text_width_px(line, kChartSmall_px) > slot;
        }
    }
    for (std::size_t i = 0; i < panel.categories.size(); ++i) {
        std::string text;
        for (const std::string& line :
             wrapped(panel.categories[i], kChartSmall_px, names.slanted ? 1e9 : slot)) {
            const std::string literal = gnuplot::literal(line);
            text += (text.empty() ? "" : "\\n") + literal.substr(1, literal.size() - 2);
        }
        names.tics += fmt::format("{}\"{}\" {}", i == 0 ? "" : ", ", text, i);
    }
    constexpr double kSin = 0.643;  // of 40 deg
    names.height_px =
        names.slanted ? kSin * longest + 14.0 : 0.86 * kLine_px * static_cast<double>(most) + 10.0;
    return names;
}

class PanelDrawing {
public:
    PanelDrawing(Sketch& sketch, ChartData& data, const ChartPanel& panel, const Box& box)
        : sketch_(sketch),
          data_(data),
          panel_(panel),
          box_(box),
          x_(x_axis(panel)),
          y_(y_axis(panel)),
          names_(names_of(panel, box.width_px())) {}

    void draw() {
        double y = box_.top_px - head_px(panel_, box_.width_px());
        y = draw_lines(sketch_, title_lines(panel_.title, box_.width_px()), box_.left_px, y,
                       kPanelTitle_px, colours::kInk);
        y = key(y);
        if (!panel_.y_label.empty()) {
            sketch_.label(box_.left_px, box_.top_px - 16.0, panel_.y_label, kChartSmall_px,
                          panel_.title.empty() ? colours::kInk : colours::kFaint);
        }
        name_values(panel_.levels, colours::kLevel, true);
        name_values(panel_.y_names, colours::kFaint, false);
        moments(y);
        stretches();
        axes();
        plot();
    }

private:
    [[nodiscard]] double y_px(double value) const {
        return box_.bottom_px - share_of(value, y_, panel_.log_y) * box_.height_px();
    }

    /// gnuplot's key. @return where its rows end
    double key(double top_px) {
        const Key key = key_of(panel_, box_.width_px());
        if (key.columns == 0) {
            sketch_.add("unset key\n");
            return top_px;
        }
        const double next_px = panel_.y_label.empty() ? top_px - kLine_px : box_.top_px - 27.0;
        const bool inline_key = key.rows == 0;
        sketch_.add(
            "set key at {} {} top horizontal maxcols {} Left reverse samplen 2 spacing KEY_ROW "
            "noenhanced font "
            "'DejaVu Sans,{}' textcolor rgb '{}'\n",
            sketch_.at(inline_key ? box_.right_px : box_.left_px - 8.0,
                       inline_key ? next_px : top_px),
            inline_key ? "right" : "left", key.columns, kChartSmall_px, colours::kInk);
        return top_px + kLine_px * static_cast<double>(key.rows);
    }

    /// Names of values at the right, at their heights, moved apart where they would touch: levels,
    /// with their lines, or what stands in place of the axis' numbers.
    void name_values(const std::vector<ChartLine>& lines, const char* colour, bool with_lines) {
        std::vector<ChartLine> shown = within(lines, y_, panel_.log_y);
        std::reverse(shown.begin(), shown.end());  // from the top
        std::vector<double> wanted;
        for (const ChartLine& value : shown) {
            const double y = wanted.emplace_back(y_px(value.at));
            if (with_lines) {
                sketch_.line(box_.left_px, y, box_.right_px, y, colour, 1.2, "back dt (8,5)");
            }
        }
        const auto placed = spread(wanted, kLevelLine_px, box_.top_px, box_.bottom_px);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            sketch_.label(box_.right_px + 10.0, placed[i], shown[i].label, kChartSmall_px, colour);
        }
    }

    /// Names at the right of their lines, or numbers over them, with the list that they refer to.
    void moments(double top_px) {
        for (std::size_t i = 0; i < names_.list.size(); ++i) {
            const auto column = static_cast<double>(i % names_.list_columns);
            const std::size_t row = i / names_.list_columns;
            sketch_.label(box_.left_px + column * names_.list_column_px,
                          top_px + (static_cast<double>(row) + 0.5) * kLine_px, names_.list[i],
                          kChartSmall_px, colours::kInk);
        }
        const double foot = top_px + names_.height_px();
        std::vector<double> named;
        for (std::size_t i = 0; i < names_.moments.size(); ++i) {
            const double x = box_.left_px + names_.moment_px[i];
            const bool name = !names_.moments[i].label.empty();
            // With stretches the lines keep to the plot: their names are in between.
            const double from = has_names(panel_) || !name ? box_.top_px : foot;
            sketch_.line(x, from, x, box_.bottom_px, colours::kMoment, 1.2);
            if (name && names_.numbered) {
                named.push_back(x);
            } else if (name) {
                sketch_.line(x, foot, x, foot - 0.8 * kLine_px, colours::kMoment, 1.2);
                sketch_.label(x + 5.0, foot - 0.4 * kLine_px, names_.moments[i].label,
                              kChartSmall_px, colours::kInk);
            }
        }
        const auto placed = spread(named, kMarkGap_px, box_.left_px, box_.right_px);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            sketch_.line(named[i], foot, placed[i], foot - 5.0, colours::kMoment, 1.2);
            sketch_.label(placed[i], foot - 0.6 * kLine_px, std::to_string(i + 1), kChartSmall_px,
                          colours::kInk, "center");
        }
    }

    /// Shaded in turns; named, by a letter where the name does not fit.
    void stretches() {
        const double label_px = panel_.y_label.empty() ? 8.0 : kLine_px + 8.0;
        const double top =
            has_names(panel_) ? box_.top_px - label_px - kLine_px : box_.top_px - label_px;
        for (std::size_t i = 0; i < panel_.stretches.size(); ++i) {
            const ChartStretch& stretch = panel_.stretches[i];
            const Range px = stretch_px(panel_, stretch, x_, box_.width_px());
            const double x0 = box_.left_px + px.low, x1 = box_.left_px + px.high;
            if (px.low < px.high && i % 2 == 1) {
                sketch_.box(x0, top, x1, box_.bottom_px, colours::kShade);
            }
            if (px.low < px.high && !stretch.name.empty()) {
                const std::string& letter = names_.letters[i];
                sketch_.label(0.5 * (x0 + x1), top + 0.5 * kLine_px,
                              letter.empty() ? stretch.name : letter, kChartSmall_px,
                              colours::kFaint, "center");
            }
        }
    }

    void axes() {
        sketch_.frame(box_);
        sketch_.add("set grid {}xtics ytics lt 1 lc rgb '{}' lw 0.8\n",
                    panel_.categories.empty() ? "" : "no", colours::kGrid);
        set_axis(sketch_, "x", x_, panel_.log_x, box_.width_px() / 90.0);
        // A low panel has a scale too, not one number.
        set_axis(sketch_, "y", y_, panel_.log_y, std::max(2.5, box_.height_px() / 42.0));
        if (!panel_.y_names.empty()) {
            std::string ticks;
            for (const ChartLine& value : panel_.y_names) {
                ticks += fmt::format("{}'' {:.10g}", ticks.empty() ? "" : ", ", value.at);
            }
            sketch_.add("set ytics ({})\n", ticks);
        }
        if (!panel_.categories.empty()) {
            const CategoryNames names = category_names(panel_, box_.width_px());
            sketch_.add("set xtics noenhanced {} ({})\n",
                        names.slanted ? "rotate by 40 right" : "norotate", names.tics);
        } else if (!panel_.x_numbers) {
            sketch_.add("set format x ''\n");
        }
        name_x_axis(sketch_, panel_.x_numbers ? panel_.x_label : "");
    }

    void plot() {
        const std::string clauses = plot_of(panel_, data_, x_, y_, box_.width_px());
        if (clauses.empty()) {
            sketch_.label(0.5 * (box_.left_px + box_.right_px),
                          0.5 * (box_.top_px + box_.bottom_px), "no data", kPanelTitle_px,
                          colours::kFaint, "center");
            // Axes of a plot without a point would not be drawn.
            sketch_.add("plot {:.10g} with lines lc rgb '#FFFFFF' lw 0.1 notitle\n",
                        0.5 * (y_.low + y_.high));
            return;
        }
        sketch_.add("plot {}\n", clauses);
    }

    Sketch& sketch_;
    ChartData& data_;
    const ChartPanel& panel_;
    const Box& box_;
    Range x_;
    Range y_;
    PanelNames names_;
};

}  // namespace

double right_px(const ChartPanel& panel) {
    check(panel);
    double names = 6.0;
    for (const auto* lines : {&panel.levels, &panel.y_names}) {
        for (const ChartLine& line : *lines) {
            names = std::max(names, text_width_px(line.label, kChartSmall_px));
        }
    }
    return std::min(names, kLevelNames_px) + 10.0;
}

double head_px(const ChartPanel& panel, double width_px) {
    const auto rows = static_cast<double>(title_lines(panel.title, width_px).size() +
                                          key_of(panel, width_px).rows);
    return kLine_px *
               (rows + (panel.y_label.empty() ? 0.0 : 1.0) + (has_names(panel) ? 1.0 : 0.0)) +
           names_of(panel, width_px).height_px() + 8.0;
}

double foot_px(const ChartPanel& panel, double width_px) {
    if (!panel.x_numbers) {
        return 0.0;
    }
    const double names =
        panel.categories.empty() ? 30.0 : category_names(panel, width_px).height_px;
    return names + (panel.x_label.empty() ? 4.0 : 28.0);
}

void draw_panel(Sketch& sketch, ChartData& data, const ChartPanel& panel, const Box& box) {
    PanelDrawing(sketch, data, panel, box).draw();
}

}  // namespace limpet::draw
