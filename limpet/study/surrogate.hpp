// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace limpet::study {

/// Ends of an input; where `log` is set it counts by its logarithm.
struct InputRange {
    double low = 0.0;
    double high = 1.0;
    bool log = false;
    /// @return -1 at the low end, +1 at the high one
    [[nodiscard]] double scaled(double value) const;
    [[nodiscard]] double at(double share) const;  ///< of 0..1
};

/// A number over many inputs as a polynomial of second degree, by least squares, that stands in the
/// place of what takes long. It knows how wrong it is at points that it has not seen.
class Surrogate {
public:
    /// @param points  a row a point, a column an input; more rows than polynomial terms
    Surrogate(std::vector<InputRange> ranges, const Eigen::MatrixXd& points,
              const Eigen::VectorXd& values);

    [[nodiscard]] double operator()(const Eigen::VectorXd& point) const;
    /// Root mean square of what each point is missed by when it is left out of the fit.
    [[nodiscard]] double left_out_rms() const { return left_out_rms_; }
    /// 1 less the share of the variance that is missed so.
    [[nodiscard]] double predicted_share() const { return predicted_share_; }
    [[nodiscard]] static Eigen::Index terms(Eigen::Index inputs) {
        return 1 + 2 * inputs + inputs * (inputs - 1) / 2;
    }

private:
    [[nodiscard]] Eigen::VectorXd row(const Eigen::VectorXd& point) const;

    std::vector<InputRange> ranges_;
    Eigen::VectorXd coefficients_;
    double left_out_rms_ = 0.0;
    double predicted_share_ = 0.0;
};

}  // namespace limpet::study
