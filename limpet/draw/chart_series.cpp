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

/// Series of a mark before one of them.
std::size_t count_of(const ChartPanel& panel, Mark mark, std::size_t before) {
    return static_cast<std::size_t>(std::count_if(
        panel.series.begin(), panel.series.begin() + static_cast<std::ptrdiff_t>(before),
        [mark](const ChartSeries& s) { return s.mark == mark; }));
}

bool has_number(const ChartPanel& panel) {
    return std::any_of(panel.series.begin(), panel.series.end(), [&panel](const ChartSeries& s) {
        for (std::size_t i = 0; i < s.y.size(); ++i) {
            if (drawable(s.x[i], panel.log_x) && drawable(s.y[i], panel.log_y)) {
                return true;
            }
        }
        return false;
    });
}

/// What gnuplot plots of a panel: a clause a series, of bars with intervals two.
class SeriesPlot {
public:
    SeriesPlot(const ChartPanel& panel, ChartData& data, const Range& x, const Range& y,
               double width_px)
        : panel_(panel), data_(data), x_(x), y_(y), width_px_(width_px) {}

    [[nodiscard]] std::string clauses() {
        for (std::size_t i = 0; i < panel_.series.size(); ++i) {
            series(i);
        }
        return std::move(clauses_);
    }

private:
    /// @param title  in the key; empty: none
    void clause(int block, const std::string& columns, const std::string& style,
                const std::string& title) {
        clauses_ += fmt::format("{}DATA index {} using {} with {} {}",
                                clauses_.empty() ? "" : ", \\\n  ", block, columns, style,
                                title.empty() ? "notitle" : "title " + gnuplot::literal(title));
    }

    void series(std::size_t index) {
        const ChartSeries& all = panel_.series[index];
        const bool line = (all.mark == Mark::line || all.mark == Mark::dashes) &&
                          std::is_sorted(all.x.begin(), all.x.end());
        // More points cannot be distinguished on the page.
        const ChartSeries s = line ? thinned(all, x_, static_cast<std::size_t>(width_px_)) : all;
        const bool errors = !s.low.empty();
        const int block =
            errors ? data_.add({&s.x, &s.y, &s.low, &s.high}) : data_.add({&s.x, &s.y});
        const std::string colour = colour_of(panel_, index);
        // An interval that reaches below a logarithmic axis ends on it.
        const std::string low =
            panel_.log_y ? fmt::format("($3>{0:.10g}?$3:{0:.10g})", y_.low) : "3";
        const std::string pen = fmt::format("lc rgb '{}' lw {}", colour, s.width);
        switch (s.mark) {
            case Mark::line: clause(block, "1:2", "lines " + pen, s.name); return;
            case Mark::dashes: clause(block, "1:2", "lines dt (9,5) " + pen, s.name); return;
            case Mark::steps: clause(block, "1:2", "steps " + pen, s.name); return;
            case Mark::points:
                clause(
                    block, errors ? "1:2:" + low + ":4" : "1:2",
                    fmt::format("{} pt {} ps 0.9*MARK lw 1.6 lc rgb '{}'",
                                errors ? "yerrorbars" : "points",
                                kShapes[count_of(panel_, Mark::points, index) % std::size(kShapes)],
                                colour),
                    s.name);
                return;
            case Mark::bars: break;
        }
        const std::string x = fmt::format("($1+{:.10g})", bar_shift(index));
        clause(block, fmt::format("{}:2:({:.10g})", x, 0.94 * bar_width()),
               fmt::format("boxes fs solid noborder fc rgb '{}'", colour), s.name);
        if (errors) {
            clause(
                block, fmt::format("{}:{}:(0):($4-{})", x, low, low == "3" ? "$3" : low),
                fmt::format("vectors heads size screen 0.005,90 lw 1.6 lc rgb '{}'", colours::kInk),
                "");
        }
    }

    [[nodiscard]] double bar_count() const {
        return static_cast<double>(count_of(panel_, Mark::bars, panel_.series.size()));
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
        const double most = kMostBar_px / width_px_ * (x_.high - x_.low);
        return std::min(0.76 * pitch / bar_count(), most);
    }

    [[nodiscard]] double bar_shift(std::size_t index) const {
        return bar_width() * (static_cast<double>(count_of(panel_, Mark::bars, index)) -
                              0.5 * (bar_count() - 1.0));
    }

    const ChartPanel& panel_;
    ChartData& data_;
    const Range& x_;
    const Range& y_;
    double width_px_;
    std::string clauses_;
};

}  // namespace

std::string plot_of(const ChartPanel& panel, ChartData& data, const Range& x, const Range& y,
                    double width_px) {
    return has_number(panel) ? SeriesPlot(panel, data, x, y, width_px).clauses() : "";
}

}  // namespace limpet::draw
