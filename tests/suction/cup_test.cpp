// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/cup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "surfaces.hpp"

namespace limpet::suction {
namespace {

/// A cup that is moved by hand in front of a wall at the origin, facing north.
class CupOnTheWall : public testing::Test {
protected:
    CupOnTheWall() {
        surface_.seal_threshold_sigma = 0.0;  // 31.5 N, always
        state_.random = RandomStream(1, 0, Stream::seal);
    }

    void hold(double depth_m, double press_N, double duration_s) {
        cup_.p_WF_m.x() = depth_m;
        input_.press_N = press_N;
        for (double elapsed_s = 0.0; elapsed_s < duration_s - 1e-9; elapsed_s += kStep_s) {
            const CupOutput output = step(model_, state_, surface_, cup_, input_, kStep_s);
            input_.time_s += kStep_s;
            if (output.event) {
                events_.push_back(*output.event);
            }
        }
    }
    [[nodiscard]] CupPhase phase() const { return state_.status.phase; }

    static constexpr double kStep_s = 1e-3;
    CupModel model_;
    CupState state_;
    Surface surface_;
    Kinematics cup_;
    CupInput input_{.pump_on = true};
    std::vector<Event> events_;
};

TEST_F(CupOnTheWall, AttachesAfterThresholdAndDwell) {
    hold(0.001, 40.0, 0.149);
    EXPECT_EQ(phase(), CupPhase::sealing);
    EXPECT_TRUE(events_.empty());
    hold(0.001, 40.0, 0.005);  // 0.151 s to 880 hPa, facts.md
    EXPECT_EQ(phase(), CupPhase::attached);
    ASSERT_EQ(events_.size(), 1U);
    EXPECT_EQ(events_[0].name, EventName::attached);
    EXPECT_NEAR(events_[0].time_s, 0.151, 2e-3);
}

TEST_F(CupOnTheWall, TooWeakATouchNeverSeals) {
    hold(0.001, 31.0, 5.0);
    EXPECT_EQ(phase(), CupPhase::touching);
    EXPECT_NEAR(state_.mean_pressure_Pa, kAtmosphere_Pa, 1e-6);
}

TEST_F(CupOnTheWall, TooShortATouchIsLostAndVents) {
    hold(0.001, 40.0, 0.1);
    hold(-0.02, 0.0, 0.1);
    EXPECT_EQ(phase(), CupPhase::free);
    ASSERT_EQ(events_.size(), 1U);
    EXPECT_EQ(events_[0].name, EventName::contact_lost);
    EXPECT_NEAR(state_.mean_pressure_Pa, kAtmosphere_Pa, 20.0);
}

TEST_F(CupOnTheWall, WithoutThePumpNothingSeals) {
    input_.pump_on = false;
    hold(0.001, 60.0, 1.0);
    EXPECT_EQ(phase(), CupPhase::touching);
}

TEST_F(CupOnTheWall, TiltedBeyondItsLimitItDoesNotSeal) {
    surface_.seal_tilt_sigma_deg = 0.0;
    cup_.q_WF = quaternion_from_euler({.pitch_rad = radians(surface_.seal_tilt_median_deg + 1.0)});
    hold(0.001, 60.0, 1.0);
    EXPECT_EQ(phase(), CupPhase::touching);
}

TEST_F(CupOnTheWall, ReleasesAlongEquationSixAndReportsDetached) {
    hold(0.001, 40.0, 3.0);
    input_.pump_on = false;
    const double start_Pa = state_.mean_pressure_Pa;
    hold(0.001, 0.0, 0.4);
    EXPECT_EQ(phase(), CupPhase::unsealing);
    EXPECT_NEAR(state_.mean_pressure_Pa,
                kAtmosphere_Pa - (kAtmosphere_Pa - start_Pa) * std::exp(-1.0), 1.0);
    hold(-0.01, 0.0, 0.001);
    ASSERT_EQ(events_.size(), 2U);
    EXPECT_EQ(events_[1].name, EventName::detached);
}

TEST_F(CupOnTheWall, APumpThatRunsOnHoldsTheVacuumSoLong) {
    model_.parameters.pump_runs_on_s = 2.0;
    hold(0.001, 40.0, 3.0);
    const double held_Pa = state_.mean_pressure_Pa;
    input_.pump_on = false;
    hold(0.001, 0.0, 1.99);
    EXPECT_EQ(phase(), CupPhase::attached);
    EXPECT_TRUE(state_.status.pump_running);
    EXPECT_NEAR(state_.mean_pressure_Pa, held_Pa, 50.0);
    hold(0.001, 0.0, 0.41);
    EXPECT_EQ(phase(), CupPhase::unsealing);
    EXPECT_FALSE(state_.status.pump_running);
    EXPECT_NEAR(kAtmosphere_Pa - state_.mean_pressure_Pa,
                (kAtmosphere_Pa - held_Pa) * std::exp(-1.0), 0.02 * (kAtmosphere_Pa - held_Pa));
}

TEST_F(CupOnTheWall, PumpOnAgainSealsAgain) {
    hold(0.001, 40.0, 3.0);
    input_.pump_on = false;
    hold(0.001, 0.0, 0.2);
    input_.pump_on = true;
    hold(0.001, 0.0, 1.0);
    EXPECT_EQ(phase(), CupPhase::attached);
}

TEST_F(CupOnTheWall, TornOffWhileAttachedItIsContactLost) {
    hold(0.001, 40.0, 1.0);
    hold(-0.05, 0.0, 0.001);
    ASSERT_EQ(events_.size(), 2U);
    EXPECT_EQ(events_[1].name, EventName::contact_lost);
    EXPECT_EQ(events_[1].reason, "pulled off");
}

TEST_F(CupOnTheWall, OnMetalThePumpRestsAndTheVacuumStays) {
    surface_ = surface_of(kTableTwo[3]);
    surface_.pump_cycles = true;
    hold(0.001, 60.0, 5.0);
    int running = 0;
    for (int k = 0; k < 10000; ++k) {
        hold(0.001, 60.0, kStep_s);
        running += state_.status.pump_running ? 1 : 0;
        ASSERT_LT(state_.mean_pressure_Pa,
                  27500.0 + model_.parameters.pressure.pump_restart_band_Pa + 10.0);
    }
    EXPECT_GT(running, 0);
    EXPECT_LT(running, 9000);
}

TEST_F(CupOnTheWall, OnConcreteThePumpRunsAndRipples) {
    hold(0.001, 60.0, 3.0);
    double lowest_Pa = 1e6;
    double highest_Pa = 0.0;
    for (int k = 0; k < 1000; ++k) {
        hold(0.001, 60.0, kStep_s);
        ASSERT_TRUE(state_.status.pump_running);
        lowest_Pa = std::min(lowest_Pa, state_.status.pressure_Pa);
        highest_Pa = std::max(highest_Pa, state_.status.pressure_Pa);
    }
    EXPECT_NEAR(0.5 * (highest_Pa - lowest_Pa), surface_.pump_ripple_Pa,
                0.05 * surface_.pump_ripple_Pa);
}

TEST_F(CupOnTheWall, EveryTouchDrawsItsOwnThreshold) {
    surface_.seal_threshold_sigma = 0.3;
    hold(0.001, 0.0, 0.01);
    const double first_N = state_.demand.threshold_N;
    hold(-0.01, 0.0, 0.01);
    hold(0.001, 0.0, 0.01);
    EXPECT_NE(state_.demand.threshold_N, first_N);
    EXPECT_EQ(state_.touches, 2);
}

TEST_F(CupOnTheWall, ALipThatRocksOpensAndSealsAgainInTheSameTouch) {
    cup_.q_WF = quaternion_from_euler({.pitch_rad = radians(8.0)});  // 2.8 N m on the lip
    hold(0.001, 40.0, 0.05);                                         // 20 N of push bear 0.4 N m
    EXPECT_EQ(phase(), CupPhase::touching);
    cup_.q_WF = Quaternion::Identity();
    hold(0.001, 40.0, 0.02);
    EXPECT_EQ(phase(), CupPhase::sealing);
    cup_.q_WF = quaternion_from_euler({.pitch_rad = radians(8.0)});
    hold(0.001, 40.0, 0.02);
    EXPECT_EQ(phase(), CupPhase::touching);
    EXPECT_EQ(state_.touches, 1);
    EXPECT_TRUE(events_.empty());
}

TEST_F(CupOnTheWall, TornOpenWhilePressedItIsSaidOnce) {
    hold(0.001, 40.0, 1.0);
    cup_.p_WF_m.z() = 0.05;  // dragged along the wall
    hold(0.001, 0.0, 0.05);
    EXPECT_EQ(phase(), CupPhase::touching);
    hold(-0.01, 0.0, 0.01);
    EXPECT_EQ(phase(), CupPhase::free);
    ASSERT_EQ(events_.size(), 2U);
    EXPECT_EQ(events_[1].name, EventName::contact_lost);
    EXPECT_EQ(events_[1].reason, "sheared off");
}

TEST_F(CupOnTheWall, WallPushesBackInTheWorld) {
    surface_.seal_threshold_median_N = 1e6;
    cup_.p_WF_m.x() = 0.001;
    const CupOutput output = step(model_, state_, surface_, cup_, input_, kStep_s);
    EXPECT_NEAR(output.wrench_W.force_N.x(), -20.0,
                1e-9);  // the wall is to the north: pushes south
    EXPECT_NEAR(state_.status.pull_N, -20.0, 1e-9);
}

// Where a joint holds the cup its load counts, not the law's.
TEST_F(CupOnTheWall, AJointsLoadIsHeldAgainstTheVacuum) {
    hold(0.001, 40.0, 5.0);
    ASSERT_EQ(phase(), CupPhase::attached);
    const double vacuum_N = vacuum_force_N(state_.mean_pressure_Pa, model_.parameters.lip.radius_m);
    input_.held_T = Wrench{.force_N = {0.99 * vacuum_N, 0.0, 0.0}};
    hold(0.001, 0.0, 1.0);
    EXPECT_EQ(phase(), CupPhase::attached);
    EXPECT_NEAR(state_.status.pull_N, 0.99 * vacuum_N, 1e-9);
    input_.held_T = Wrench{.force_N = {1.01 * vacuum_N, 0.0, 0.0}};
    hold(0.001, 0.0, 2e-3);
    EXPECT_EQ(phase(), CupPhase::touching) << "still pressed, no longer sealed";
    EXPECT_EQ(events_.back().name, EventName::contact_lost);
    EXPECT_EQ(events_.back().reason, "pulled off");
    EXPECT_LT(state_.status.pull_N, 0.0) << "the law again: it pushes";
}

}  // namespace
}  // namespace limpet::suction
