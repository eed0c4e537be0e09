// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/surrogate.hpp"

#include <Eigen/QR>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::study {

double InputRange::scaled(double value) const {
    return log ? 2.0 * std::log(value / low) / std::log(high / low) - 1.0
               : 2.0 * (value - low) / (high - low) - 1.0;
}

double InputRange::at(double share) const {
    return log ? low * std::pow(high / low, share) : low + (high - low) * share;
}

Surrogate::Surrogate(std::vector<InputRange> ranges, const Eigen::MatrixXd& points,
                     const Eigen::VectorXd& values)
    : ranges_(std::move(ranges)) {
    const Eigen::Index count = points.rows(), size = terms(points.cols());
    require(count > size && values.size() == count, "more points than terms");
    Eigen::MatrixXd matrix(count, size);
    for (Eigen::Index i = 0; i < count; ++i) {
        matrix.row(i) = row(points.row(i).transpose()).transpose();
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> decomposed(matrix);
    coefficients_ = decomposed.solve(values);
    // A point's own share in its prediction: the diagonal of the hat matrix.
    const Eigen::MatrixXd thin = decomposed.householderQ() * Eigen::MatrixXd::Identity(count, size);
    const Eigen::VectorXd own = thin.rowwise().squaredNorm();
    const Eigen::VectorXd missed =
        (values - matrix * coefficients_).array() / (1.0 - own.array()).max(1e-6);
    left_out_rms_ = std::sqrt(missed.squaredNorm() / static_cast<double>(count));
    predicted_share_ =
        1.0 - missed.squaredNorm() / (values.array() - values.mean()).matrix().squaredNorm();
}

Eigen::VectorXd Surrogate::row(const Eigen::VectorXd& point) const {
    const Eigen::Index n = point.size();
    Eigen::VectorXd x(n), all(terms(n));
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] = ranges_[static_cast<std::size_t>(i)].scaled(point[i]);
    }
    Eigen::Index at = 0;
    all[at++] = 1.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        all[at++] = x[i];
        for (Eigen::Index k = i; k < n; ++k) {
            all[at++] = x[i] * x[k];
        }
    }
    return all;
}

double Surrogate::operator()(const Eigen::VectorXd& point) const {
    return coefficients_.dot(row(point));
}

}  // namespace limpet::study
