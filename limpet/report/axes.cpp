// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpet {
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
    const double room = span > least         ? air * span
                        : extent.high == 0.0 ? 0.5
                                             : 0.1 * std::abs(extent.high);
    return {extent.low - room, extent.high + room};
}

bool has_bars(const ChartPanel& panel) {
    return std::any_of(panel.series.begin(), panel.series.end(),
                       [](const ChartSeries& s) { return s.mark == Mark::bars; });
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
        if (series.mark != Mark::none) {
            extent.show(series.y);
        }
        extent.show(series.low);
        extent.show(series.high);
    }
    for (const ChartLine& level : panel.levels) {
        extent.show(level.at);
    }
    if (!has_bars(panel) || panel.log_y || extent.empty()) {
        return with_air(extent, 0.06);
    }
    extent.show(0.0);
    Range range = with_air(extent, 0.06);
    // Bars stand on the axis.
    range.low = extent.low == 0.0 && extent.high > 0.0 ? 0.0 : range.low;
    range.high = extent.high == 0.0 && extent.low < 0.0 ? 0.0 : range.high;
    return range;
}

std::vector<double> ticks(const Range& range, double count) {
    const double span = range.high - range.low;
    const double rough = span / std::max(1.0, count);
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    const double step = power * (share < 1.5 ? 1.0 : share < 3.0 ? 2.0 : share < 7.0 ? 5.0 : 10.0);
    std::vector<double> found;
    const double first = std::ceil(range.low / step - 1e-9);
    const double last = std::floor(range.high / step + 1e-9);
    for (auto i = static_cast<long>(first); i <= static_cast<long>(last); ++i) {
        found.push_back(static_cast<double>(i) * step);
    }
    return found;
}

std::vector<double> log_ticks(const Range& range, double count) {
    const double decades = std::log10(range.high / range.low);
    const int every = std::max(1, static_cast<int>(std::round(decades / std::max(1.0, count))));
    const std::vector<double> within =
        decades > 0.5 * count ? std::vector<double>{1.0} : std::vector<double>{1.0, 2.0, 5.0};
    std::vector<double> found;
    const int last = static_cast<int>(std::floor(std::log10(range.high)));
    for (int e = static_cast<int>(std::floor(std::log10(range.low))); e <= last; ++e) {
        for (const double digit : within) {
            const double tick = digit * std::pow(10.0, e);
            if (e % every == 0 && tick >= range.low * (1.0 - 1e-9) &&
                tick <= range.high * (1.0 + 1e-9)) {
                found.push_back(tick);
            }
        }
    }
    return found;
}

std::string tick_label(double value) {
    std::string plain = fmt::format("{:.6g}", value);
    const std::size_t e = plain.find('e');
    if (e == plain.npos) {
        return plain;
    }
    constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const int power = std::stoi(plain.substr(e + 1));
    std::string text = plain.substr(0, e);
    text = text == "1" ? "10" : text == "-1" ? "-10" : text + "·10";
    text += power < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(power))) {
        text += kRaised[digit - '0'];
    }
    return text;
}

void set_ticks(Sketch& sketch, char axis, const std::vector<double>& values) {
    std::string list;
    for (const double value : values) {
        list += fmt::format("{}'{}' {:.10g}", list.empty() ? "" : ", ", tick_label(value), value);
    }
    // An empty list would mean gnuplot's own ticks.
    sketch.add("set {}tics ({})\n", axis, list.empty() ? "'' -1e30" : list);
}

bool drawable(double value, bool logarithmic) {
    return std::isfinite(value) && (!logarithmic || value > 0.0);
}

}  // namespace limpet
