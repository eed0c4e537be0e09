// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace limpet::statistics {

/// Two-sided 95 % of a standard normal.
inline constexpr double kNormal95 = 1.959963984540054;

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// Wilson's score interval, 95 %, of a share of so many runs, which may be an effective number of
/// weighted ones; 0..1 without any.
/// Source: Wilson, J. Am. Stat. Assoc. 22 (1927) 209.
[[nodiscard]] Interval wilson(double share, double runs);

/// A share of runs with its 95 % interval.
struct Proportion {
    std::uint32_t successes = 0;
    std::uint32_t runs = 0;

    /// NaN without runs.
    [[nodiscard]] double probability() const;
    /// Wilson's: honest at 0, at 1 and with few runs.
    [[nodiscard]] Interval interval() const;
};

/// 1 / (1 + exp(-eta))
[[nodiscard]] double logistic(double eta);

/// P(success) = 1 / (1 + exp(-(intercept + slope x))).
struct LogisticFit {
    double intercept = 0.0;
    double slope = 0.0;
    double slope_error = 0.0;  ///< standard error
    double half = 0.0;         ///< x at which half of the runs succeed
    double half_error = 0.0;   ///< standard error of that, by the delta method

    [[nodiscard]] double probability(double x) const;
};

/// Runs at one value of x.
struct Trials {
    double x = 0.0;
    Proportion proportion;
};

/// Trials along ascending x. Of many runs those of neighbouring values are taken together, at their
/// mean, so that memory does not follow the number of runs: x to a 5000th of its range.
class TrialsAlong {
public:
    /// A multiple of the ten groups of a summary: none of them parts what is together.
    static constexpr std::uint32_t kMost = 5000;

    /// @param range  of all x
    /// @param runs   in all; with kMost at most every value stays as it is
    TrialsAlong(const Interval& range, std::uint32_t runs)
        : low_(range.low), width_(runs > kMost ? (range.high - range.low) / kMost : 0.0) {}
    /// @param trials  x not below that of the last ones
    void add(const Trials& trials);
    [[nodiscard]] const std::vector<Trials>& all() const { return trials_; }

private:
    double low_;
    double width_;  ///< of what is taken together; 0: nothing is
    std::vector<Trials> trials_;
    double last_cell_ = 0.0;
};

/// Maximum likelihood by Newton's method.
/// @return nullopt where no finite fit exists or none makes sense: fewer than three values of x,
///         only successes or only failures, or a threshold that parts them cleanly
[[nodiscard]] std::optional<LogisticFit> fit_logistic(const std::vector<Trials>& trials);

/// @param sorted  ascending, not empty
/// @param share   0..1
/// @return quantile by linear interpolation between the order statistics (R's type 7)
[[nodiscard]] double quantile(const std::vector<double>& sorted, double share);
/// The same of numbers that only pass by, of which none is kept.
/// @param count   of them, > 0
/// @param shares  ascending
/// @param next    the next number, ascending; is called `count` times at most
[[nodiscard]] std::vector<double> quantiles(std::size_t count, const std::vector<double>& shares,
                                            const std::function<double()>& next);

}  // namespace limpet::statistics
