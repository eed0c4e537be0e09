// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/rate_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "defaults.hpp"

namespace limpet::autopilot {
namespace {

/// Amplitude of a filtered sine once it has settled.
double gain_at(double frequency_Hz, double cutoff_Hz) {
    LowPass filter;
    double largest = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double phase = 2.0 * kPi * frequency_Hz * kDt_s * i;
        const Vector3 out = low_pass(filter, Vector3(std::sin(phase), 0, 0), cutoff_Hz, kDt_s);
        if (i > 2500) {
            largest = std::max(largest, out.x());
        }
    }
    return largest;
}

TEST(LowPass, IsASecondOrderButterworth) {
    EXPECT_NEAR(gain_at(1.0, 30.0), 1.0, 1e-3);
    EXPECT_NEAR(gain_at(30.0, 30.0), std::sqrt(0.5), 0.01);
    // bilinear: tan(pi f T) stands for the analogue frequency
    const double ratio = std::tan(kPi * 90.0 * kDt_s) / std::tan(kPi * 30.0 * kDt_s);
    EXPECT_NEAR(gain_at(90.0, 30.0), 1.0 / std::sqrt(1.0 + std::pow(ratio, 4)), 0.01);
}

TEST(LowPass, ConstantStaysWhenTheIntervalChanges) {
    LowPass filter;
    reset(filter, Vector3(1, 2, 3));
    for (const double dt_s : {0.004, 0.004, 0.001, 0.005, 0.004}) {
        EXPECT_TRUE(
            low_pass(filter, Vector3(1, 2, 3), 30.0, dt_s).isApprox(Vector3(1, 2, 3), 1e-12));
    }
}

TEST(LowPass, WithoutCutoffPassesEverything) {
    LowPass filter;
    EXPECT_EQ(low_pass(filter, Vector3(1, 2, 3), 0.0, kDt_s), Vector3(1, 2, 3));
}

RateControlState resting() {
    RateControlState state;
    filter_rates(kDefaults, state, Vector3::Zero(), kDt_s);
    return state;
}

TEST(RateControl, ProportionalAndIntegral) {
    RateControlState state = resting();
    const Vector3 target(0.5, -0.4, 0.3);
    const Vector3 first = rate_control(kDefaults, state, target, {}, false, kDt_s);
    EXPECT_TRUE(first.isApprox(Vector3(0.075, -0.06, 0.06), 1e-12));
    for (int i = 1; i < 250; ++i) {
        static_cast<void>(rate_control(kDefaults, state, target, {}, false, kDt_s));
    }
    const double factor = 1.0 - std::pow(0.5 / radians(400.0), 2);
    EXPECT_NEAR(state.integral.x(), 0.2 * 0.5 * factor, 1e-12);  // one second
}

TEST(RateControl, DampsAngularAcceleration) {
    RateControlState state = resting();
    for (int i = 1; i <= 200; ++i) {
        filter_rates(kDefaults, state, Vector3(2.0 * kDt_s * i, 0.0, 0.0), kDt_s);
    }
    EXPECT_NEAR(state.acceleration_rad_s2.x(), 2.0, 1e-6);
    const Vector3 torque = rate_control(kDefaults, state, state.rate_rad_s, {}, true, kDt_s);
    EXPECT_NEAR(torque.x(), -0.003 * 2.0, 1e-8);
}

TEST(RateControl, IntegralStopsAtItsLimit) {
    RateControlState state = resting();
    for (int i = 0; i < 2500; ++i) {
        static_cast<void>(rate_control(kDefaults, state, Vector3(1, -1, 1), {}, false, kDt_s));
    }
    EXPECT_TRUE(state.integral.isApprox(Vector3(0.3, -0.3, 0.3), 1e-12));
}

TEST(RateControl, AFlipIsNotIntegrated) {
    RateControlState state = resting();
    static_cast<void>(
        rate_control(kDefaults, state, Vector3(radians(401.0), 0, 0), {}, false, kDt_s));
    EXPECT_EQ(state.integral.x(), 0.0);
}

TEST(RateControl, SaturationStopsOnlyItsOwnDirection) {
    Saturation saturation;
    saturation.positive = {true, true, false};
    RateControlState state = resting();
    static_cast<void>(
        rate_control(kDefaults, state, Vector3(0.5, -0.5, 0.5), saturation, false, kDt_s));
    EXPECT_EQ(state.integral.x(), 0.0);
    EXPECT_LT(state.integral.y(), 0.0);
    EXPECT_GT(state.integral.z(), 0.0);
}

TEST(RateControl, HeldIntegralKeepsItsValue) {
    RateControlState state = resting();
    state.integral = Vector3(0.1, 0.0, -0.1);
    static_cast<void>(rate_control(kDefaults, state, Vector3(1, 1, 1), {}, true, kDt_s));
    EXPECT_EQ(state.integral, Vector3(0.1, 0.0, -0.1));
}

}  // namespace
}  // namespace limpet::autopilot
