// SPDX-License-Identifier: Apache-2.0
#include "limpet/statistics/shares.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::statistics {
namespace {

constexpr int kMostIterations = 50;
constexpr double kConverged = 1e-10;
constexpr double kSteepest = 50.0;  ///< per standard deviation of x: a step, not a slope

/// Sums of Newton's step for the two coefficients.
struct Newton {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
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

Newton sums(const std::vector<Trials>& trials, const Scale& scale, const Eigen::Vector2d& b) {
    Newton n;
    for (const Trials& t : trials) {
        const Eigen::Vector2d z = {1.0, scale(t.x)};
        const double p = logistic(b[0] + b[1] * z[1]);
        const double weight = t.proportion.runs * p * (1.0 - p);
        n.gradient += (t.proportion.successes - t.proportion.runs * p) * z;
        n.information += (weight * z) * z.transpose();
    }
    return n;
}

bool can_be_fitted(const std::vector<Trials>& trials) {
    std::uint64_t runs = 0;
    std::uint64_t successes = 0;
    std::set<double> values;
    for (const Trials& t : trials) {
        runs += t.proportion.runs;
        successes += t.proportion.successes;
        if (t.proportion.runs > 0) {
            values.insert(t.x);
        }
    }
    return values.size() >= 3 && successes > 0 && successes < runs;
}

}  // namespace

double logistic(double eta) {
    return 1.0 / (1.0 + std::exp(-eta));
}

double Proportion::probability() const {
    return runs == 0 ? kNaN : static_cast<double>(successes) / static_cast<double>(runs);
}

Interval wilson(double share, double runs) {
    if (!(runs > 0.0)) {
        return {0.0, 1.0};
    }
    const double zz = kNormal95 * kNormal95;
    const double centre = (share + zz / (2.0 * runs)) / (1.0 + zz / runs);
    const double half = kNormal95 / (1.0 + zz / runs) *
                        std::sqrt(share * (1.0 - share) / runs + zz / (4.0 * runs * runs));
    // At the ends the formula is 0 and 1 but for rounding.
    return {share <= 0.0 ? 0.0 : centre - half, share >= 1.0 ? 1.0 : centre + half};
}

Interval Proportion::interval() const {
    return wilson(runs == 0 ? 0.0 : probability(), runs);
}

double LogisticFit::probability(double x) const {
    return logistic(intercept + slope * x);
}

void TrialsAlong::add(const Trials& trials) {
    const double cell = std::floor((trials.x - low_) / width_);
    if (width_ == 0.0 || trials_.empty() || cell != last_cell_) {
        trials_.push_back(trials);
        last_cell_ = cell;
        return;
    }
    Trials& last = trials_.back();
    Proportion& sum = last.proportion;
    sum.runs += trials.proportion.runs;
    sum.successes += trials.proportion.successes;
    last.x += (trials.x - last.x) * trials.proportion.runs / sum.runs;
}

std::optional<LogisticFit> fit_logistic(const std::vector<Trials>& trials) {
    if (!can_be_fitted(trials)) {
        return std::nullopt;
    }
    const Scale scale = scale_of(trials);
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance;
    double step = 1.0;
    for (int i = 0; i < kMostIterations && step > kConverged; ++i) {
        const Newton n = sums(trials, scale, b);
        const double det = n.information.determinant();
        if (!(det > 0.0)) {
            return std::nullopt;
        }
        Eigen::Matrix2d adjugate;
        adjugate << n.information(1, 1), -n.information(0, 1), -n.information(0, 1),
            n.information(0, 0);
        const Eigen::Vector2d d = adjugate * n.gradient / det;
        covariance = adjugate / det;
        step = d.cwiseAbs().maxCoeff();
        b += (step > 4.0 ? 4.0 / step : 1.0) * d;
        if (std::abs(b[1]) > kSteepest) {
            return std::nullopt;
        }
    }
    if (!(step <= kConverged) || b[1] == 0.0) {
        return std::nullopt;
    }
    const double half = -b[0] / b[1];  // of the scaled x
    LogisticFit fit;
    fit.slope = b[1] / scale.deviation;
    fit.intercept = b[0] - b[1] * scale.mean / scale.deviation;
    fit.slope_error = std::sqrt(covariance(1, 1)) / scale.deviation;
    fit.half = scale.mean + scale.deviation * half;
    fit.half_error = scale.deviation *
                     std::sqrt(covariance(0, 0) + 2.0 * half * covariance(0, 1) +
                               half * half * covariance(1, 1)) /
                     std::abs(b[1]);
    return fit;
}

double quantile(const std::vector<double>& sorted, double share) {
    std::size_t at = 0;
    return quantiles(sorted.size(), {share}, [&] { return sorted[at++]; }).front();
}

std::vector<double> quantiles(std::size_t count, const std::vector<double>& shares,
                              const std::function<double()>& next) {
    require(count > 0, "a quantile is of something");
    std::vector<double> found;
    std::size_t taken = 0;  // of the numbers, the last two of which are
    double before = 0.0, last = 0.0;
    const auto take = [&](std::size_t place) {
        while (taken <= place) {
            before = taken == 0 ? 0.0 : last;
            last = next();
            ++taken;
        }
        return taken == place + 1 ? last : before;
    };
    for (const double share : shares) {
        const double at = share * static_cast<double>(count - 1);
        const auto below = static_cast<std::size_t>(at);
        const double low = take(below);
        const double high = take(std::min(below + 1, count - 1));
        found.push_back(low + (at - static_cast<double>(below)) * (high - low));
    }
    return found;
}

}  // namespace limpet::statistics
