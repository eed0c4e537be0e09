// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace limpet::wire {

/// Counts of durations from 1 us on, in bins of equal ratio; allocates nothing. Bin i holds what is
/// above edge_s(i - 1) and not above edge_s(i); the first bin holds all up to 1 us, the last bin
/// all the rest. A negative duration counts as 0, NaN is not counted.
template <int kBinsAnOctave, int kOctaves>
class Histogram {
public:
    static constexpr std::size_t kBins = kBinsAnOctave * kOctaves;

    void add(double duration_s) {
        if (std::isnan(duration_s)) {
            return;
        }
        const double d_s = std::max(0.0, duration_s);
        const double bin = std::ceil(kBinsAnOctave * std::log2(std::max(1.0, d_s / kSmallest_s)));
        ++bins_[static_cast<std::size_t>(std::min(bin, static_cast<double>(kBins - 1)))];
        ++count_;
        sum_s_ += d_s;
        largest_s_ = std::max(largest_s_, d_s);
    }

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double largest_s() const { return largest_s_; }
    [[nodiscard]] double mean_s() const {
        return count_ > 0 ? sum_s_ / static_cast<double>(count_) : 0.0;
    }
    /// @param share  0..1: 0.99 for p99
    /// @return the upper edge of the bin that holds it, at most the largest counted; 0 without
    /// counts
    [[nodiscard]] double quantile_s(double share) const {
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
    [[nodiscard]] const std::array<std::uint64_t, kBins>& bins() const { return bins_; }
    /// Upper edge of a bin [s].
    [[nodiscard]] static double edge_s(std::size_t bin) {
        return kSmallest_s * std::exp2(static_cast<double>(bin) / kBinsAnOctave);
    }

private:
    static constexpr double kSmallest_s = 1e-6;  ///< upper edge of the first bin

    std::array<std::uint64_t, kBins> bins_ = {};
    std::uint64_t count_ = 0;
    double sum_s_ = 0.0;
    double largest_s_ = 0.0;
};

/// Bins a quarter of an octave wide, up to 47 s.
using DurationHistogram = Histogram<4, 26>;

}  // namespace limpet::wire
