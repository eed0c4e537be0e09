// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/histogram.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::wire {
namespace {

constexpr double kSmallest_s = 1e-6;  ///< lower edge of bin 1
constexpr double kBinsAnOctave = 4.0;

}  // namespace

double DurationHistogram::edge_s(std::size_t bin) {
    return kSmallest_s * std::exp2(static_cast<double>(bin) / kBinsAnOctave);
}

void DurationHistogram::add(double duration_s) {
    if (std::isnan(duration_s)) {
        return;
    }
    const double d_s = std::max(0.0, duration_s);
    std::size_t bin = 0;
    if (d_s > kSmallest_s) {
        const double place = std::ceil(kBinsAnOctave * std::log2(d_s / kSmallest_s));
        bin = static_cast<std::size_t>(std::min(place, static_cast<double>(kBins - 1)));
    }
    ++bins_[bin];
    ++count_;
    sum_s_ += d_s;
    largest_s_ = std::max(largest_s_, d_s);
}

double DurationHistogram::mean_s() const {
    return count_ > 0 ? sum_s_ / static_cast<double>(count_) : 0.0;
}

double DurationHistogram::quantile_s(double share) const {
    if (count_ == 0) {
        return 0.0;
    }
    const double wanted = std::clamp(share, 0.0, 1.0) * static_cast<double>(count_);
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
        below += bins_[bin];
        if (below > 0 && static_cast<double>(below) >= wanted) {
            return std::min(edge_s(bin), largest_s_);
        }
    }
    return largest_s_;  // the last bin has no upper edge
}

}  // namespace limpet::wire
