// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/identification/pressure_curve.hpp"

namespace limpet::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// J'J, J'r and r'r of a curve.
struct Normal {
    MatrixXd matrix;
    VectorXd gradient;
    double squares_Pa2 = 0.0;
};

VectorXd picked(const CurveGradient& gradient, const std::vector<CurveParameter>& free) {
    VectorXd some(static_cast<Eigen::Index>(free.size()));
    for (std::size_t k = 0; k < free.size(); ++k) {
        some[static_cast<Eigen::Index>(k)] = gradient[static_cast<int>(free[k])];
    }
    return some;
}

Normal normal_equations(const PressureTrace& trace, const PressureCurve& curve,
                        const std::vector<CurveParameter>& free) {
    Eigen::Matrix<double, kCurveParameters, kCurveParameters> matrix;
    matrix.setZero();
    CurveGradient gradient = CurveGradient::Zero();
    Normal normal;
    for (std::size_t i = 0; i < trace.t_s.size(); ++i) {
        const CurvePoint point = point_of(curve, trace.t_s[i]);
        const double residual_Pa = trace.pressure_Pa[i] - point.pressure_Pa;
        matrix.noalias() += point.gradient * point.gradient.transpose();
        gradient += residual_Pa * point.gradient;
        normal.squares_Pa2 += residual_Pa * residual_Pa;
    }
    const auto size = static_cast<Eigen::Index>(free.size());
    normal.matrix.resize(size, size);
    normal.gradient = picked(gradient, free);
    for (Eigen::Index k = 0; k < size; ++k) {
        normal.matrix.col(k) =
            picked(matrix.col(static_cast<int>(free[static_cast<std::size_t>(k)])), free);
    }
    return normal;
}

double squares_Pa2(const PressureTrace& trace, const PressureCurve& curve) {
    double sum = 0.0;
    for (std::size_t i = 0; i < trace.t_s.size(); ++i) {
        const double residual_Pa = trace.pressure_Pa[i] - point_of(curve, trace.t_s[i]).pressure_Pa;
        sum += residual_Pa * residual_Pa;
    }
    return sum;
}

/// The start of a log that begins in the air is the atmosphere.
void tie(PressureCurve& curve) {
    if (curve.baseline) {
        curve.start_Pa = curve.atmosphere_Pa;
    }
}

bool sensible(const PressureCurve& curve) {
    return !(curve.sealing && !(curve.tau_1_s > 0.0)) &&
           !(curve.unsealing && !(curve.tau_2_s > 0.0)) &&
           !(curve.sealing && curve.unsealing && curve.off_s <= curve.on_s) &&
           curve.vacuum_Pa < curve.atmosphere_Pa && curve.ripple_Hz >= 0.0;
}

PressureCurve stepped(PressureCurve curve, const std::vector<CurveParameter>& free,
                      const VectorXd& step) {
    for (std::size_t k = 0; k < free.size(); ++k) {
        value_of(curve, free[k]) += step[static_cast<Eigen::Index>(k)];
    }
    tie(curve);
    return curve;
}

double median_step_s(const PressureTrace& trace) {
    std::vector<double> steps_s(trace.t_s.size() - 1);
    for (std::size_t i = 0; i < steps_s.size(); ++i) {
        steps_s[i] = trace.t_s[i + 1] - trace.t_s[i];
    }
    const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
    std::nth_element(steps_s.begin(), middle, steps_s.end());
    return *middle;
}

/// Time after which residuals forget: where their autocorrelation has fallen into its noise, twice
/// over for the kernel's slope; by samples, gaps count as none.
double memory_of(const PressureTrace& trace, const std::vector<double>& residuals_Pa) {
    const std::size_t n = residuals_Pa.size();
    double variance = 0.0;
    for (const double residual_Pa : residuals_Pa) {
        variance += residual_Pa * residual_Pa;
    }
    const std::size_t most = std::max<std::size_t>(4, std::min<std::size_t>(n / 8, 2000));
    std::size_t lag = 1;
    for (; lag < most; ++lag) {
        double sum = 0.0;
        for (std::size_t i = 0; i + lag < n; ++i) {
            sum += residuals_Pa[i] * residuals_Pa[i + lag];
        }
        if (sum < 2.0 / std::sqrt(static_cast<double>(n)) * variance) {
            break;
        }
    }
    return median_step_s(trace) * static_cast<double>(std::max<std::size_t>(4, 2 * lag));
}

/// Sum over pairs of Bartlett's weight times the product of their scores.
MatrixXd long_run_scores(const PressureTrace& trace, const std::vector<double>& residuals_Pa,
                         const MatrixXd& gradients, double memory_s) {
    const Eigen::Index size = gradients.rows();
    MatrixXd sum = MatrixXd::Zero(size, size);
    for (std::size_t i = 0; i < residuals_Pa.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        VectorXd later = 0.5 * residuals_Pa[i] * gradients.col(column);
        for (std::size_t j = i + 1; j < residuals_Pa.size(); ++j) {
            const double weight = 1.0 - (trace.t_s[j] - trace.t_s[i]) / memory_s;
            if (weight <= 0.0) {
                break;
            }
            later += weight * residuals_Pa[j] * gradients.col(static_cast<Eigen::Index>(j));
        }
        const MatrixXd half = residuals_Pa[i] * gradients.col(column) * later.transpose();
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
    const std::size_t n = trace.t_s.size();
    const auto size = static_cast<Eigen::Index>(fit.free.size());
    const MatrixXd matrix = normal_equations(trace, fit.curve, fit.free).matrix;
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
    std::vector<double> residuals_Pa(n);
    MatrixXd gradients(size, static_cast<Eigen::Index>(n));
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const CurvePoint point = point_of(fit.curve, trace.t_s[i]);
        residuals_Pa[i] = trace.pressure_Pa[i] - point.pressure_Pa;
        squares += residuals_Pa[i] * residuals_Pa[i];
        gradients.col(static_cast<Eigen::Index>(i)) =
            picked(point.gradient, fit.free).cwiseQuotient(scale);
    }
    fit.residual_Pa = std::sqrt(squares / static_cast<double>(n - fit.free.size()));
    fit.memory_s = memory_of(trace, residuals_Pa);
    const MatrixXd inverse = decomposed.solve(MatrixXd::Identity(size, size));
    // Samples that pull the curve towards themselves leave less than their noise (HC3).
    std::vector<double> freed_Pa(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto gradient = gradients.col(static_cast<Eigen::Index>(i));
        freed_Pa[i] = residuals_Pa[i] / std::max(0.1, 1.0 - gradient.dot(inverse * gradient));
    }
    const MatrixXd scores = long_run_scores(trace, freed_Pa, gradients, fit.memory_s);
    fit.covariance = scale.cwiseInverse().asDiagonal() * inverse * scores * inverse *
                     scale.cwiseInverse().asDiagonal();
    fit.freedom = freedom_of(inverse * gradients, fit.memory_s / median_step_s(trace));
    fit.regular = fit.covariance.allFinite() && fit.covariance.diagonal().minCoeff() >= 0.0;
}

}  // namespace

PressureCurve improved_curve(const PressureTrace& trace, const PressureCurve& start,
                             const std::vector<CurveParameter>& free, double& left_Pa2) {
    PressureCurve curve = start;
    tie(curve);
    double damping = 1e-3;
    Normal normal = normal_equations(trace, curve, free);
    for (int k = 0; k < 100 && damping < 1e12; ++k) {
        MatrixXd damped = normal.matrix;
        damped.diagonal() += damping * normal.matrix.diagonal();
        damped.diagonal().array() += std::numeric_limits<double>::min();
        const VectorXd step = damped.ldlt().solve(normal.gradient);
        const PressureCurve next = stepped(curve, free, step);
        const double squares = step.allFinite() && sensible(next)
                                   ? squares_Pa2(trace, next)
                                   : std::numeric_limits<double>::infinity();
        if (!(squares < normal.squares_Pa2)) {
            damping *= 8.0;
            continue;
        }
        const bool settled = normal.squares_Pa2 - squares < 1e-9 * squares;
        curve = next;
        damping = std::max(1e-9, damping / 8.0);
        normal = normal_equations(trace, curve, free);
        if (settled) {
            break;
        }
    }
    left_Pa2 = normal.squares_Pa2;
    return curve;
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
