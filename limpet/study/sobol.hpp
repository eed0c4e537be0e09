// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "limpet/statistics/shares.hpp"

namespace limpet::study {

/// How much of a figure's variance an input brings about, with 95 % intervals.
struct SobolIndex {
    double first = 0.0;  ///< by itself: what would go if it were known
    statistics::Interval first_95;
    double total = 0.0;  ///< with all that it does together with others: what would stay without it
    statistics::Interval total_95;
};

/// A figure at the points of a pick-freeze design: two independent samples, and for each input the
/// first with that input's values from the second.
struct PickFreeze {
    std::vector<double> a, b;
    std::vector<std::vector<double>> mixed;  ///< one an input, as long as a and b
};

/// Martinez's estimators: S = corr(b, mixed), T = 1 - corr(a, mixed), which are sound for any mean
/// and scale; the intervals by the correlation's own influence function, so that they hold for
/// figures that are far from normal, an event's 0 and 1 too, in Fisher's z. Of S goes what of
/// corr(a, b), whose truth is 0, goes along with it: of an input that does little, mixed is nearly
/// a, and most of what chance there is. Of fewer than 128 samples the intervals are a little short.
/// @return one an input; NaN where the figure does not vary
/// Source: Martinez, "Analyse de sensibilite globale par decomposition de la variance", GdR Ondes
/// et MASCOT-NUM, 2011; Baudin et al., "Numerical stability of Sobol' indices estimation formula",
/// SAMO 2016; influence of a correlation: Hampel et al., "Robust statistics", 1986, ch. 4;
/// control variates: Owen, "Monte Carlo theory, methods and examples", 2013, 8.9.
[[nodiscard]] std::vector<SobolIndex> sobol_indices(const PickFreeze& figure);

}  // namespace limpet::study
