// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/pose_watch.hpp"

#include <gtest/gtest.h>

namespace limpet {
namespace {

constexpr double kTick_s = 0.01;

Quaternion yaw(double yaw_rad) {
    return quaternion_from_euler({.yaw_rad = yaw_rad});
}

/// A body that turns at 0.1 rad/s, seen by an autopilot and by a tracker.
struct Watched {
    PoseWatch watch;
    double time_s = 0.0;
    Estimate estimate{.valid = true};

    [[nodiscard]] PoseReading pose() const { return {{time_s, 0.0, 0.0}, yaw(0.1 * time_s)}; }
    /// @return whether this pose is told
    bool sees(const PoseReading& told) {
        return watch.trusted({time_s, told}, estimate).time_s == time_s;
    }
    bool sees() { return sees(pose()); }
    void goes_on() {
        time_s += kTick_s;
        estimate.q_WB = yaw(0.1 * time_s);
    }
};

TEST(PoseWatch, KeepsBackATrackerThatRepeatsItselfOnceTheBodyHasTurned) {
    Watched w;
    ASSERT_TRUE(w.sees());
    const PoseReading last = w.pose();
    double withheld_s = -1.0;
    for (int k = 0; k < 100; ++k) {
        w.goes_on();
        if (!w.sees(last) && withheld_s < 0.0) {
            withheld_s = w.time_s;
        }
    }
    EXPECT_NEAR(withheld_s, radians(1.0) / 0.1, 2.0 * kTick_s);
    w.goes_on();
    EXPECT_TRUE(w.sees());
}

TEST(PoseWatch, LetsABodyAtRestBeSeenWithoutNoise) {
    Watched w;
    const PoseReading still = w.pose();
    for (int k = 0; k < 100; ++k) {
        EXPECT_TRUE(w.sees(still));
        w.time_s += kTick_s;
    }
}

TEST(PoseWatch, KeepsBackAnotherBodyForHalfAMinute) {
    Watched w;
    ASSERT_TRUE(w.sees());
    const auto other = [&w] {
        return PoseReading{w.pose().p_WB_m, w.estimate.q_WB * yaw(radians(40.0))};
    };
    for (w.goes_on(); w.time_s < 29.9; w.goes_on()) {
        ASSERT_FALSE(w.sees(other())) << w.time_s;
    }
    w.time_s = 30.1;
    EXPECT_TRUE(w.sees(other()));
}

TEST(PoseWatch, KnowsNothingAgainstAPoseWithoutAnEstimate) {
    Watched w;
    w.estimate.valid = false;
    for (int k = 0; k < 100; ++k) {
        EXPECT_TRUE(w.sees({Vector3::Zero(), yaw(k % 2 == 0 ? 0.0 : 2.0)}));
        w.goes_on();
    }
}

TEST(PoseWatch, BeginsAnewWithAClockThatDoes) {
    Watched w;
    w.time_s = 8.0;
    ASSERT_TRUE(w.sees());
    w.time_s = 0.0;
    EXPECT_TRUE(w.sees({Vector3::Zero(), yaw(2.0)}));
}

}  // namespace
}  // namespace limpet
