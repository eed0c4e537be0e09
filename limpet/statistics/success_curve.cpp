// SPDX-License-Identifier: Apache-2.0
#include "limpet/statistics/success_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace limpet::statistics {
namespace {

constexpr double kLeastExpected = 2.0;   ///< successes and failures of a cell
constexpr double kHalfChi2_95 = 1.9207;  ///< of one degree of freedom: a profile falls by it
constexpr double kOfOne = 1e-6;          ///< nearer to 1 a plateau is none

/// Cells of a comparison, from what each trial expects.
struct ExpectedCell {
    double runs = 0.0, successes = 0.0, expected = 0.0;
    [[nodiscard]] bool expects(double least) const {
        return expected >= least && runs - expected >= least;
    }
    ExpectedCell& operator+=(const ExpectedCell& other) {
        runs += other.runs;
        successes += other.successes;
        expected += other.expected;
        return *this;
    }
};

std::vector<ExpectedCell> cells_of(const std::vector<Trials>& trials,
                                   const std::function<double(double)>& probability) {
    std::vector<ExpectedCell> cells;
    ExpectedCell open;
    for (const Trials& t : trials) {
        const double runs = t.proportion.runs;
        open += {runs, static_cast<double>(t.proportion.successes), runs * probability(t.x)};
        if (open.expects(kLeastExpected)) {
            cells.push_back(std::exchange(open, {}));
        }
    }
    if (open.runs > 0.0 && !cells.empty()) {
        cells.back() += open;
    }
    return cells;
}

/// A maximum over slope and intercept with the plateau held.
struct Profile {
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    double log_likelihood = -std::numeric_limits<double>::infinity();
};

double log_likelihood(const std::vector<Trials>& trials, double plateau, const Eigen::Vector2d& b) {
    double sum = 0.0;
    for (const Trials& t : trials) {
        const double p = plateau * logistic(b[0] + b[1] * t.x);
        const double k = t.proportion.successes, n = t.proportion.runs;
        sum += (k > 0.0 ? k * std::log(p) : 0.0) + (n > k ? (n - k) * std::log1p(-p) : 0.0);
    }
    return sum;
}

/// Fisher's scoring, each step halved until it gains.
Profile profile_at(const std::vector<Trials>& trials, double plateau, Eigen::Vector2d b) {
    constexpr int kSteps = 60, kHalvings = 30;
    double now = log_likelihood(trials, plateau, b);
    for (int i = 0; i < kSteps; ++i) {
        Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
        Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
        for (const Trials& t : trials) {
            const double share = logistic(b[0] + b[1] * t.x), p = plateau * share;
            const Eigen::Vector2d z = {1.0, t.x};
            // dp/deta = p (1 - share), over the variance p (1 - p)
            const double ratio = (1.0 - share) / std::max(1.0 - p, 1e-300);
            gradient += (t.proportion.successes - t.proportion.runs * p) * ratio * z;
            information += t.proportion.runs * p * (1.0 - share) * ratio * z * z.transpose();
        }
        if (!(information.determinant() > 0.0)) {
            break;
        }
        Eigen::Vector2d d = information.inverse() * gradient;
        double next = log_likelihood(trials, plateau, b + d);
        for (int k = 0; k < kHalvings && !(next >= now); ++k) {
            d *= 0.5;
            next = log_likelihood(trials, plateau, b + d);
        }
        if (!(next >= now)) {
            break;
        }
        b += d;
        now = next;
        if (d.cwiseAbs().maxCoeff() < 1e-9) {
            break;
        }
    }
    return {b, now};
}

/// The plateau by golden section, and where its profile has fallen by what 95 % allow.
class PlateauSearch {
public:
    /// @param trials  with z in the place of x, centred and scaled
    PlateauSearch(const std::vector<Trials>& trials, const Eigen::Vector2d& start)
        : trials_(trials), start_(start) {
        double runs = 0.0, successes = 0.0;
        for (const Trials& t : trials) {
            runs += t.proportion.runs;
            successes += t.proportion.successes;
        }
        least_ = successes / runs;
        best_ = 1.0;
        const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
        double low = least_, high = 1.0;
        double inner = high - golden * (high - low), outer = low + golden * (high - low);
        double at_inner = gain(inner), at_outer = gain(outer);
        while (high - low > 1e-7) {
            if (at_inner < at_outer) {
                low = std::exchange(inner, outer);
                at_inner = at_outer;
                outer = low + golden * (high - low);
                at_outer = gain(outer);
            } else {
                high = std::exchange(outer, inner);
                at_outer = at_inner;
                inner = high - golden * (high - low);
                at_inner = gain(inner);
            }
        }
        best_ = 0.5 * (low + high);
        if (best_ > 1.0 - kOfOne || gain(1.0) >= gain(best_)) {
            best_ = 1.0;
        }
    }
    [[nodiscard]] double best() const { return best_; }
    [[nodiscard]] Profile profile() const { return profile_at(trials_, best_, start_); }
    [[nodiscard]] Interval interval() const {
        const double needed = gain(best_) - kHalfChi2_95;
        return {edge(least_, needed), best_ < 1.0 ? edge(1.0, needed) : 1.0};
    }

private:
    [[nodiscard]] double gain(double plateau) const {
        return profile_at(trials_, plateau, start_).log_likelihood;
    }
    /// Where the profile crosses, between the best plateau and a far one.
    [[nodiscard]] double edge(double far, double needed) const {
        if (gain(far) >= needed) {
            return far;
        }
        double near = best_;
        for (int i = 0; i < 30; ++i) {
            const double middle = 0.5 * (near + far);
            (gain(middle) >= needed ? near : far) = middle;
        }
        return near;
    }

    const std::vector<Trials>& trials_;
    Eigen::Vector2d start_;
    double least_ = 0.0;
    double best_ = 1.0;
};

/// Of the middle z, at which half of all runs succeed: its standard error by the delta method.
double half_error(const std::vector<Trials>& trials, const SuccessCurve& scaled, double z) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (const Trials& t : trials) {
        const double share = logistic(scaled.intercept + scaled.slope * t.x);
        const double p = scaled.plateau * share;
        const Eigen::Vector3d d = {p * (1.0 - share), p * (1.0 - share) * t.x, share};
        information += t.proportion.runs / (p * (1.0 - p)) * d * d.transpose();
    }
    const Eigen::Vector3d gradient =
        Eigen::Vector3d(1.0, z, 2.0 / (2.0 * scaled.plateau - 1.0)) / scaled.slope;
    if (scaled.plateau == 1.0) {  // not fitted
        const Eigen::Vector2d two = gradient.head<2>();
        return std::sqrt(two.dot(information.topLeftCorner<2, 2>().inverse() * two));
    }
    return std::sqrt(gradient.dot(information.inverse() * gradient));
}

}  // namespace

double chi_squared_beyond(double chi2, int degrees) {
    return std::isinf(chi2) ? 0.0 : boost::math::gamma_q(0.5 * degrees, 0.5 * chi2);
}

std::optional<Goodness> goodness_of(const std::vector<Trials>& trials,
                                    const std::function<double(double x)>& probability,
                                    int fitted) {
    const std::vector<ExpectedCell> cells = cells_of(trials, probability);
    Goodness good{.degrees = static_cast<int>(cells.size()) - fitted};
    if (good.degrees < 1) {
        return std::nullopt;
    }
    for (const ExpectedCell& cell : cells) {
        const double off = cell.successes - cell.expected;
        good.chi2 += off * off / cell.expected + off * off / (cell.runs - cell.expected);
    }
    good.p = chi_squared_beyond(good.chi2, good.degrees);
    return good;
}

double SuccessCurve::probability(double x) const {
    return plateau * logistic(intercept + slope * (along_logarithm ? std::log(x) : x));
}

std::optional<SuccessCurve> fit_success_curve(const std::vector<Trials>& trials) {
    SuccessCurve curve;
    curve.along_logarithm =
        !trials.empty() &&
        std::all_of(trials.begin(), trials.end(), [](const Trials& t) { return t.x > 0.0; });
    std::vector<Trials> along = trials;
    for (Trials& t : along) {
        t.x = curve.along_logarithm ? std::log(t.x) : t.x;
    }
    const std::optional<LogisticFit> plain = fit_logistic(along);
    if (!plain) {
        return std::nullopt;
    }
    // About the plain fit's middle, in its own widths: intercept 0, slope 1 there.
    const double centre = plain->half, width = 1.0 / plain->slope;
    for (Trials& t : along) {
        t.x = (t.x - centre) / width;
    }
    const PlateauSearch search(along, {0.0, 1.0});
    const Eigen::Vector2d b = search.profile().b;
    curve.plateau = search.best();
    curve.plateau_95 = search.interval();
    curve.intercept = b[0];
    curve.slope = b[1];
    if (curve.plateau > 0.5) {
        const double z = (-std::log(2.0 * curve.plateau - 1.0) - b[0]) / b[1];
        const double error = kNormal95 * half_error(along, curve, z);
        const auto x_of = [&](double scaled) {
            const double at = centre + width * scaled;
            return curve.along_logarithm ? std::exp(at) : at;
        };
        const double x = x_of(z);
        if (x >= trials.front().x && x <= trials.back().x && std::isfinite(error)) {
            curve.half = x;
            const auto [low, high] = std::minmax({x_of(z - error), x_of(z + error)});
            curve.half_95 = {low, high};
        }
    }
    curve.intercept = b[0] - b[1] * centre / width;
    curve.slope = b[1] / width;
    const std::optional<Goodness> good = goodness_of(
        trials, [&](double x) { return curve.probability(x); }, 3);
    if (!good || !std::isfinite(curve.slope)) {
        return std::nullopt;
    }
    curve.goodness = *good;
    return curve;
}

}  // namespace limpet::statistics
