// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/kalman.hpp"

#include <cmath>

#include "limpet/core/machines.hpp"

namespace limpet::autopilot {
namespace {

/// Columns to, to + 1, to + 2 of M += those from `from` on times B'. Plain loops over columns,
/// which compilers turn into vectors whatever the column's alignment.
void add_product(Covariance& matrix, int to, int from, const Matrix3& B) {
    const double* x = matrix.col(from).data();
    const double* y = matrix.col(from + 1).data();
    const double* z = matrix.col(from + 2).data();
    for (int k = 0; k < 3; ++k) {
        double* __restrict sum = matrix.col(to + k).data();
        for (int i = 0; i < kErrors; ++i) {
            sum[i] += B(k, 0) * x[i] + B(k, 1) * y[i] + B(k, 2) * z[i];
        }
    }
}

/// M = M F', three columns at a time: F is the identity but for a few 3x3 blocks. Positions take
/// the old velocities, velocities the old attitudes, attitudes the old biases.
void multiply_by_transposed(Covariance& matrix, const Transition& f) {
    matrix.middleCols<3>(kPosition) += f.dt_s * matrix.middleCols<3>(kVelocity);
    add_product(matrix, kVelocity, kAttitude, f.velocity_by_attitude);
    add_product(matrix, kVelocity, kAccelerometerBias, f.velocity_by_bias);
    const Eigen::Matrix<double, kErrors, 3> attitude = matrix.middleCols<3>(kAttitude);
    matrix.middleCols<3>(kAttitude).noalias() = attitude * f.turn.transpose();
    matrix.middleCols<3>(kAttitude) -= f.dt_s * matrix.middleCols<3>(kGyroBias);
}

void add_noise(Covariance& covariance, int first, double density, double dt_s) {
    covariance.diagonal().segment<3>(first).array() += density * density * dt_s;
}

/// P h, skipping the zeros that make up most of h.
ErrorVector times(const Covariance& covariance, const ErrorVector& h) {
    ErrorVector product = ErrorVector::Zero();
    for (int i = 0; i < kErrors; ++i) {
        if (h[i] != 0.0) {
            const double* column = covariance.col(i).data();
            for (int k = 0; k < kErrors; ++k) {
                product[k] += h[i] * column[k];
            }
        }
    }
    return product;
}

/// h' P h, skipping them twice.
double variance_along(const Covariance& covariance, const ErrorVector& h) {
    std::array<int, kErrors> others;
    std::size_t count = 0;
    double sum = 0.0;
    for (int i = 0; i < kErrors; ++i) {
        if (h[i] == 0.0) {
            continue;
        }
        double cross = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            cross += covariance(others[k], i) * h[others[k]];
        }
        sum += h[i] * (2.0 * cross + covariance(i, i) * h[i]);
        others[count++] = i;
    }
    return sum;
}

/// P -= the squares of some vectors, all in one pass; symmetric to the last bit.
template <std::size_t kRows>
void subtract_squares(Covariance& covariance, const std::array<ErrorVector, 3>& vectors) {
    for (int i = 0; i < kErrors; ++i) {
        double* __restrict column = covariance.col(i).data();
        for (int k = 0; k < kErrors; ++k) {
            double sum = vectors[0][i] * vectors[0][k];
            for (std::size_t row = 1; row < kRows; ++row) {
                sum += vectors[row][i] * vectors[row][k];
            }
            column[k] -= sum;
        }
    }
}

}  // namespace

LIMPET_FOR_MACHINES [[gnu::flatten]] void propagate(Covariance& covariance,
                                                    const Transition& transition,
                                                    const ProcessNoise& noise) {
    // P is symmetric: F P F' = ((P F')' F')'
    multiply_by_transposed(covariance, transition);
    covariance.transposeInPlace();
    multiply_by_transposed(covariance, transition);
    covariance.triangularView<Eigen::StrictlyLower>() = covariance.transpose();
    add_noise(covariance, kVelocity, noise.accelerometer_m_s2_rtHz, transition.dt_s);
    add_noise(covariance, kAttitude, noise.gyro_rad_s_rtHz, transition.dt_s);
    add_noise(covariance, kGyroBias, noise.gyro_bias_rad_s2_rtHz, transition.dt_s);
    add_noise(covariance, kAccelerometerBias, noise.accelerometer_bias_m_s3_rtHz, transition.dt_s);
}

void add_row(Measurement& measurement, const ErrorVector& jacobian, double innovation,
             double variance) {
    const auto row = static_cast<std::size_t>(measurement.rows++);
    measurement.jacobian[row] = jacobian;
    measurement.innovation[row] = innovation;
    measurement.variance[row] = variance;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] bool passes(const Covariance& covariance,
                                                 const ErrorVector& correction,
                                                 const Measurement& measurement, double gate) {
    for (int i = 0; i < measurement.rows; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const ErrorVector& h = measurement.jacobian[row];
        const double innovation = measurement.innovation[row] - h.dot(correction);
        const double variance = variance_along(covariance, h) + measurement.variance[row];
        if (!(innovation * innovation <= gate * gate * variance)) {
            return false;
        }
    }
    return true;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] void update(Covariance& covariance, ErrorVector& correction,
                                                 const Measurement& measurement) {
    std::array<ErrorVector, 3> scaled;
    const auto rows = static_cast<std::size_t>(measurement.rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const ErrorVector& h = measurement.jacobian[row];
        ErrorVector Ph = times(covariance, h);
        for (std::size_t earlier = 0; earlier < row; ++earlier) {
            Ph -= scaled[earlier] * scaled[earlier].dot(h);
        }
        const double deviation = std::sqrt(h.dot(Ph) + measurement.variance[row]);
        scaled[row] = Ph / deviation;
        const double innovation = measurement.innovation[row] - h.dot(correction);
        correction += scaled[row] * (innovation / deviation);
    }
    switch (rows) {
        case 0: break;
        case 1: subtract_squares<1>(covariance, scaled); break;
        case 2: subtract_squares<2>(covariance, scaled); break;
        default: subtract_squares<3>(covariance, scaled); break;
    }
}

void change_attitude_frame(Covariance& covariance, const Vector3& correction_rad) {
    constexpr double kTooSmall_rad = 1e-3;  // to matter; most are a hundredth of it
    if (correction_rad.squaredNorm() < kTooSmall_rad * kTooSmall_rad) {
        return;
    }
    const Matrix3 G = Matrix3::Identity() - 0.5 * skew(correction_rad);
    const Eigen::Matrix<double, kErrors, 3> columns = covariance.middleCols<3>(kAttitude);
    covariance.middleCols<3>(kAttitude).noalias() = columns * G.transpose();
    const Eigen::Matrix<double, 3, kErrors> rows = covariance.middleRows<3>(kAttitude);
    covariance.middleRows<3>(kAttitude).noalias() = G * rows;
    covariance.triangularView<Eigen::StrictlyLower>() = covariance.transpose();
}

void reset_error(Covariance& covariance, int error, double variance) {
    covariance.row(error).setZero();
    covariance.col(error).setZero();
    covariance(error, error) = variance;
}

}  // namespace limpet::autopilot
