// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

#include "limpet/identification/pressure_curve.hpp"
#include "limpet/identification/suspicion.hpp"

namespace limpet::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool sensible(const PressureCurve& curve) {
    return !(curve.sealing && !(curve.tau_1_s > 0.0)) &&
           !(curve.unsealing && !(curve.tau_2_s > 0.0)) &&
           !(curve.sealing && curve.unsealing && curve.off_s <= curve.on_s) &&
           curve.vacuum_Pa < curve.atmosphere_Pa && curve.ripple_Hz >= 0.0;
}

/// What curves leave of a trace, over their free parameters; the interface is Eigen's.
struct Residuals {
    using Scalar = double;
    using InputType = VectorXd;
    using ValueType = VectorXd;
    using JacobianType = MatrixXd;
    static constexpr int InputsAtCompileTime = Eigen::Dynamic;
    static constexpr int ValuesAtCompileTime = Eigen::Dynamic;

    const PressureTrace& trace;
    const PressureCurve& start;
    const std::vector<CurveParameter>& free;

    [[nodiscard]] int inputs() const { return static_cast<int>(free.size()); }
    [[nodiscard]] int values() const { return static_cast<int>(trace.t_s.size()); }

    [[nodiscard]] VectorXd parameters() const {
        VectorXd some(inputs());
        std::transform(free.begin(), free.end(), some.data(),
                       [this](CurveParameter parameter) { return start.*member_of(parameter); });
        return some;
    }
    [[nodiscard]] PressureCurve curve(const VectorXd& parameters) const {
        PressureCurve curve = start;
        for (std::size_t k = 0; k < free.size(); ++k) {
            curve.*member_of(free[k]) = parameters[static_cast<Eigen::Index>(k)];
        }
        if (curve.baseline) {  // the start of a log that begins in the air is the atmosphere
            curve.start_Pa = curve.atmosphere_Pa;
        }
        return curve;
    }
    /// [Pa]; of a curve that makes no sense so much that no step leads there.
    int operator()(const VectorXd& parameters, VectorXd& left_Pa) const {
        constexpr double kFar_Pa = 1e100;
        const PressureCurve at = curve(parameters);
        const bool possible = parameters.allFinite() && sensible(at);
        for (int i = 0; i < values(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            left_Pa[i] = possible ? trace.pressure_Pa[k] - pressure_Pa(at, trace.t_s[k]) : kFar_Pa;
        }
        return 0;
    }
    /// Its slopes, a row a sample.
    int df(const VectorXd& parameters, MatrixXd& slopes) const {
        const PressureCurve at = curve(parameters);
        for (int i = 0; i < values(); ++i) {
            const CurvePoint point = point_of(at, trace.t_s[static_cast<std::size_t>(i)]);
            for (int k = 0; k < inputs(); ++k) {
                slopes(i, k) = -point.gradient[static_cast<int>(free[static_cast<std::size_t>(k)])];
            }
        }
        return 0;
    }
};

/// Time after which residuals forget: where their autocorrelation has fallen into its noise, twice
/// over for the kernel's slope; by samples, gaps count as none.
double memory_of(const PressureTrace& trace, const VectorXd& residuals_Pa) {
    const Eigen::Index n = residuals_Pa.size();
    const double noise = 2.0 / std::sqrt(static_cast<double>(n)) * residuals_Pa.squaredNorm();
    const Eigen::Index most = std::clamp<Eigen::Index>(n / 8, 4, 2000);
    Eigen::Index lag = 1;
    while (lag < most && residuals_Pa.head(n - lag).dot(residuals_Pa.tail(n - lag)) >= noise) {
        ++lag;
    }
    return median_step_s(trace.t_s) * static_cast<double>(std::max<Eigen::Index>(4, 2 * lag));
}

/// Sum over pairs of Bartlett's weight times the product of their scores.
/// @param scores  of a sample, a column each
MatrixXd long_run(const PressureTrace& trace, const MatrixXd& scores, double memory_s) {
    MatrixXd sum = MatrixXd::Zero(scores.rows(), scores.rows());
    for (Eigen::Index i = 0; i < scores.cols(); ++i) {
        VectorXd later = 0.5 * scores.col(i);
        for (Eigen::Index j = i + 1; j < scores.cols(); ++j) {
            const double weight = 1.0 - (trace.t_s[static_cast<std::size_t>(j)] -
                                         trace.t_s[static_cast<std::size_t>(i)]) /
                                            memory_s;
            if (weight <= 0.0) {
                break;
            }
            later += weight * scores.col(j);
        }
        const MatrixXd half = scores.col(i) * later.transpose();
        sum += half + half.transpose();
    }
    return sum;
}

/// Degrees of freedom of each variance, after Satterthwaite: how many samples a parameter hangs on,
/// less what they know of one another. The weights' fourth powers count where few samples decide.
/// @param weights     of every sample (column) on every parameter (row)
/// @param correlated  samples that Bartlett's kernel takes together
VectorXd freedom_of(const MatrixXd& weights, double correlated) {
    const VectorXd second = weights.cwiseAbs2().rowwise().sum();
    const VectorXd fourth = weights.cwiseAbs2().cwiseAbs2().rowwise().sum();
    return second.cwiseAbs2().cwiseQuotient(fourth) / std::max(1.0, 2.0 / 3.0 * correlated);
}

void add_covariance(const PressureTrace& trace, CurveFit& fit) {
    const Residuals residuals{trace, fit.curve, fit.free};
    const int n = residuals.values();
    const int size = residuals.inputs();
    VectorXd left_Pa(n);
    MatrixXd slopes(n, size);
    residuals(residuals.parameters(), left_Pa);
    residuals.df(residuals.parameters(), slopes);
    const MatrixXd matrix = slopes.transpose() * slopes;
    const VectorXd scale = matrix.diagonal().cwiseSqrt();
    if (!(scale.minCoeff() > 0.0)) {
        return;  // a parameter that moves nothing
    }
    const MatrixXd scaled =
        scale.cwiseInverse().asDiagonal() * matrix * scale.cwiseInverse().asDiagonal();
    const Eigen::LDLT<MatrixXd> decomposed(scaled);
    if (decomposed.vectorD().minCoeff() < 1e-10) {
        return;  // parameters that move the same
    }
    const MatrixXd gradients = scale.cwiseInverse().asDiagonal() * slopes.transpose();
    fit.residual_Pa = std::sqrt(left_Pa.squaredNorm() / (n - size));
    fit.memory_s = memory_of(trace, left_Pa);
    const MatrixXd inverse = decomposed.solve(MatrixXd::Identity(size, size));
    // Samples that pull the curve towards themselves leave less than their noise (HC3).
    const VectorXd pull = gradients.cwiseProduct(inverse * gradients).colwise().sum();
    const VectorXd freed_Pa = left_Pa.array() / (1.0 - pull.array()).max(0.1);
    const MatrixXd scores = long_run(trace, gradients * freed_Pa.asDiagonal(), fit.memory_s);
    fit.covariance = scale.cwiseInverse().asDiagonal() * inverse * scores * inverse *
                     scale.cwiseInverse().asDiagonal();
    fit.freedom = freedom_of(inverse * gradients, fit.memory_s / median_step_s(trace.t_s));
    fit.regular = fit.covariance.allFinite() && fit.covariance.diagonal().minCoeff() >= 0.0;
}

}  // namespace

PressureCurve improved_curve(const PressureTrace& trace, const PressureCurve& start,
                             const std::vector<CurveParameter>& free, double& left_Pa2) {
    const Residuals residuals{trace, start, free};
    VectorXd parameters = residuals.parameters();
    Eigen::LevenbergMarquardt<const Residuals> solver(residuals);
    solver.parameters.ftol = solver.parameters.xtol = 1e-9;
    (void)solver.minimize(parameters);
    left_Pa2 = solver.fnorm * solver.fnorm;
    return residuals.curve(parameters);
}

CurveFit fit_curve(const PressureTrace& trace, const PressureCurve& start,
                   const std::vector<CurveParameter>& free) {
    CurveFit fit;
    fit.free = free;
    double squares = 0.0;
    fit.curve = improved_curve(trace, start, free, squares);
    add_covariance(trace, fit);
    return fit;
}

}  // namespace limpet::identification
