// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "limpet/draw/chart_parts.hpp"

namespace limpet::draw {
namespace {

using Mark = ChartSeries::Mark;

/// Grows with the numbers that it is shown.
struct Extent {
    bool logarithmic = false;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void show(double value) {
        if (drawable(value, logarithmic)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    void show(const std::vector<double>& values) {
        for (const double value : values) {
            show(value);
        }
    }
    [[nodiscard]] bool empty() const { return low > high; }
};

/// @param air  on both sides, as a share of the extent
Range with_air(const Extent& extent, double air) {
    if (extent.empty()) {
        return extent.logarithmic ? Range{1.0, 10.0} : Range{0.0, 1.0};
    }
    if (extent.logarithmic) {
        const double factor =
            extent.high > extent.low ? std::pow(extent.high / extent.low, air) : 2.0;
        return {extent.low / factor, extent.high * factor};
    }
    const double span = extent.high - extent.low;
    // Numbers that differ in their last bits only are one number.
    const double least = 1e-9 * std::max(std::abs(extent.low), std::abs(extent.high));
    const double margin = span > least         ? air * span
                          : extent.high == 0.0 ? 0.5
                                               : 0.1 * std::abs(extent.high);
    return {extent.low - margin, extent.high + margin};
}

}  // namespace

Range x_axis(const ChartPanel& panel) {
    if (panel.x_range) {
        return *panel.x_range;
    }
    if (!panel.categories.empty()) {
        return {-0.5, static_cast<double>(panel.categories.size()) - 0.5};
    }
    Extent extent{panel.log_x};
    bool wide = false;  // a mark that has a width of its own
    for (const ChartSeries& series : panel.series) {
        extent.show(series.x);
        wide = wide || series.mark == Mark::points || series.mark == Mark::bars;
    }
    for (const ChartLine& moment : panel.moments) {
        extent.show(moment.at);
    }
    return with_air(extent, extent.high > extent.low && !wide ? 0.0 : 0.04);
}

Range y_axis(const ChartPanel& panel) {
    if (panel.y_range) {
        return *panel.y_range;
    }
    Extent extent{panel.log_y};
    for (const ChartSeries& series : panel.series) {
        extent.show(series.y);
        extent.show(series.low);
        extent.show(series.high);
    }
    for (const ChartLine& level : panel.levels) {
        extent.show(level.at);
    }
    const bool from_zero =
        !panel.log_y && !extent.empty() &&
        (panel.from_zero || std::any_of(panel.series.begin(), panel.series.end(),
                                        [](const ChartSeries& s) { return s.mark == Mark::bars; }));
    if (from_zero) {
        extent.show(0.0);
    }
    const double lacking =
        extent.empty() ? 0.0 : std::max(0.0, panel.least_span - (extent.high - extent.low));
    const bool up = from_zero && extent.low == 0.0, down = from_zero && extent.high == 0.0;
    extent.high += up ? lacking : down ? 0.0 : 0.5 * lacking;
    extent.low -= up ? 0.0 : down ? lacking : 0.5 * lacking;
    Range range = with_air(extent, 0.06);
    // What begins at zero stands on the axis.
    range.low = up && extent.high > 0.0 ? 0.0 : range.low;
    range.high = down && !up ? 0.0 : range.high;
    return range;
}

double tick_step(const Range& range, double count) {
    const double rough = (range.high - range.low) / std::max(1.0, count);
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    return power * (share < 1.5 ? 1.0 : share < 3.0 ? 2.0 : share < 7.0 ? 5.0 : 10.0);
}

void set_axis(Sketch& sketch, const char* axis, const Range& range, bool logarithmic,
              double count) {
    sketch.add("unset logscale {0}\nset {0}range [{1:.10g}:{2:.10g}]\n", axis, range.low,
               range.high);
    sketch.add("set {0}tics norotate enhanced\nset format {0} '%h'\n", axis);
    if (!logarithmic) {
        sketch.add("set {}tics {:.10g}\n", axis, tick_step(range, count));
        return;
    }
    sketch.add("set logscale {0}\nset {0}tics autofreq\n", axis);
    if (range.high < 100.0 * range.low) {
        sketch.add("set for [e=-20:20] {0}tics add (2.0*10**e 0, 5.0*10**e 0)\n", axis);
    }
}

double share_of(double value, const Range& range, bool logarithmic) {
    return logarithmic ? std::log(value / range.low) / std::log(range.high / range.low)
                       : (value - range.low) / (range.high - range.low);
}

ChartSeries thinned(const ChartSeries& series, const Range& x, std::size_t bins) {
    if (series.y.size() <= 4 * bins) {
        return series;
    }
    ChartSeries thin = series;
    thin.x.clear();
    thin.y.clear();
    const double per_unit = static_cast<double>(bins) / (x.high - x.low);
    const auto bin_of = [&](std::size_t i) { return std::floor((series.x[i] - x.low) * per_unit); };
    for (std::size_t first = 0; first < series.y.size();) {
        std::size_t end = first;
        std::array<std::size_t, 4> kept = {first, first, first, first};
        bool gap = false;
        for (; end < series.y.size() && bin_of(end) == bin_of(first); ++end) {
            gap = gap || std::isnan(series.y[end]);
            kept[1] = series.y[end] < series.y[kept[1]] ? end : kept[1];
            kept[2] = series.y[end] > series.y[kept[2]] ? end : kept[2];
            kept[3] = end;
        }
        std::sort(kept.begin(), kept.end());
        // A stretch with a gap in it stays whole: gaps are rare, and comparisons with NaN are
        // false.
        for (std::size_t i = first; i < end; ++i) {
            if (gap || std::find(kept.begin(), kept.end(), i) != kept.end()) {
                thin.add(series.x[i], series.y[i]);
            }
        }
        first = end;
    }
    return thin;
}

bool drawable(double value, bool logarithmic) {
    return std::isfinite(value) && (!logarithmic || value > 0.0);
}

}  // namespace limpet::draw
