// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/drift_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/random.hpp"

namespace limpet {
namespace {

/// A body that swings by a metre and rocks by 10 deg, with a biased IMU, seen 20 ms late.
struct Swinging {
    DriftWatch watch = {};
    double imu_Hz = 250.0, pose_Hz = 120.0;
    double bias_m_s2 = 0.2;
    Vector3 drift_m_s = Vector3::Zero();
    double drifts_from_s = 1e9;
    double noise_m = 0.0005;
    RandomStream random{1, 0, Stream::test};
    long imus = 0, poses = 0;

    static constexpr double kRate_rad_s = 4.0;
    static double tilt(double t_s) { return radians(10.0) * std::sin(3.0 * t_s); }
    static Quaternion q_WB(double t_s) { return quaternion_from_euler({.pitch_rad = tilt(t_s)}); }
    static Vector3 p_WB(double t_s) {
        return {std::sin(kRate_rad_s * t_s), 0.5 * std::cos(kRate_rad_s * t_s), -2.0};
    }
    static Vector3 a_WB(double t_s) {
        return -kRate_rad_s * kRate_rad_s * (p_WB(t_s) - Vector3(0.0, 0.0, -2.0));
    }
    [[nodiscard]] Sample<ImuReading> imu(double t_s) const {
        const Vector3 force_W = a_WB(t_s) - kGravity_m_s2 * Vector3::UnitZ();
        return {t_s,
                {.specific_force_B_m_s2 =
                     q_WB(t_s).conjugate() * force_W + Vector3(bias_m_s2, 0.0, bias_m_s2)}};
    }
    Sample<PoseReading> pose(double t_s) {
        const Vector3 drifted_m = std::max(0.0, t_s - drifts_from_s) * drift_m_s;
        return {t_s,
                {.p_WB_m = p_WB(t_s) + drifted_m + noise_m * random.normal3(), .q_WB = q_WB(t_s)}};
    }
    /// Up to this time.
    /// @param seen  is shown what each pose said
    template <class Seen>
    void flies(double until_s, const Seen& seen) {
        constexpr double kLate_s = 0.02;
        while (true) {
            const double imu_s = static_cast<double>(imus) / imu_Hz;
            const double pose_s = static_cast<double>(poses) / pose_Hz;
            if (std::min(imu_s, pose_s + kLate_s) > until_s) {
                return;
            }
            if (imu_s <= pose_s + kLate_s) {
                ++imus;
                watch.feel(imu(imu_s));
                watch.feel(imu(imu_s));
            } else {
                ++poses;
                seen(pose_s, watch.unfelt(pose(pose_s)));
            }
        }
    }
    /// @return the most that was not felt [m/s]; NaN: nothing was known
    double most(double until_s) {
        double most_m_s = std::nan("");
        flies(until_s, [&](double, const auto& unfelt) {
            most_m_s = unfelt ? std::fmax(most_m_s, unfelt->norm()) : most_m_s;
        });
        return most_m_s;
    }
};

TEST(DriftWatch, WhatIsFeltIsNoDrift) {
    for (const auto& [imu_Hz, pose_Hz] :
         {std::pair{250.0, 120.0}, {1000.0, 360.0}, {100.0, 50.0}, {250.0, 1000.0}}) {
        Swinging body{.imu_Hz = imu_Hz, .pose_Hz = pose_Hz};
        const double most_m_s = body.most(20.0);
        EXPECT_GT(most_m_s, 0.01) << "it is biased and noisy";
        EXPECT_LT(most_m_s, imu_Hz > 100.0 ? 0.1 : 0.2) << imu_Hz;
    }
}

TEST(DriftWatch, ADriftShowsItsSpeedOnceAndBegins) {
    for (const Vector3& drift_m_s : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, -0.6, 0.0)}) {
        Swinging body{.drift_m_s = drift_m_s, .drifts_from_s = 2.0};
        EXPECT_LT(body.most(2.0), 0.1);
        double seen_s = -1.0;
        Vector3 most_m_s = Vector3::Zero();
        body.flies(3.0, [&](double time_s, const auto& unfelt) {
            ASSERT_TRUE(unfelt);
            seen_s = seen_s < 0.0 && unfelt->norm() > 0.3 ? time_s : seen_s;
            most_m_s = unfelt->norm() > most_m_s.norm() ? *unfelt : most_m_s;
        });
        EXPECT_NEAR(seen_s, 2.0 + 0.15 * 0.3 / drift_m_s.norm(), 0.02);
        EXPECT_LT((most_m_s - drift_m_s).norm(), 0.1);
        EXPECT_LT(body.most(10.0), 0.1) << "it goes on, and is as good as a wind";
    }
}

TEST(DriftWatch, KnowsNothingAfterAGap) {
    const auto first_known_s = [](Swinging& body, double from_s) {
        double known_s = -1.0;
        body.flies(from_s + 2.0, [&](double time_s, const auto& unfelt) {
            known_s = known_s < 0.0 && unfelt ? time_s : known_s;
        });
        return known_s - from_s;
    };
    Swinging body;
    EXPECT_NEAR(first_known_s(body, 0.0), 0.3, 0.03);
    body.poses += 24;  // 0.2 s
    EXPECT_NEAR(first_known_s(body, 2.2), 0.3, 0.03);
    body.imus += 50;
    (void)body.most(4.35);
    EXPECT_NEAR(first_known_s(body, 4.4), 0.3, 0.03);
    body.watch.forget();
    EXPECT_NEAR(first_known_s(body, 6.4), 0.3, 0.03);

    DriftWatch no_imu;
    for (int k = 0; k < 100; ++k) {
        EXPECT_FALSE(no_imu.unfelt(body.pose(0.01 * k)));
    }
}

}  // namespace
}  // namespace limpet
