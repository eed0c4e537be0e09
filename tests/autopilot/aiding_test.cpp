// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "defaults.hpp"
#include "limpet/autopilot/estimator.hpp"
#include "limpet/core/random.hpp"

namespace limpet::autopilot {
namespace {

/// A stretch of brisk flight: the states and the samples between them.
struct Stretch {
    Stretch() {
        now.v_WB_m_s = {1.0, -0.5, 0.2};
        now.q_WB = quaternion_from_euler({0.2, 1.1, -2.0});
        now.gyro_bias_rad_s = {0.01, -0.02, 0.005};
        now.accelerometer_bias_m_s2 = {0.1, 0.2, -0.1};
        states.push_back(now);
        RandomStream random(4, 0, Stream::test);
        for (int i = 0; i < 40; ++i) {
            const ImuStep step{
                .dt_s = kDt_s,
                .rate_B_rad_s = 2.0 * random.normal3(),
                .specific_force_B_m_s2 = Vector3(0.0, 0.0, -9.8) + 3.0 * random.normal3()};
            now = advance(now, step);
            remember(history, step);
            states.push_back(now);
        }
    }

    Navigation now;
    ImuHistory history;
    std::vector<Navigation> states;
};

double distance(const Navigation& a, const Navigation& b) {
    return (a.p_WB_m - b.p_WB_m).norm() + (a.v_WB_m_s - b.v_WB_m_s).norm() +
           a.q_WB.angularDistance(b.q_WB);
}

Navigation perturbed(const Navigation& n, const ErrorVector& error) {
    Navigation out = n;
    out.p_WB_m += error.segment<3>(kPosition);
    out.v_WB_m_s += error.segment<3>(kVelocity);
    out.q_WB = n.q_WB * quaternion_from_rotation_vector(error.segment<3>(kAttitude));
    out.gyro_bias_rad_s += error.segment<3>(kGyroBias);
    out.accelerometer_bias_m_s2 += error.segment<3>(kAccelerometerBias);
    return out;
}

/// Worst difference between a Jacobian and what the innovation really does, each error 1e-4.
template <class Measure>
double jacobian_error(const Stretch& stretch, double age_s, Measure measure) {
    const Measurement base = measure(*instant(stretch.now, stretch.history, age_s));
    double worst = 0.0;
    for (int error = 0; error < kErrors; ++error) {
        constexpr double kStep = 1e-4;
        ErrorVector shift = ErrorVector::Zero();
        shift[error] = kStep;
        const Measurement moved =
            measure(*instant(perturbed(stretch.now, shift), stretch.history, age_s));
        for (int i = 0; i < base.rows; ++i) {
            const auto row = static_cast<std::size_t>(i);
            const double slope = (base.innovation[row] - moved.innovation[row]) / kStep;
            worst = std::max(worst, std::abs(slope - base.jacobian[row][error]));
        }
    }
    return worst;
}

TEST(Past, GoesBackToTheStatesThatWere) {
    const Stretch stretch;
    for (const int back : {0, 1, 5, 28, 40}) {
        const auto then = past(stretch.now, stretch.history, back * kDt_s);
        ASSERT_TRUE(then.has_value());
        EXPECT_LT(
            distance(*then,
                     stretch.states[stretch.states.size() - 1 - static_cast<std::size_t>(back)]),
            1e-10);
    }
}

TEST(Past, LiesBetweenSamples) {
    const Stretch stretch;
    const Navigation a = *past(stretch.now, stretch.history, 5.0 * kDt_s);
    const Navigation b = *past(stretch.now, stretch.history, 4.0 * kDt_s);
    const Navigation half = *past(stretch.now, stretch.history, 4.5 * kDt_s);
    EXPECT_LT((half.v_WB_m_s - 0.5 * (a.v_WB_m_s + b.v_WB_m_s)).norm(), 1e-3);
    EXPECT_NEAR(half.q_WB.angularDistance(a.q_WB), half.q_WB.angularDistance(b.q_WB), 1e-9);
}

TEST(Past, EndsWithTheHistory) {
    Stretch stretch;
    EXPECT_FALSE(past(stretch.now, stretch.history, 0.2).has_value());
    for (int i = 0; i < 1000; ++i) {
        remember(stretch.history, {.dt_s = kDt_s});
    }
    EXPECT_TRUE(past(stretch.now, stretch.history, 1.02).has_value());
    EXPECT_FALSE(past(stretch.now, stretch.history, 1.03).has_value());
}

TEST(Aiding, JacobiansOfThePresentAreExact) {
    const Stretch stretch;
    const Vector3 ones = Vector3::Ones();
    EXPECT_LT(jacobian_error(stretch, 0.0,
                             [&](const Instant& at) {
                                 return measure_position(at, ones, ones, {true, true, true});
                             }),
              1e-9);
    EXPECT_LT(jacobian_error(stretch, 0.0,
                             [&](const Instant& at) { return measure_velocity(at, ones, ones); }),
              1e-9);
    EXPECT_LT(jacobian_error(
                  stretch, 0.0,
                  [&](const Instant& at) { return measure_attitude(at, stretch.now.q_WB, 1.0); }),
              1e-4);
    const Vector3 field_W(0.2, 0.0, 0.4);
    EXPECT_LT(jacobian_error(stretch, 0.0,
                             [&](const Instant& at) {
                                 return measure_field(at, at.now.q_WB.conjugate() * field_W,
                                                      field_W, 1.0);
                             }),
              1.0);
}

/// What is left out is of second order in the age: at 20 ms g tau^2 / 2 = 2 mm per radian.
TEST(Aiding, JacobiansOfThePastAreOfFirstOrderInItsAge) {
    const Stretch stretch;
    const Vector3 ones = Vector3::Ones();
    const auto position = [&](const Instant& at) {
        return measure_position(at, ones, ones, {true, true, true});
    };
    EXPECT_LT(jacobian_error(stretch, 0.020, position), 0.004);
    const Quaternion seen = past(stretch.now, stretch.history, 0.020)->q_WB;
    EXPECT_LT(jacobian_error(stretch, 0.020,
                             [&](const Instant& at) { return measure_attitude(at, seen, 1.0); }),
              0.002);
    const auto velocity = [&](const Instant& at) { return measure_velocity(at, ones, ones); };
    EXPECT_LT(jacobian_error(stretch, 0.020, velocity), 0.01);
    EXPECT_LT(jacobian_error(stretch, 0.110, velocity), 0.15);
}

TEST(Aiding, OneOutlierIsRejectedALongSeriesIsBelieved) {
    Covariance covariance = 1e-4 * Covariance::Identity();
    Fusion fusion{.covariance = covariance};
    Aiding aiding;
    const Instant at;
    const auto send = [&](double stamp_s) {
        fuse(fusion, aiding,
             measure_position(at, {1.0, 0.0, 0.0}, Vector3::Constant(0.01), {true, true, true}),
             stamp_s, 5.0, kPosition);
    };
    send(10.0);
    EXPECT_EQ(fusion.correction, ErrorVector::Zero());
    EXPECT_EQ(aiding.rejected, 1);
    send(10.5);
    EXPECT_EQ(aiding.rejected, 2);
    EXPECT_EQ(fusion.correction, ErrorVector::Zero());
    send(11.01);
    EXPECT_EQ(aiding.rejected, 0);
    EXPECT_EQ(aiding.fused_s, 11.01);
    EXPECT_NEAR(fusion.correction[kPosition], 1.0, 1e-12);
    EXPECT_NEAR(covariance(kPosition, kPosition), 1e-4, 1e-12);
    EXPECT_NEAR(covariance(kVelocity, kVelocity), 1.0, 1e-12);
}

TEST(Aiding, AFieldThatIsLongRejectedOpensTheAttitude) {
    Covariance covariance = 1e-6 * Covariance::Identity();
    Fusion fusion{.covariance = covariance};
    Aiding aiding;
    const Instant at;
    const Measurement wrong = measure_field(at, {-0.2, 0.0, 0.4}, {0.2, 0.0, 0.4}, 0.005);
    fuse(fusion, aiding, wrong, 1.0, 3.0, kAttitude);
    EXPECT_EQ(covariance(kAttitude, kAttitude), 1e-6);
    fuse(fusion, aiding, wrong, 2.5, 3.0, kAttitude);
    EXPECT_NEAR(covariance(kAttitude + 2, kAttitude + 2), 0.25, 1e-12);
    EXPECT_EQ(fusion.correction, ErrorVector::Zero());
}

}  // namespace
}  // namespace limpet::autopilot
