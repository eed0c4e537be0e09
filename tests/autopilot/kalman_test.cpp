// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/kalman.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "limpet/core/random.hpp"

namespace limpet::autopilot {
namespace {

Covariance random_covariance(RandomStream& random) {
    Covariance root;
    for (int i = 0; i < kErrors; ++i) {
        for (int j = 0; j < kErrors; ++j) {
            root(i, j) = random.normal();
        }
    }
    const Covariance product = root * root.transpose();
    return 0.5 * (product + product.transpose());
}

Matrix3 random_matrix(RandomStream& random) {
    Matrix3 matrix;
    matrix << random.normal3(), random.normal3(), random.normal3();
    return matrix;
}

TEST(Kalman, BlockwisePropagationEqualsTheDenseProduct) {
    RandomStream random(1, 0, Stream::test);
    const Covariance before = random_covariance(random);
    const Transition t{.dt_s = 0.3,
                       .velocity_by_attitude = random_matrix(random),
                       .velocity_by_bias = random_matrix(random),
                       .turn = random_matrix(random)};
    const ProcessNoise noise{.gyro_rad_s_rtHz = 0.1,
                             .accelerometer_m_s2_rtHz = 0.2,
                             .gyro_bias_rad_s2_rtHz = 0.3,
                             .accelerometer_bias_m_s3_rtHz = 0.4};
    Covariance F = Covariance::Identity();
    F.block<3, 3>(kPosition, kVelocity) = t.dt_s * Matrix3::Identity();
    F.block<3, 3>(kVelocity, kAttitude) = t.velocity_by_attitude;
    F.block<3, 3>(kVelocity, kAccelerometerBias) = t.velocity_by_bias;
    F.block<3, 3>(kAttitude, kAttitude) = t.turn;
    F.block<3, 3>(kAttitude, kGyroBias) = -t.dt_s * Matrix3::Identity();
    ErrorVector q = ErrorVector::Zero();
    q.segment<3>(kVelocity).setConstant(0.04 * t.dt_s);
    q.segment<3>(kAttitude).setConstant(0.01 * t.dt_s);
    q.segment<3>(kGyroBias).setConstant(0.09 * t.dt_s);
    q.segment<3>(kAccelerometerBias).setConstant(0.16 * t.dt_s);
    const Covariance expected = F * before * F.transpose() + Covariance(q.asDiagonal());

    Covariance after = before;
    propagate(after, t, noise);
    EXPECT_TRUE(after.isApprox(expected, 1e-12));
    EXPECT_EQ(after, Covariance(after.transpose()));
}

TEST(Kalman, SequentialUpdateEqualsTheBatch) {
    RandomStream random(2, 0, Stream::test);
    const Covariance before = random_covariance(random);
    Eigen::Matrix<double, 3, kErrors> H;
    const Vector3 innovation = random.normal3();
    const Vector3 variance(0.5, 1.0, 2.0);
    Measurement measurement;
    for (int i = 0; i < 3; ++i) {
        ErrorVector h;
        for (int j = 0; j < kErrors; ++j) {
            h[j] = j % 4 == i ? 0.0 : random.normal();
        }
        H.row(i) = h;
        add_row(measurement, JacobianRow(h), innovation[i], variance[i]);
    }
    const Matrix3 S = H * before * H.transpose() + Matrix3(variance.asDiagonal());
    const Eigen::Matrix<double, kErrors, 3> K = before * H.transpose() * S.inverse();

    Covariance after = before;
    ErrorVector correction = ErrorVector::Zero();
    update(after, correction, measurement);
    EXPECT_TRUE(correction.isApprox(K * innovation, 1e-9));
    EXPECT_TRUE(after.isApprox((Covariance::Identity() - K * H) * before, 1e-9));
    EXPECT_EQ(after, Covariance(after.transpose()));
}

TEST(Kalman, ChangeOfTheAttitudeFrameEqualsTheDenseProduct) {
    RandomStream random(3, 0, Stream::test);
    const Covariance before = random_covariance(random);
    const Vector3 correction(0.2, -0.1, 0.3);
    Covariance G = Covariance::Identity();
    G.block<3, 3>(kAttitude, kAttitude) -= 0.5 * skew(correction);
    Covariance after = before;
    change_attitude_frame(after, correction);
    EXPECT_TRUE(after.isApprox(G * before * G.transpose(), 1e-12));
    EXPECT_EQ(after, Covariance(after.transpose()));
}

TEST(Kalman, GateIsInStandardDeviations) {
    Covariance covariance = Covariance::Identity();
    ErrorVector h = ErrorVector::Zero();
    h[kPosition] = 1.0;
    const auto test = [&](double innovation) {
        Measurement measurement;
        add_row(measurement, JacobianRow(h), innovation, 3.0);  // S = 1 + 3: deviation 2
        return passes(covariance, ErrorVector::Zero(), measurement, 5.0);
    };
    EXPECT_TRUE(test(9.9));
    EXPECT_TRUE(test(-9.9));
    EXPECT_FALSE(test(10.1));
    EXPECT_FALSE(test(std::nan("")));
}

}  // namespace
}  // namespace limpet::autopilot
