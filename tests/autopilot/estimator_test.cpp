// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/estimator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <optional>

#include "trajectory.hpp"

namespace limpet::autopilot {
namespace {

/// Flight and filter side by side.
struct Tracking {
    explicit Tracking(Motion motion, const AutopilotParameters& parameters_in = {},
                      const SensorNoise& noise = {})
        : parameters(parameters_in),
          flight(std::move(motion), noise, RandomStream(21, 0, Stream::test)) {
        Estimate known;
        known.p_WB_m = flight.truth.p_WF_m;
        known.v_WB_m_s = flight.truth.v_WF_W_m_s;
        known.q_WB = flight.truth.q_WF;
        state = start_estimator(parameters, known);
    }

    template <class Tamper>
    void go(double duration_s, Tamper tamper) {
        for (int i = 0; i < static_cast<int>(std::lround(duration_s / 0.004)); ++i) {
            flight.step();
            Readings readings = flight.readings;
            tamper(readings);
            update_estimator(parameters, state, readings);
        }
    }
    void go(double duration_s) {
        go(duration_s, [](Readings&) {});
    }

    [[nodiscard]] double error(int block) const {
        return flight.error(state).segment<3>(block).norm();
    }
    [[nodiscard]] bool valid() const { return estimate_from(parameters, state).valid; }

    AutopilotParameters parameters;
    SensedFlight flight;
    EstimatorState state;
};

double root_mean_square_position(Tracking& run, bool stamps_are_now) {
    double sum = 0.0;
    double last_s = -1.0;
    constexpr int kSteps = 2500;
    for (int i = 0; i < kSteps; ++i) {
        run.go(0.004, [&](Readings& readings) {
            if (stamps_are_now && readings.motion_capture.time_s > last_s) {
                last_s = readings.motion_capture.time_s;
                readings.motion_capture.time_s = readings.imu.time_s;
            } else if (stamps_are_now) {
                readings.motion_capture.time_s = run.state.seen.motion_capture_s;  // seen
            }
        });
        sum += std::pow(run.error(kPosition), 2) / kSteps;
    }
    return std::sqrt(sum);
}

TEST(Estimator, FollowsAFigureOfEight) {
    Tracking run(figure_of_eight);
    run.go(20.0);
    EXPECT_LT(run.error(kPosition), 0.002);
    EXPECT_LT(run.error(kVelocity), 0.03);
    EXPECT_LT(run.error(kAttitude), radians(0.2));
    EXPECT_TRUE(run.valid());
}

TEST(Estimator, LateStampsAreBetterThanIgnoringThem) {
    Tracking with_stamps(figure_of_eight);
    Tracking without(figure_of_eight);
    const double aware_m = root_mean_square_position(with_stamps, false);
    const double ignorant_m = root_mean_square_position(without, true);
    EXPECT_LT(aware_m, 0.001);
    EXPECT_GT(ignorant_m, 0.02);  // 1.5 m/s * 20 ms
}

/// The stamp told wrong by 20 ms and EKF2_EV_DELAY told of it: as good as true stamps.
TEST(Estimator, DelayParameterMakesUpForWrongStamps) {
    AutopilotParameters parameters;
    parameters.EKF2_EV_DELAY = 20.0;
    Tracking run(figure_of_eight, parameters);
    double worst_m = 0.0;
    for (int i = 0; i < 1000; ++i) {
        run.go(0.004, [](Readings& readings) { readings.motion_capture.time_s += 0.02; });
        worst_m = std::max(worst_m, run.error(kPosition));
    }
    EXPECT_LT(worst_m, 0.003);
}

TEST(Estimator, BiasesConverge) {
    Tracking run(figure_of_eight);
    run.flight.gyro_bias_rad_s = {0.02, -0.015, 0.01};
    run.flight.accelerometer_bias_m_s2 = {0.2, -0.15, 0.3};
    run.go(15.0);
    EXPECT_LT(run.error(kGyroBias), 0.002);
    EXPECT_LT(run.error(kAccelerometerBias), 0.05);
}

TEST(Estimator, OutliersAreRejected) {
    Tracking clean(figure_of_eight);
    Tracking dirty(figure_of_eight);
    clean.go(5.0);
    dirty.go(5.0);
    int sent = 0;
    for (int i = 0; i < 250; ++i) {
        clean.go(0.004);
        dirty.go(0.004, [&](Readings& readings) {
            if (readings.motion_capture.time_s > dirty.state.seen.motion_capture_s &&
                ++sent % 10 == 0) {
                readings.motion_capture.value.p_WB_m += Vector3(0.3, -0.2, 0.1);
                readings.motion_capture.value.q_WB =
                    readings.motion_capture.value.q_WB *
                    quaternion_from_rotation_vector(Vector3(0.0, 0.3, 0.0));
            }
        });
        EXPECT_LT(dirty.error(kPosition), 0.003);
        EXPECT_LT(dirty.error(kAttitude), radians(0.5));
    }
    EXPECT_GE(sent, 100);
}

TEST(Estimator, ALastingJumpIsBelievedAfterASecond) {
    Tracking run(hanging(0.0));
    run.go(3.0);
    const auto shifted = [](Readings& readings) {
        readings.motion_capture.value.p_WB_m += Vector3(2.0, 0.0, 0.0);
        readings.motion_capture.value.q_WB =
            quaternion_from_rotation_vector(Vector3(0.0, 0.0, 0.4)) *
            readings.motion_capture.value.q_WB;
    };
    run.go(0.4, shifted);
    EXPECT_LT(run.error(kPosition), 0.1);
    run.go(0.5, shifted);
    EXPECT_FALSE(run.valid());
    run.go(0.5, shifted);
    EXPECT_TRUE(run.valid());
    EXPECT_NEAR(run.state.navigation.p_WB_m.x(), 2.0, 0.01);
    EXPECT_NEAR(euler_from_quaternion(run.state.navigation.q_WB).yaw_rad, 0.7, 0.01);
}

/// As after a blow that the accelerometer could not measure.
TEST(Estimator, AVelocityFarOffIsFoundAgain) {
    for (const double off_m_s : {1.5, 6.0, 20.0}) {
        Tracking run(hanging(0.0));
        run.go(3.0);
        run.state.navigation.v_WB_m_s += Vector3(0.0, off_m_s, 0.0);
        run.go(2.0);
        EXPECT_TRUE(run.valid()) << off_m_s;
        EXPECT_LT(run.error(kVelocity), 0.1) << off_m_s;
        EXPECT_LT(run.error(kPosition), 0.02) << off_m_s;
    }
}

TEST(Estimator, AnotherBodyIsNotBelievedHoweverLongItIsSeen) {
    Tracking run(hanging(0.0));
    run.go(3.0);
    const auto turned = [](Readings& readings) {
        readings.motion_capture.value.p_WB_m += Vector3(0.3, 0.0, 0.0);
        readings.motion_capture.value.q_WB =
            quaternion_from_rotation_vector(Vector3(0.0, 0.0, 1.0)) *
            readings.motion_capture.value.q_WB;
    };
    run.go(4.0, turned);
    EXPECT_FALSE(run.valid());
    EXPECT_LT(run.error(kAttitude), 0.1);
    run.go(0.5);
    EXPECT_TRUE(run.valid());
}

TEST(Estimator, APoseThatIsRepeatedAidsNothingWhileTheBodyTurns) {
    for (const bool turns : {true, false}) {
        Tracking run(turns ? Motion(figure_of_eight) : hanging(0.0));
        run.go(3.0);
        std::optional<PoseReading> last;
        const auto frozen = [&last](Readings& readings) {
            last = last.value_or(readings.motion_capture.value);
            readings.motion_capture.value = *last;
        };
        run.go(1.5, frozen);
        EXPECT_EQ(run.valid(), !turns);
        run.go(0.5);
        EXPECT_TRUE(run.valid());
    }
}

TEST(Estimator, LostMotionCaptureMakesInvalidAndComesBack) {
    Tracking run(hanging(0.0));
    run.go(2.0);
    EXPECT_TRUE(run.valid());
    const auto lost = [stamp = run.flight.readings.motion_capture](Readings& readings) {
        readings.motion_capture = stamp;
    };
    run.go(0.4, lost);
    EXPECT_TRUE(run.valid());
    run.go(0.2, lost);
    EXPECT_FALSE(run.valid());
    run.go(0.2);
    EXPECT_TRUE(run.valid());
}

TEST(Estimator, WithoutAnySampleTheStartDoesNotStayValid) {
    Tracking run(hanging(0.0));
    EXPECT_TRUE(run.valid());
    run.go(1.0, [](Readings& readings) { readings.motion_capture = {}; });
    EXPECT_FALSE(run.valid());
}

TEST(Estimator, SamplesThatAreNotNumbersAreIgnored) {
    Tracking run(figure_of_eight);
    run.go(1.0);
    run.go(2.0, [i = 0](Readings& readings) mutable {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        ++i;
        if (i % 50 == 0) {
            readings.imu.value.rate_B_rad_s.x() = nan;
        }
        if (i % 7 == 0) {
            readings.motion_capture.value.p_WB_m.y() = nan;
        }
    });
    EXPECT_TRUE(run.state.covariance.allFinite());
    EXPECT_LT(run.error(kPosition), 0.01);
}

TEST(Estimator, ASampleSeenTwiceCountsOnce) {
    Tracking run(hanging(0.0));
    run.go(1.0);
    EstimatorState again = run.state;
    update_estimator(run.parameters, again, run.flight.readings);
    EXPECT_EQ(again.covariance, run.state.covariance);
    EXPECT_EQ(again.navigation.p_WB_m, run.state.navigation.p_WB_m);
}

TEST(Estimator, CovarianceStaysPositiveAndSymmetric) {
    Tracking run(figure_of_eight);
    run.go(120.0);
    EXPECT_EQ(run.state.covariance, Covariance(run.state.covariance.transpose()));
    const Eigen::SelfAdjointEigenSolver<Covariance> solver(run.state.covariance);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
    EXPECT_NEAR(run.state.navigation.q_WB.norm(), 1.0, 1e-12);
}

TEST(Estimator, HangingSteeplyIsLikeAnyOtherAttitude) {
    for (const double pitch_deg : {66.5, 85.0, 90.0}) {
        Tracking run(hanging(radians(pitch_deg)));
        run.flight.gyro_bias_rad_s = {0.005, -0.005, 0.005};
        run.go(20.0);
        EXPECT_LT(run.error(kPosition), 0.002) << pitch_deg;
        EXPECT_LT(run.error(kAttitude), radians(0.15)) << pitch_deg;
        EXPECT_LT(run.error(kGyroBias), 0.002) << pitch_deg;
        EXPECT_TRUE(run.valid()) << pitch_deg;
    }
}

TEST(Estimator, HangsSteeplyOnGpsAndMagnetometerToo) {
    const SensorNoise noise;
    Tracking run(hanging(radians(85.0)), matched_to_without_motion_capture(noise), noise);
    run.go(30.0);
    EXPECT_LT(run.error(kAttitude), radians(2.0));
    EXPECT_LT(run.error(kPosition), 1.0);
    EXPECT_TRUE(run.valid());
}

TEST(Estimator, AttitudeComesFromFarOff) {
    Tracking run(figure_of_eight);
    run.state.navigation.q_WB =
        run.state.navigation.q_WB * quaternion_from_rotation_vector(Vector3(0.1, -0.2, 0.15));
    run.state.covariance_from = run.state.navigation;
    run.go(1.0);
    EXPECT_LT(run.error(kAttitude), radians(0.3));
}

}  // namespace
}  // namespace limpet::autopilot
