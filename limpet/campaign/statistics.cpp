// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"

namespace limpet::campaign {
namespace {

constexpr int kMostIterations = 50;
constexpr double kConverged = 1e-10;
constexpr double kSteepest = 50.0;  ///< per standard deviation of x: a step, not a slope

double logistic(double eta) {
    return 1.0 / (1.0 + std::exp(-eta));
}

/// Sums of Newton's step for the two coefficients: gradient and information matrix.
struct Newton {
    double g0 = 0.0, g1 = 0.0;
    double h00 = 0.0, h01 = 0.0, h11 = 0.0;
    [[nodiscard]] double determinant() const { return h00 * h11 - h01 * h01; }
};

/// x is centred and scaled, so that the matrix is well conditioned.
struct Scale {
    double mean = 0.0;
    double deviation = 0.0;
    [[nodiscard]] double operator()(double x) const { return (x - mean) / deviation; }
};

Scale scale_of(const std::vector<Trials>& trials) {
    double runs = 0.0;
    Scale scale;
    for (const Trials& t : trials) {
        runs += t.proportion.runs;
        scale.mean += t.x * t.proportion.runs;
    }
    scale.mean /= runs;
    for (const Trials& t : trials) {
        scale.deviation += (t.x - scale.mean) * (t.x - scale.mean) * t.proportion.runs;
    }
    scale.deviation = std::sqrt(scale.deviation / runs);
    return scale;
}

Newton sums(const std::vector<Trials>& trials, const Scale& scale, double b0, double b1) {
    Newton n;
    for (const Trials& t : trials) {
        const double x = scale(t.x);
        const double p = logistic(b0 + b1 * x);
        const double residual = t.proportion.successes - t.proportion.runs * p;
        const double weight = t.proportion.runs * p * (1.0 - p);
        n.g0 += residual;
        n.g1 += residual * x;
        n.h00 += weight;
        n.h01 += weight * x;
        n.h11 += weight * x * x;
    }
    return n;
}

bool can_be_fitted(const std::vector<Trials>& trials) {
    std::uint64_t runs = 0;
    std::uint64_t successes = 0;
    std::vector<double> values;
    for (const Trials& t : trials) {
        runs += t.proportion.runs;
        successes += t.proportion.successes;
        if (t.proportion.runs > 0) {
            values.push_back(t.x);
        }
    }
    std::sort(values.begin(), values.end());
    const auto different = std::unique(values.begin(), values.end()) - values.begin();
    return different >= 3 && successes > 0 && successes < runs;
}

}  // namespace

double Proportion::probability() const {
    return runs == 0 ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(successes) / static_cast<double>(runs);
}

Interval Proportion::interval() const {
    if (runs == 0) {
        return {0.0, 1.0};
    }
    const double n = runs;
    const double p = probability();
    const double zz = kNormal95 * kNormal95;
    const double centre = (p + zz / (2.0 * n)) / (1.0 + zz / n);
    const double half =
        kNormal95 / (1.0 + zz / n) * std::sqrt(p * (1.0 - p) / n + zz / (4.0 * n * n));
    // At the ends the formula is 0 and 1 but for rounding.
    return {successes == 0 ? 0.0 : centre - half, successes == runs ? 1.0 : centre + half};
}

double LogisticFit::probability(double x) const {
    return logistic(intercept + slope * x);
}

std::optional<LogisticFit> fit_logistic(const std::vector<Trials>& trials) {
    if (!can_be_fitted(trials)) {
        return std::nullopt;
    }
    const Scale scale = scale_of(trials);
    double b0 = 0.0;
    double b1 = 0.0;
    double step = 1.0;
    Newton n;
    for (int i = 0; i < kMostIterations && step > kConverged; ++i) {
        n = sums(trials, scale, b0, b1);
        const double det = n.determinant();
        if (!(det > 0.0)) {
            return std::nullopt;
        }
        const double d0 = (n.h11 * n.g0 - n.h01 * n.g1) / det;
        const double d1 = (n.h00 * n.g1 - n.h01 * n.g0) / det;
        step = std::max(std::abs(d0), std::abs(d1));
        const double damping = step > 4.0 ? 4.0 / step : 1.0;
        b0 += damping * d0;
        b1 += damping * d1;
        if (std::abs(b1) > kSteepest) {
            return std::nullopt;
        }
    }
    if (!(step <= kConverged) || b1 == 0.0) {
        return std::nullopt;
    }
    const double det = n.determinant();
    const double var0 = n.h11 / det;
    const double var1 = n.h00 / det;
    const double covariance = -n.h01 / det;
    const double half = -b0 / b1;  // of the scaled x
    LogisticFit fit;
    fit.slope = b1 / scale.deviation;
    fit.intercept = b0 - b1 * scale.mean / scale.deviation;
    fit.slope_error = std::sqrt(var1) / scale.deviation;
    fit.half = scale.mean + scale.deviation * half;
    fit.half_error = scale.deviation *
                     std::sqrt(var0 + 2.0 * half * covariance + half * half * var1) / std::abs(b1);
    return fit;
}

double quantile(const std::vector<double>& sorted, double share) {
    require(!sorted.empty(), "a quantile is of something");
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    const double rest = at - static_cast<double>(below);
    return sorted[below] + rest * (sorted[above] - sorted[below]);
}

}  // namespace limpet::campaign
