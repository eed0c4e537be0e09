// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace limpet::identification {
namespace {

using std::ptrdiff_t;
using std::size_t;

constexpr double kSmooth_s = 0.15;  ///< longer than a stroke of the pump
constexpr double kLeastChange_Pa = 2000.0;

/// Median of five, then the mean over kSmooth_s: neither spikes nor strokes look like a stage.
std::vector<double> smoothed(const PressureTrace& trace) {
    const size_t n = trace.t_s.size();
    std::vector<double> medians(trace.pressure_Pa);
    for (size_t i = 2; i + 2 < n; ++i) {
        std::array<double, 5> five{};
        std::copy_n(trace.pressure_Pa.begin() + static_cast<ptrdiff_t>(i) - 2, 5, five.begin());
        std::nth_element(five.begin(), five.begin() + 2, five.end());
        medians[i] = five[2];
    }
    std::vector<double> means(n);
    size_t first = 0;
    size_t end = 0;
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i) {
        while (end < n && trace.t_s[end] <= trace.t_s[i] + 0.5 * kSmooth_s) {
            sum += medians[end++];
        }
        while (trace.t_s[first] < trace.t_s[i] - 0.5 * kSmooth_s) {
            sum -= medians[first++];
        }
        means[i] = sum / static_cast<double>(end - first);
    }
    return means;
}

/// Standard deviation of white noise, off the differences of neighbours.
double noise_Pa(const std::vector<double>& pressure_Pa) {
    std::vector<double> steps(pressure_Pa.size() - 1);
    std::transform(pressure_Pa.begin() + 1, pressure_Pa.end(), pressure_Pa.begin(), steps.begin(),
                   [](double next, double last) { return std::abs(next - last); });
    const auto middle = steps.begin() + static_cast<ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle / (0.6745 * std::sqrt(2.0));
}

/// Where a second fall begins after a first vacuum was left; the end when there is none.
size_t second_fall(const std::vector<double>& smooth_Pa, double low_Pa, double high_Pa) {
    const double span_Pa = high_Pa - low_Pa;
    size_t i = 0;
    while (i < smooth_Pa.size() && smooth_Pa[i] > low_Pa + 0.3 * span_Pa) {
        ++i;
    }
    size_t top = i;
    for (; i < smooth_Pa.size(); ++i) {
        if (smooth_Pa[i] >= smooth_Pa[top] || smooth_Pa[top] < low_Pa + 0.3 * span_Pa) {
            top = i;
        } else if (smooth_Pa[i] < smooth_Pa[top] - 0.25 * span_Pa) {
            // The fall began where it was last near its top.
            while (smooth_Pa[i] < smooth_Pa[top] - 0.03 * span_Pa) {
                --i;
            }
            return i;
        }
    }
    return smooth_Pa.size();
}

/// Last sample before `end` for which `holds`; 0 when there is none.
template <class Test>
size_t last_of(size_t begin, size_t end, const Test& holds) {
    for (size_t i = end; i > begin; --i) {
        if (holds(i - 1)) {
            return i - 1;
        }
    }
    return 0;
}

void keep(std::vector<size_t>& candidates, size_t sample) {
    if (std::find(candidates.begin(), candidates.end(), sample) == candidates.end()) {
        candidates.push_back(sample);
    }
}

}  // namespace

PressureTrace samples_of(const PressureTrace& trace, size_t first, size_t count) {
    const auto begin = static_cast<ptrdiff_t>(first);
    const auto end = static_cast<ptrdiff_t>(first + count);
    return {.t_s = {trace.t_s.begin() + begin, trace.t_s.begin() + end},
            .pressure_Pa = {trace.pressure_Pa.begin() + begin, trace.pressure_Pa.begin() + end},
            .origin_s = trace.origin_s};
}

std::optional<Stages> find_stages(const PressureTrace& trace) {
    std::vector<double> smooth_Pa = smoothed(trace);
    const auto extent = [&] { return std::minmax_element(smooth_Pa.begin(), smooth_Pa.end()); };
    auto [low, high] = extent();
    Stages stages;
    stages.used = second_fall(smooth_Pa, *low, *high);
    smooth_Pa.resize(stages.used);
    std::tie(low, high) = extent();
    stages.low_Pa = *low;
    stages.high_Pa = *high;
    const double span_Pa = stages.high_Pa - stages.low_Pa;
    const double noise = noise_Pa(trace.pressure_Pa);
    if (span_Pa < std::max(kLeastChange_Pa, 8.0 * noise)) {
        return std::nullopt;
    }
    const double before_Pa = *std::max_element(smooth_Pa.begin(), low + 1);
    const double after_Pa = *std::max_element(low, smooth_Pa.end());
    stages.sealing = before_Pa > stages.low_Pa + 0.3 * span_Pa;
    stages.unsealing = after_Pa > stages.low_Pa + std::max(0.08 * span_Pa, 5.0 * noise);
    stages.may_unseal = !stages.unsealing &&
                        smooth_Pa.back() > stages.low_Pa + std::max(0.02 * span_Pa, 5.0 * noise);

    size_t fallen = 0;
    if (stages.sealing) {
        while (smooth_Pa[fallen] > stages.low_Pa + 0.5 * (before_Pa - stages.low_Pa)) {
            ++fallen;
        }
        for (const double share : {0.03, 0.15}) {
            keep(stages.on, last_of(0, fallen, [&](size_t i) {
                     return smooth_Pa[i] > before_Pa - share * (before_Pa - stages.low_Pa);
                 }));
        }
    }
    // Or the log begins after that.
    keep(stages.sealing ? stages.on : stages.off, 0);
    if (stages.unsealing || stages.may_unseal) {
        for (const double share : {0.02, 0.05, 0.12, 0.25}) {
            keep(stages.off, last_of(fallen, stages.used, [&](size_t i) {
                     return smooth_Pa[i] < stages.low_Pa + share * span_Pa;
                 }));
        }
    }
    return stages;
}

}  // namespace limpet::identification
