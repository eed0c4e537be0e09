// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace limpet::companion {

/// How late ticks began: a histogram of a fixed size, counted in without allocating. A step is 1 us
/// below 32 us and at most 1/16 of the value above; what is later than 18 minutes counts as that.
class Lateness {
public:
    /// @param late_s  below 0 counts as 0
    void add(double late_s);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double worst_s() const { return worst_s_; }
    /// @param share  0..1: 0.5 is the median
    /// @return so many of all were at most so late, to the upper edge of a step [s]; 0 for none
    [[nodiscard]] double quantile_s(double share) const;

private:
    static constexpr std::size_t kStepsAnOctave = 16;
    static constexpr std::size_t kOctaves = 26;  ///< from 16 us on
    std::array<std::uint64_t, kStepsAnOctave*(1 + kOctaves)> steps_ = {};
    std::uint64_t count_ = 0;
    double worst_s_ = 0.0;
};

/// "late by 0.06 ms (median), 0.20 ms (99 %), 1.10 ms (99.9 %), 2.4 ms (worst)".
[[nodiscard]] std::string text_of(const Lateness& lateness);

}  // namespace limpet::companion
