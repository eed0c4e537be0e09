// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace limpet::wire {

/// Counts of durations in bins a quarter of an octave wide, 1 us to 47 s; allocates nothing. Bin i
/// holds what is above edge_s(i - 1) and not above edge_s(i); the first one all up to 1 us, the
/// last one all the rest. Less than nothing counts as nothing, and what is no number not at all.
class DurationHistogram {
public:
    static constexpr std::size_t kBins = 4 * 26;

    void add(double duration_s);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double largest_s() const { return largest_s_; }
    [[nodiscard]] double mean_s() const;
    /// @param share  0..1: 0.99 for p99
    /// @return the upper edge of the bin that holds it, at most the largest seen; 0 without counts
    [[nodiscard]] double quantile_s(double share) const;
    [[nodiscard]] const std::array<std::uint64_t, kBins>& bins() const { return bins_; }
    /// Upper edge of a bin [s].
    [[nodiscard]] static double edge_s(std::size_t bin);

private:
    std::array<std::uint64_t, kBins> bins_ = {};
    std::uint64_t count_ = 0;
    double sum_s_ = 0.0;
    double largest_s_ = 0.0;
};

}  // namespace limpet::wire
