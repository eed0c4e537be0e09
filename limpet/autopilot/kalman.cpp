// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/kalman.hpp"

#include <cmath>

#include "limpet/core/machines.hpp"
#include "limpet/core/unrolled.hpp"

namespace limpet::autopilot {
namespace {

/// The first kRows rows of columns to, to + 1, to + 2 of M += those from `from` on times B'. Plain
/// loops over columns, which compilers turn into vectors whatever the column's alignment.
template <int kRows>
void add_product(Covariance& matrix, int to, int from, const Matrix3& B) {
    const double* x = matrix.col(from).data();
    const double* y = matrix.col(from + 1).data();
    const double* z = matrix.col(from + 2).data();
    for (int k = 0; k < 3; ++k) {
        double* __restrict sum = matrix.col(to + k).data();
        for (int i = 0; i < kRows; ++i) {
            sum[i] += B(k, 0) * x[i] + B(k, 1) * y[i] + B(k, 2) * z[i];
        }
    }
}

/// The first kRows rows of three columns += factor times those from `from` on.
template <int kRows>
void add_columns(Covariance& matrix, int to, int from, double factor) {
    for (int k = 0; k < 3; ++k) {
        const double* x = matrix.col(from + k).data();
        double* __restrict sum = matrix.col(to + k).data();
        for (int i = 0; i < kRows; ++i) {
            sum[i] += factor * x[i];
        }
    }
}

/// M = M F', three columns at a time: F is the identity but for a few 3x3 blocks. Positions take
/// the old velocities, velocities the old attitudes, attitudes the old biases.
/// @tparam kPositions, kVelocities, kAttitudes  as many rows of these columns are requested
template <int kPositions, int kVelocities, int kAttitudes>
void multiply_by_transposed(Covariance& matrix, const Transition& f) {
    add_columns<kPositions>(matrix, kPosition, kVelocity, f.dt_s);
    add_product<kVelocities>(matrix, kVelocity, kAttitude, f.velocity_by_attitude);
    add_product<kVelocities>(matrix, kVelocity, kAccelerometerBias, f.velocity_by_bias);
    auto turned = matrix.template topRows<kAttitudes>().template middleCols<3>(kAttitude);
    const Eigen::Matrix<double, kAttitudes, 3> attitude = turned;
    turned.noalias() = attitude * f.turn.transpose();
    add_columns<kAttitudes>(matrix, kAttitude, kGyroBias, -f.dt_s);
}

/// Calls of_pair(i, j) for each place above the diagonal.
template <class OfPair>
[[gnu::always_inline]] inline void for_each_pair(OfPair&& of_pair) {
    unrolled<kErrors>([&](auto j) [[gnu::always_inline]] {
        unrolled<j.value>([&](auto i) [[gnu::always_inline]] { of_pair(i.value, j.value); });
    });
}

void add_noise(Covariance& covariance, int first, double density, double dt_s) {
    covariance.diagonal().segment<3>(first).array() += density * density * dt_s;
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

JacobianRow::JacobianRow(const ErrorVector& all) {
    for (int error = 0; error < kErrors; ++error) {
        if (all[error] != 0.0) {
            put(error, all[error]);
        }
    }
}

double JacobianRow::operator[](int error) const {
    for (std::size_t k = 0; k < count_; ++k) {
        if (at_[k] == error) {
            return factor_[k];
        }
    }
    return 0.0;
}

double JacobianRow::dot(const ErrorVector& v) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count_; ++k) {
        sum += factor_[k] * v[at_[k]];
    }
    return sum;
}

ErrorVector JacobianRow::times(const Covariance& covariance) const {
    ErrorVector product = ErrorVector::Zero();
    for (std::size_t k = 0; k < count_; ++k) {
        const double factor = factor_[k];
        const double* column = covariance.col(at_[k]).data();
        for (int i = 0; i < kErrors; ++i) {
            product[i] += factor * column[i];
        }
    }
    return product;
}

double JacobianRow::variance(const Covariance& covariance) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const double* column = covariance.col(at_[i]).data();
        double cross = 0.0;
        for (std::size_t k = 0; k < i; ++k) {
            cross += column[at_[k]] * factor_[k];
        }
        sum += factor_[i] * (2.0 * cross + column[at_[i]] * factor_[i]);
    }
    return sum;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] void propagate(Covariance& covariance,
                                                    const Transition& transition,
                                                    const ProcessNoise& noise) {
    // P is symmetric: F P F' = ((P F')' F')', of which the upper half is found and mirrored.
    multiply_by_transposed<kErrors, kErrors, kErrors>(covariance, transition);
    const Matrix3 attitude = covariance.block<3, 3>(kAttitude, kAttitude);  // all of it turns
    for_each_pair([&](int i, int j) { covariance(i, j) = covariance(j, i); });
    covariance.block<3, 3>(kAttitude, kAttitude) = attitude.transpose();
    // One row more than the upper half has: of an odd one Eigen's sums would go in another order.
    multiply_by_transposed<kVelocity, kAttitude, kGyroBias + 1>(covariance, transition);
    for_each_pair([&](int i, int j) { covariance(j, i) = covariance(i, j); });
    add_noise(covariance, kVelocity, noise.accelerometer_m_s2_rtHz, transition.dt_s);
    add_noise(covariance, kAttitude, noise.gyro_rad_s_rtHz, transition.dt_s);
    add_noise(covariance, kGyroBias, noise.gyro_bias_rad_s2_rtHz, transition.dt_s);
    add_noise(covariance, kAccelerometerBias, noise.accelerometer_bias_m_s3_rtHz, transition.dt_s);
}

void add_row(Measurement& measurement, const JacobianRow& jacobian, double innovation,
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
        const JacobianRow& h = measurement.jacobian[row];
        const double innovation = measurement.innovation[row] - h.dot(correction);
        const double variance = h.variance(covariance) + measurement.variance[row];
        if (!(innovation * innovation <= gate * gate * variance)) {
            return false;
        }
    }
    return true;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] double update(Covariance& covariance, ErrorVector& correction,
                                                   const Measurement& measurement, Gains* gains) {
    double nis = 0.0;
    std::array<ErrorVector, 3> scaled;
    const auto rows = static_cast<std::size_t>(measurement.rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const JacobianRow& h = measurement.jacobian[row];
        ErrorVector Ph = h.times(covariance);
        for (std::size_t earlier = 0; earlier < row; ++earlier) {
            Ph -= scaled[earlier] * h.dot(scaled[earlier]);
        }
        const double deviation = std::sqrt(h.dot(Ph) + measurement.variance[row]);
        scaled[row] = Ph / deviation;
        const double innovation = measurement.innovation[row] - h.dot(correction);
        const double normalised = innovation / deviation;
        correction += scaled[row] * normalised;
        nis += normalised * normalised;
        if (gains != nullptr) {
            (*gains)[row] = scaled[row] / deviation;
        }
    }
    switch (rows) {
        case 0: break;
        case 1: subtract_squares<1>(covariance, scaled); break;
        case 2: subtract_squares<2>(covariance, scaled); break;
        default: subtract_squares<3>(covariance, scaled); break;
    }
    return nis;
}

void propagate(Followed& followed, const Transition& f) {
    const Followed before = followed;
    const auto block = [&before](int error) { return before.middleRows<3>(error); };
    followed.middleRows<3>(kPosition) += f.dt_s * block(kVelocity);
    followed.middleRows<3>(kVelocity) +=
        f.velocity_by_attitude * block(kAttitude) + f.velocity_by_bias * block(kAccelerometerBias);
    followed.middleRows<3>(kAttitude) = f.turn * block(kAttitude) - f.dt_s * block(kGyroBias);
}

void update(Followed& followed, const Measurement& measurement, const Gains& gains, bool wanders) {
    for (std::size_t row = 0; row < static_cast<std::size_t>(measurement.rows); ++row) {
        const JacobianRow& h = measurement.jacobian[row];
        Vector3 seen;
        for (int axis = 0; axis < 3; ++axis) {
            seen[axis] = h.dot(followed.col(axis)) + (wanders ? h[kPosition + axis] : 0.0);
        }
        followed -= gains[row] * seen.transpose();
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
