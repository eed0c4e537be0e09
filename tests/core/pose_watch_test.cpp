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
    Estimate estimate{.v_WB_m_s = {1.0, 0.0, 0.0}, .valid = true};
    Mover mover = Mover::rotors;

    [[nodiscard]] PoseReading pose() const { return {{time_s, 0.0, 0.0}, yaw(0.1 * time_s)}; }
    /// @return whether this pose is told
    bool sees(const PoseReading& told) {
        return watch.trusted({time_s, told}, estimate, mover).time_s == time_s;
    }
    bool sees() { return sees(pose()); }
    void goes_on() {
        time_s += kTick_s;
        estimate.time_s = time_s;
        estimate.p_WB_m.x() = time_s;
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
    w.estimate.v_WB_m_s.setZero();
    const PoseReading still = w.pose();
    for (int k = 0; k < 100; ++k) {
        EXPECT_TRUE(w.sees(still));
        w.time_s += kTick_s;
    }
}

/// It stands, turned by 45 deg, seen without noise: first its autopilot knows nothing, then it
/// finds out, then its motors run.
TEST(PoseWatch, HoldsNoAttitudeAgainstAPoseThatTheAutopilotHadYetToFind) {
    Watched w;
    w.mover = Mover::hand;
    w.estimate = {};
    const PoseReading stands = {{1.0, 2.0, 0.0}, yaw(radians(45.0))};
    const auto on = [&](double yaw_rad, bool valid) {
        w.time_s += kTick_s;
        w.estimate.time_s = w.time_s;
        w.estimate.p_WB_m = stands.p_WB_m;
        w.estimate.q_WB = yaw(yaw_rad);
        w.estimate.valid = valid;
        return w.sees(stands);
    };
    for (int k = 0; k < 100; ++k) {
        ASSERT_TRUE(on(0.0, false)) << k;
    }
    for (int k = 0; k <= 100; ++k) {
        ASSERT_TRUE(on(radians(40.0 + 0.05 * k), true)) << k;
    }
    w.mover = Mover::rotors;
    for (int k = 0; k < 100; ++k) {
        ASSERT_TRUE(on(radians(45.0), true)) << k;
    }
    EXPECT_TRUE(on(radians(45.9), true));
    EXPECT_FALSE(on(radians(46.1), true)) << "now it turns";
    EXPECT_EQ(w.watch.doubt(), PoseDoubt::repeats);
    w.mover = Mover::nothing;
    EXPECT_FALSE(on(radians(46.1), true)) << "the same pose still";
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

PoseReading moved(PoseReading pose, double ahead_m) {
    pose.p_WB_m.x() += ahead_m;
    return pose;
}

TEST(PoseWatch, WithholdsAJumpFromItsFirstFrameUntilItJumpsBack) {
    for (const double jump_m : {5.0, -5.0, 0.3}) {
        Watched w;
        for (int k = 0; k < 200; ++k, w.goes_on()) {
            ASSERT_TRUE(w.sees());
        }
        for (int k = 0; k < 1000; ++k, w.goes_on()) {
            ASSERT_FALSE(w.sees(moved(w.pose(), jump_m))) << jump_m << " m, frame " << k;
            ASSERT_EQ(w.watch.doubt(), PoseDoubt::jumped);
        }
        EXPECT_NEAR(w.watch.away_m(), std::abs(jump_m), 0.01);
        EXPECT_TRUE(w.sees()) << jump_m;
        EXPECT_EQ(w.watch.doubt(), PoseDoubt::none);
    }
}

/// Ten frames of a fifth of the limit each: no step alone shows it.
TEST(PoseWatch, WithholdsWhatCreepsAwayFromTheAutopilot) {
    Watched w;
    for (int k = 0; k < 200; ++k, w.goes_on()) {
        ASSERT_TRUE(w.sees());
    }
    int seen = 0;
    for (double off_m = 0.04; off_m < 0.41; off_m += 0.04, w.goes_on()) {
        seen += w.sees(moved(w.pose(), off_m)) ? 1 : 0;
    }
    EXPECT_LE(seen, 6);
    EXPECT_EQ(w.watch.doubt(), PoseDoubt::jumped);
}

TEST(PoseWatch, TakesAFrameThatLiesElsewhereAndAnAutopilotThatComesToIt) {
    Watched w;
    for (int k = 0; k < 200; ++k, w.goes_on()) {
        ASSERT_TRUE(w.sees(moved(w.pose(), 3.0))) << "always 3 m apart";
    }
    for (int k = 0; k < 200; ++k, w.goes_on()) {
        w.estimate.p_WB_m.x() += 3.0;  // its estimator was set anew
        ASSERT_TRUE(w.sees(moved(w.pose(), 3.0)));
    }
}

TEST(PoseWatch, AfterASilenceAllowsForWhatTheAutopilotMayHaveGoneAstray) {
    for (const double silent_s : {0.1, 1.0}) {
        Watched w;
        ASSERT_TRUE(w.sees());
        w.goes_on();
        ASSERT_TRUE(w.sees());
        w.time_s += silent_s;
        w.goes_on();
        EXPECT_EQ(w.sees(moved(w.pose(), 0.6)), silent_s == 1.0);
        EXPECT_FALSE(w.sees(moved(w.pose(), 5.0)) && silent_s < 1.0);
    }
}

/// What stands on its stand: the estimate follows the tracker, the gyros do not.
struct Standing : Watched {
    explicit Standing(Mover by = Mover::hand) {
        mover = by;
        estimate.v_WB_m_s.setZero();
        for (int k = 0; k < 200; ++k, on()) {
            EXPECT_TRUE(sees({}));
        }
    }
    void on() {
        time_s += kTick_s;
        estimate.time_s = time_s;
    }
    /// @return how far it went until it was withheld, < 0: never
    double drifts(double speed_m_s, double rate_rad_s = 0.0) {
        estimate.w_WB_B_rad_s.y() = rate_rad_s;
        estimate.v_WB_m_s.x() = speed_m_s;
        for (double way_m = 0.0; std::abs(way_m) < 3.0; way_m += speed_m_s * kTick_s, on()) {
            estimate.p_WB_m.x() = way_m;
            if (!sees(moved({}, way_m))) {
                return std::abs(way_m);
            }
        }
        return -1.0;
    }
};

TEST(PoseWatch, WithMotorsOffAPoseThatMovesAloneIsNone) {
    for (const Mover by : {Mover::hand, Mover::nothing}) {
        for (const double speed_m_s : {1.0, -1.0, 0.01}) {
            Standing w(by);
            EXPECT_NEAR(w.drifts(speed_m_s, 0.01), 0.1, 0.02) << speed_m_s;
            EXPECT_EQ(w.watch.doubt(), PoseDoubt::moves_alone);
            w.estimate.valid = false;  // the autopilot has no poses any more
            w.on();
            EXPECT_FALSE(w.sees(moved({}, 2.0)));
            w.on();
            EXPECT_TRUE(w.sees({})) << "back where it stood";
        }
    }
}

TEST(PoseWatch, WithMotorsOffAHandMayCarryIt) {
    Standing w;
    EXPECT_LT(w.drifts(1.0, 0.2), 0.0);
}

TEST(PoseWatch, AtRestOnTheWallNoHandIsBelievedIn) {
    Standing w(Mover::nothing);
    w.estimate.w_WB_B_rad_s.y() = 0.2;  // a gust rocks it
    for (int k = 0; k < 100; ++k, w.on()) {
        ASSERT_TRUE(w.sees(moved({}, 0.02 * (k % 2))));
    }
    EXPECT_FALSE(w.sees(moved({}, 5.0)));
    w.on();
    EXPECT_TRUE(w.sees({}));
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
