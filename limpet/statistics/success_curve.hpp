// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "limpet/statistics/shares.hpp"

namespace limpet::statistics {

/// How far runs lie from a curve, by Pearson's chi-squared over cells of neighbouring values, each
/// of which expects two successes and two failures at least.
struct Goodness {
    double chi2 = 0.0;
    int degrees = 0;  ///< of freedom: cells less fitted numbers
    double p = 1.0;   ///< that runs which follow the curve lie as far from it by chance

    /// The runs do not follow the curve.
    [[nodiscard]] bool rejected() const { return p < 0.05; }
};

/// That a chi-squared with so many degrees of freedom is larger.
/// @param chi2     >= 0, infinite too
/// @param degrees  > 0
[[nodiscard]] double chi_squared_beyond(double chi2, int degrees);

/// @param trials  along ascending x
/// @param fitted  numbers of the curve that were fitted to them
/// @return nullopt with too few cells to leave a degree of freedom
[[nodiscard]] std::optional<Goodness> goodness_of(
    const std::vector<Trials>& trials, const std::function<double(double x)>& probability,
    int fitted);

/// A logistic that ends at a plateau, which need not be 1:
/// P(success) = plateau / (1 + exp(-(intercept + slope z))), z = ln x where all x > 0, else x.
/// A force that grows with a speed against thresholds that are lognormal runs along ln x; what may
/// fail in spite of enough force makes the plateau.
struct SuccessCurve {
    bool along_logarithm = false;
    double intercept = 0.0;
    double slope = 0.0;
    double plateau = 1.0;
    Interval plateau_95;  ///< by profile likelihood
    /// Where half of all runs succeed, and its 95 % by the delta method; neither where that is not
    /// reached among the trials.
    std::optional<double> half;
    Interval half_95;
    Goodness goodness;

    [[nodiscard]] double probability(double x) const;
};

/// Maximum likelihood.
/// @param trials  along ascending x
/// @return nullopt where fit_logistic() has none, or with too few cells to judge the fit
[[nodiscard]] std::optional<SuccessCurve> fit_success_curve(const std::vector<Trials>& trials);

}  // namespace limpet::statistics
