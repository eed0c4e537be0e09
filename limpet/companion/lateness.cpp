// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/lateness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace limpet::companion {

// Values below 32 us are a step each. Above, a value's leading five bits are its step within its
// octave.

void Lateness::add(double late_s) {
    ++count_;
    worst_s_ = std::max(worst_s_, late_s);
    constexpr double kMost_us = kStepsAnOctave * static_cast<double>(1U << kOctaves) - 1.0;
    const auto us = static_cast<std::uint64_t>(std::clamp(1e6 * late_s, 0.0, kMost_us));
    const auto octave =
        static_cast<std::size_t>(std::max(0, static_cast<int>(std::bit_width(us)) - 5));
    ++steps_[octave * kStepsAnOctave + (us >> octave)];
}

double Lateness::quantile_s(double share) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t so_far = 0;
    for (std::size_t k = 0; k < steps_.size() && count_ > 0; ++k) {
        so_far += steps_[k];
        if (so_far >= std::max<std::uint64_t>(wanted, 1)) {
            const std::size_t octave = k < kStepsAnOctave ? 0 : k / kStepsAnOctave - 1;
            const std::size_t step = k - octave * kStepsAnOctave;
            return std::min(1e-6 * static_cast<double>((step + 1) << octave), worst_s_);
        }
    }
    return 0.0;
}

std::string text_of(const Lateness& lateness) {
    return fmt::format(
        "late by {:.2f} ms (median), {:.2f} ms (99 %), {:.2f} ms (99.9 %), {:.1f} ms (worst)",
        1e3 * lateness.quantile_s(0.5), 1e3 * lateness.quantile_s(0.99),
        1e3 * lateness.quantile_s(0.999), 1e3 * lateness.worst_s());
}

}  // namespace limpet::companion
