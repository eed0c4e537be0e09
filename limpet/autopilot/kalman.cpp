// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/kalman.hpp"

#include <cmath>

namespace limpet::autopilot {
namespace {

/// M = M F', three columns at a time: F is the identity but for a few 3x3 blocks. Positions take
/// the old velocities, velocities the old attitudes, attitudes the old biases.
void multiply_by_transposed(Covariance& matrix, const Transition& f) {
    matrix.middleCols<3>(kPosition) += f.dt_s * matrix.middleCols<3>(kVelocity);
    matrix.middleCols<3>(kVelocity).noalias() +=
        matrix.middleCols<3>(kAttitude) * f.velocity_by_attitude.transpose();
    matrix.middleCols<3>(kVelocity).noalias() +=
        matrix.middleCols<3>(kAccelerometerBias) * f.velocity_by_bias.transpose();
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
            product += h[i] * covariance.col(i);
        }
    }
    return product;
}

}  // namespace

void propagate(Covariance& covariance, const Transition& transition, const ProcessNoise& noise) {
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

bool passes(const Covariance& covariance, const ErrorVector& correction,
            const Measurement& measurement, double gate) {
    for (int i = 0; i < measurement.rows; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const ErrorVector& h = measurement.jacobian[row];
        const double innovation = measurement.innovation[row] - h.dot(correction);
        const double variance = h.dot(times(covariance, h)) + measurement.variance[row];
        if (!(innovation * innovation <= gate * gate * variance)) {
            return false;
        }
    }
    return true;
}

void update(Covariance& covariance, ErrorVector& correction, const Measurement& measurement) {
    for (int i = 0; i < measurement.rows; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const ErrorVector& h = measurement.jacobian[row];
        const ErrorVector Ph = times(covariance, h);
        const double deviation = std::sqrt(h.dot(Ph) + measurement.variance[row]);
        const ErrorVector scaled = Ph / deviation;
        const double innovation = measurement.innovation[row] - h.dot(correction);
        correction += scaled * (innovation / deviation);
        covariance.noalias() -= scaled * scaled.transpose();  // symmetric to the last bit
    }
}

void change_attitude_frame(Covariance& covariance, const Vector3& correction_rad) {
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
