// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/within_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace limpet {
namespace {

struct Oscillator {
    double m_kg = 0.1, k_N_m = 2e4, c_N_s_m = 3.0;
    double x_m = 1e-3, v_m_s = 0.0;

    void step(double h_s) {
        const double mobility = h_s / m_kg;
        const StepForce<double> force =
            within_step(-k_N_m * x_m, k_N_m, c_N_s_m, v_m_s, mobility, h_s);
        v_m_s += mobility * force.now / (1.0 + mobility * force.gain);
        x_m += h_s * v_m_s;
    }
};

/// Of the position a while later; the first rate belongs to half a step before.
double error_m(double h_s) {
    constexpr double kLater_s = 0.02;
    Oscillator one;
    const double w = std::sqrt(one.k_N_m / one.m_kg);
    const double zeta = one.c_N_s_m / (2.0 * one.m_kg * w);
    const double wd = w * std::sqrt(1.0 - zeta * zeta);
    const auto x_m = [&](double t_s) {
        return 1e-3 * std::exp(-zeta * w * t_s) *
               (std::cos(wd * t_s) + zeta * w / wd * std::sin(wd * t_s));
    };
    one.v_m_s = (x_m(0.0) - x_m(-h_s)) / h_s;
    for (long k = 0; k < std::lround(kLater_s / h_s); ++k) {
        one.step(h_s);
    }
    return std::abs(one.x_m - x_m(kLater_s));
}

TEST(WithinStep, IsOfSecondOrder) {
    EXPECT_LT(error_m(2.5e-4), 0.02e-3);
    EXPECT_NEAR(error_m(2e-4) / error_m(1e-4), 4.0, 0.8);
}

TEST(WithinStep, NeverGainsWhateverStiffnessAndDamping) {
    constexpr double h_s = 1e-3;
    for (double k = 1.0; k < 1e10; k *= 7.0) {
        for (double c = 0.0; c < 1e7; c = c == 0.0 ? 1e-3 : c * 11.0) {
            Oscillator one{.k_N_m = k, .c_N_s_m = c};
            double early_m = 0.0, late_m = 0.0;
            for (int i = 0; i < 4000; ++i) {
                one.step(h_s);
                (i < 2000 ? early_m : late_m) =
                    std::max(i < 2000 ? early_m : late_m, std::abs(one.x_m));
            }
            EXPECT_LE(late_m, early_m * (1.0 + 1e-9)) << k << " N/m, " << c << " N s/m";
            EXPECT_LE(early_m, 1.1e-3) << k << " N/m, " << c << " N s/m";
        }
    }
}

TEST(WithinStep, WhatIsOverWithinAStepIsOver) {
    Oscillator stiff{.k_N_m = 1e9, .c_N_s_m = 0.0};
    Oscillator damped{.k_N_m = 0.0, .c_N_s_m = 1e5, .x_m = 0.0, .v_m_s = 1.0};
    for (int i = 0; i < 5; ++i) {
        stiff.step(1e-3);
        damped.step(1e-3);
    }
    EXPECT_LT(std::abs(stiff.x_m), 1e-7);
    EXPECT_LT(std::abs(damped.v_m_s), 1e-9);
}

TEST(WithinStep, OfWhatDoesNotMoveIsTheForceAsItStands) {
    const StepForce<double> force = within_step(-3.0, 2e4, 60.0, 0.1, 0.0, 1e-3);
    EXPECT_DOUBLE_EQ(force.now, -9.0);
}

}  // namespace
}  // namespace limpet
