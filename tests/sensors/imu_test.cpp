// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limpet/sensors/sensor.hpp"
#include "tests/sensors/bench_room.hpp"

namespace limpet::sensors {
namespace {

using test::at_rest;
using test::quiet;
using test::statistics;

struct ImuLog {
    std::vector<ImuReading> samples;
    std::vector<double> times_s;
};

template <class TruthAt>
ImuLog run_imu(const SensorParameters& parameters, Tick ticks, TruthAt truth_at,
               std::uint32_t number = 0) {
    auto unit =
        start_unit<ImuSensor>(parameters, RandomStream(7, number, Stream::imu), truth_at(0));
    const SensorMounts mounts;
    Sample<ImuReading> reading;
    ImuLog log;
    for (Tick tick = 0; tick < ticks; ++tick) {
        const double last_s = reading.time_s;
        const Truth truth = truth_at(tick);
        sense(parameters, unit, {.truth = truth, .mounts = mounts}, tick, reading);
        if (reading.time_s > last_s) {
            log.samples.push_back(reading.value);
            log.times_s.push_back(reading.time_s);
        }
    }
    return log;
}

TEST(Imu, AtRestMeasuresMinusGravityAndNoRate) {
    const auto truth_at = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.q_WF = quaternion_from_euler({.roll_rad = 0.0, .pitch_rad = radians(30.0)});
        return truth;
    };
    const ImuLog log = run_imu(quiet(), 1000, truth_at);
    EXPECT_EQ(log.samples.size(), 250U);
    for (const ImuReading& sample : log.samples) {
        // nose up by 30 deg: the support pushes along +x by half of g and up along z
        EXPECT_NEAR(sample.specific_force_B_m_s2.x(), 0.5 * kGravity_m_s2, 1e-12);
        EXPECT_NEAR(sample.specific_force_B_m_s2.z(), -std::sqrt(0.75) * kGravity_m_s2, 1e-12);
        EXPECT_NEAR(sample.rate_B_rad_s.norm(), 0.0, 1e-12);
    }
}

TEST(Imu, FreeFallMeasuresNothing) {
    const auto truth_at = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.v_WF_W_m_s = {1.0, -2.0, kGravity_m_s2 * truth.time_s};
        return truth;
    };
    const ImuLog log = run_imu(quiet(), 1000, truth_at);
    for (std::size_t i = 1; i < log.samples.size(); ++i) {
        EXPECT_NEAR(log.samples[i].specific_force_B_m_s2.norm(), 0.0, 1e-10);
    }
}

TEST(Imu, ConstantSpinIsMeasuredExactly) {
    const auto truth_at = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.w_WF_F_rad_s = {0.0, 0.0, 3.0};
        truth.base.q_WF = quaternion_from_rotation_vector({0.0, 0.0, 3.0 * truth.time_s});
        return truth;
    };
    // through several turns: the attitude's jump from +pi to -pi must not show
    const ImuLog log = run_imu(quiet(), 10000, truth_at);
    for (const ImuReading& sample : log.samples) {
        EXPECT_NEAR(sample.rate_B_rad_s.z(), 3.0, 1e-10);
        EXPECT_NEAR(sample.rate_B_rad_s.head<2>().norm(), 0.0, 1e-12);
    }
}

TEST(Imu, StrapdownIntegrationGivesTheMotionBack) {
    // wild motion: turning on all axes while accelerating
    const auto truth_at = [](Tick tick) {
        Truth truth = at_rest(tick);
        const double t = truth.time_s;
        truth.base.v_WF_W_m_s = {std::sin(7.0 * t), 0.5 * std::cos(5.0 * t), 2.0 * t * t};
        truth.base.q_WF = quaternion_from_euler({.roll_rad = 0.5 * std::sin(6.0 * t),
                                                 .pitch_rad = 0.8 * std::sin(4.0 * t),
                                                 .yaw_rad = 2.0 * t});
        return truth;
    };
    const ImuLog log = run_imu(quiet(), 1001, truth_at);
    Quaternion q_WB = truth_at(0).base.q_WF;
    Vector3 v_W_m_s = truth_at(0).base.v_WF_W_m_s;
    for (std::size_t i = 1; i < log.samples.size(); ++i) {
        const double dt_s = log.times_s[i] - log.times_s[i - 1];
        const Vector3 turn_rad = log.samples[i].rate_B_rad_s * dt_s;
        const Quaternion q_middle = q_WB * quaternion_from_rotation_vector(0.5 * turn_rad);
        v_W_m_s += dt_s * (q_middle * log.samples[i].specific_force_B_m_s2 +
                           Vector3(0.0, 0.0, kGravity_m_s2));
        q_WB = q_WB * quaternion_from_rotation_vector(turn_rad);
    }
    const Kinematics last = truth_at(1000).base;
    EXPECT_NEAR((v_W_m_s - last.v_WF_W_m_s).norm(), 0.0, 1e-10);
    EXPECT_NEAR(q_WB.angularDistance(last.q_WF), 0.0, 1e-7);
}

TEST(Imu, MeanOfAnIntervalApproachesTheTruthWithItsSquare) {
    // at the middle of the interval the analytic specific force is known
    const auto worst = [](int rate_Hz) {
        SensorParameters parameters = quiet();
        parameters.imu_rate_Hz = rate_Hz;
        const auto truth_at = [](Tick tick) {
            Truth truth = at_rest(tick);
            const double t = truth.time_s;
            truth.base.v_WF_W_m_s = {std::sin(8.0 * t), 0.0, 0.0};
            truth.base.q_WF = quaternion_from_rotation_vector({0.0, 0.0, std::sin(5.0 * t)});
            return truth;
        };
        const ImuLog log = run_imu(parameters, 1000, truth_at);
        double error = 0.0;
        for (std::size_t i = 1; i < log.samples.size(); ++i) {
            const double t = 0.5 * (log.times_s[i] + log.times_s[i - 1]);
            const double a_m_s2 = 8.0 * std::cos(8.0 * t);
            const double yaw_rad = std::sin(5.0 * t);
            const Vector3 exact(a_m_s2 * std::cos(yaw_rad), -a_m_s2 * std::sin(yaw_rad),
                                -kGravity_m_s2);
            error = std::max(error, (log.samples[i].specific_force_B_m_s2 - exact).norm());
        }
        return error;
    };
    EXPECT_NEAR(worst(125.0) / worst(250.0), 4.0, 0.2);
}

TEST(Imu, WhiteNoiseHasItsDensityAtAnyRate) {
    for (const int rate_Hz : {250, 1000}) {
        SensorParameters parameters = quiet();
        parameters.imu_rate_Hz = rate_Hz;
        parameters.gyro_noise_density_rad_s_rtHz = 3.39e-4;
        parameters.accel_noise_density_m_s2_rtHz = 4e-3;
        const ImuLog log = run_imu(parameters, 100000, at_rest);
        std::vector<double> rate;
        std::vector<double> force;
        for (const ImuReading& sample : log.samples) {
            rate.push_back(sample.rate_B_rad_s.y());
            force.push_back(sample.specific_force_B_m_s2.z() + kGravity_m_s2);
        }
        // the deviation of n samples scatters by 1 / sqrt(2 n): 0.45 % at 25000
        EXPECT_NEAR(statistics(rate).deviation, 3.39e-4 * std::sqrt(rate_Hz), 0.02 * 5.4e-3);
        EXPECT_NEAR(statistics(force).deviation / (4e-3 * std::sqrt(rate_Hz)), 1.0, 0.02);
    }
}

TEST(Imu, AllanDeviationOfWhiteNoiseFallsWithTheRootOfTheTime) {
    SensorParameters parameters = quiet();
    parameters.gyro_noise_density_rad_s_rtHz = 3.39e-4;
    const ImuLog log = run_imu(parameters, 400000, at_rest);
    for (const std::size_t cluster : {1U, 10U, 100U}) {
        std::vector<double> means;
        for (std::size_t i = 0; i + cluster <= log.samples.size(); i += cluster) {
            double sum = 0.0;
            for (std::size_t k = 0; k < cluster; ++k) {
                sum += log.samples[i + k].rate_B_rad_s.x();
            }
            means.push_back(sum / static_cast<double>(cluster));
        }
        double variance = 0.0;
        for (std::size_t i = 1; i < means.size(); ++i) {
            variance += 0.5 * std::pow(means[i] - means[i - 1], 2);
        }
        variance /= static_cast<double>(means.size() - 1);
        const double tau_s = static_cast<double>(cluster) / 250.0;
        EXPECT_NEAR(std::sqrt(variance * tau_s), 3.39e-4, 0.12 * 3.39e-4) << tau_s;
    }
}

TEST(Imu, BiasWalksWithTheRootOfTheTime) {
    SensorParameters parameters = quiet();
    parameters.gyro_bias_walk_rad_s2_rtHz = 1e-3;
    parameters.gyro_bias_tau_s = 1e9;
    std::vector<double> at_one_s;
    std::vector<double> at_four_s;
    for (std::uint32_t number = 0; number < 300; ++number) {
        const ImuLog log = run_imu(parameters, 4001, at_rest, number);
        for (int axis = 0; axis < 3; ++axis) {
            at_one_s.push_back(log.samples[250].rate_B_rad_s[axis]);
            at_four_s.push_back(log.samples[1000].rate_B_rad_s[axis]);
        }
    }
    // 900 values: the deviation scatters by 2.4 %
    EXPECT_NEAR(statistics(at_one_s).deviation, 1e-3, 0.1e-3);
    EXPECT_NEAR(statistics(at_four_s).deviation, 2e-3, 0.2e-3);
}

TEST(Imu, BiasOfAShortMemorySettles) {
    SensorParameters parameters = quiet();
    parameters.accel_bias_walk_m_s3_rtHz = 0.02;
    parameters.accel_bias_tau_s = 1.0;
    const ImuLog log = run_imu(parameters, 2000000, at_rest);
    std::vector<double> bias;
    for (std::size_t i = 2500; i < log.samples.size(); ++i) {
        bias.push_back(log.samples[i].specific_force_B_m_s2.x());
    }
    // walk * sqrt(tau / 2); 2000 s hold about a thousand independent values
    EXPECT_NEAR(statistics(bias).deviation, 0.02 * std::sqrt(0.5), 0.1 * 0.0141);
}

TEST(Imu, GaussMarkovStepsCompose) {
    const GaussMarkov whole = gauss_markov(0.3, 2.0, 0.5);
    const GaussMarkov half = gauss_markov(0.3, 2.0, 0.25);
    EXPECT_NEAR(whole.keep, half.keep * half.keep, 1e-15);
    EXPECT_NEAR(whole.kick * whole.kick, half.kick * half.kick * (1.0 + half.keep * half.keep),
                1e-15);
}

TEST(Imu, TurnOnBiasStaysForAFlightAndDiffersBetweenFlights) {
    SensorParameters parameters = quiet();
    parameters.gyro_turn_on_bias_rad_s = 1e-2;
    std::vector<double> biases;
    for (std::uint32_t number = 0; number < 300; ++number) {
        const ImuLog log = run_imu(parameters, 100, at_rest, number);
        EXPECT_EQ(log.samples.front().rate_B_rad_s, log.samples.back().rate_B_rad_s);
        for (int axis = 0; axis < 3; ++axis) {
            biases.push_back(log.samples.front().rate_B_rad_s[axis]);
        }
    }
    EXPECT_NEAR(statistics(biases).mean, 0.0, 2e-3);
    EXPECT_NEAR(statistics(biases).deviation, 1e-2, 1e-3);
}

TEST(Imu, SaturatesAtItsRange) {
    const auto truth_at = [](Tick tick) {
        Truth truth = at_rest(tick);
        truth.base.v_WF_W_m_s = {1e4 * truth.time_s, 0.0, 0.0};
        truth.base.q_WF = quaternion_from_rotation_vector({0.0, 0.0, -100.0 * truth.time_s});
        return truth;
    };
    const ImuLog log = run_imu(quiet(), 5, truth_at);
    EXPECT_DOUBLE_EQ(log.samples[1].rate_B_rad_s.z(), -17.45);
    EXPECT_DOUBLE_EQ(log.samples[1].specific_force_B_m_s2.x(), 176.5);
}

}  // namespace
}  // namespace limpet::sensors
