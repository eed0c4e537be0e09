// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

/// The 15 errors, truth less belief, three each: position and velocity in W, attitude as a rotation
/// vector in B (q_true = q * exp(error)), gyro bias, accelerometer bias.
inline constexpr int kErrors = 15;
inline constexpr int kPosition = 0;
inline constexpr int kVelocity = 3;
inline constexpr int kAttitude = 6;
inline constexpr int kGyroBias = 9;
inline constexpr int kAccelerometerBias = 12;

using ErrorVector = Eigen::Matrix<double, kErrors, 1>;
using Covariance = Eigen::Matrix<double, kErrors, kErrors>;

/// How errors grow over a step, as the blocks that are neither zero nor identity:
///   p += dt v;  v += velocity_by_attitude a + velocity_by_bias b_a;  a = turn a - dt b_g.
struct Transition {
    double dt_s = 0.0;
    Matrix3 velocity_by_attitude = Matrix3::Zero();
    Matrix3 velocity_by_bias = Matrix3::Zero();
    Matrix3 turn = Matrix3::Identity();
};

/// Spectral densities of the IMU.
struct ProcessNoise {
    double gyro_rad_s_rtHz = 0.0;
    double accelerometer_m_s2_rtHz = 0.0;
    double gyro_bias_rad_s2_rtHz = 0.0;
    double accelerometer_bias_m_s3_rtHz = 0.0;
};

/// P = F P F' + Q, exactly symmetric.
void propagate(Covariance& covariance, const Transition& transition, const ProcessNoise& noise);

/// A row of a Jacobian: the errors that it has a factor for, seven at most of ours; 0 for all
/// others.
class JacobianRow {
public:
    JacobianRow() = default;
    /// Of a whole row: what is not 0 in it.
    explicit JacobianRow(const ErrorVector& all);
    /// @param error  that has no factor yet
    void put(int error, double factor) {
        at_[count_] = error;
        factor_[count_++] = factor;
    }
    /// Three that follow each other.
    void put(int error, const Vector3& factors) {
        for (int k = 0; k < 3; ++k) {
            put(error + k, factors[k]);
        }
    }
    [[nodiscard]] double operator[](int error) const;

    [[nodiscard]] double dot(const ErrorVector& v) const;
    /// P h
    [[nodiscard]] ErrorVector times(const Covariance& covariance) const;
    /// h' P h
    [[nodiscard]] double variance(const Covariance& covariance) const;

private:
    std::array<int, kErrors> at_;
    std::array<double, kErrors> factor_;
    std::size_t count_ = 0;
};

/// Up to three scalars measured at once with independent noise.
struct Measurement {
    int rows = 0;
    std::array<JacobianRow, 3> jacobian;  ///< of the innovation with respect to the errors
    std::array<double, 3> innovation{};   ///< measured less predicted
    std::array<double, 3> variance{};
};

void add_row(Measurement& measurement, const JacobianRow& jacobian, double innovation,
             double variance);

/// Chi-square test with one degree of freedom on each row, as PX4's gates.
/// @param correction  what earlier measurements of this instant found, not yet applied
/// @param gate        in standard deviations
/// @return false when any row is too far off, or is not finite
[[nodiscard]] bool passes(const Covariance& covariance, const ErrorVector& correction,
                          const Measurement& measurement, double gate);

/// Gains of a measurement's rows, each after those before it.
using Gains = std::array<ErrorVector, 3>;

/// Sequential scalar updates. Adds to `correction`, whose errors the covariance is that of.
/// @param gains  filled for who follows the errors by something else too; null: not asked for
/// @return the innovation squared over its covariance (NIS), of mean `rows` where all is as assumed
double update(Covariance& covariance, ErrorVector& correction, const Measurement& measurement,
              Gains* gains = nullptr);

/// What a measurement's error has in common from sample to sample, as a GPS's slow wander, is no
/// noise to average: the filter follows it. Its gains stay those for white noise; how far the
/// errors then go with a unit of the wander along each axis of W is known (Schmidt's consider
/// filter).
/// Source: Schmidt, "Application of state-space methods to navigation problems", Advances in
/// Control Systems 3, 1966.
using Followed = Eigen::Matrix<double, kErrors, 3>;
void propagate(Followed& followed, const Transition& transition);
/// @param wanders  whether the wander is in this measurement, of a position
void update(Followed& followed, const Measurement& measurement, const Gains& gains, bool wanders);

/// After a correction of the attitude its error is about the corrected frame: P = G P G' with
/// G = I - [correction]x / 2. Matters when a start is far off.
/// Source: Sola, "Quaternion kinematics for the error-state Kalman filter", 2017, section 6.3.
void change_attitude_frame(Covariance& covariance, const Vector3& correction_rad);

/// Forgets what is known of one error: uncorrelated, with this variance.
void reset_error(Covariance& covariance, int error, double variance);

}  // namespace limpet::autopilot
