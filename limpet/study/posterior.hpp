// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace limpet::study {

/// A prior's draws, weighted by how well each explains what was seen.
struct Weighted {
    std::vector<double> weights;  ///< likelihoods, not normalised

    /// The mean likelihood: what the model as a whole gave to what was seen.
    [[nodiscard]] double evidence() const;
    /// Kish's effective number of draws.
    [[nodiscard]] double effective() const;
    /// @param values  one a draw
    [[nodiscard]] double mean(const std::vector<double>& values) const;
    [[nodiscard]] double quantile(const std::vector<double>& values, double share) const;
};

/// How many bits a measurement is expected to give on which of several kinds is true: the mutual
/// information of the two, from weighted draws.
/// @param kinds     of each draw, from 0
/// @param measured  what the measurement would show of it, its own noise included
/// @param weights   of the draws
/// @param bins      of equal probability, into which what it shows is sorted
[[nodiscard]] double information_bits(const std::vector<std::size_t>& kinds,
                                      const std::vector<double>& measured,
                                      const std::vector<double>& weights, std::size_t bins);

}  // namespace limpet::study
