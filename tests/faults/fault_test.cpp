// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/faults/faults.hpp"

namespace limpet::faults {
namespace {

using guidance::EventList;
using guidance::PerchingState;

constexpr std::size_t kFour = 4;

/// A reading of 100 Hz whose value is its time, until `end_s`.
struct Told {
    FaultsState state;
    Readings told;
    EventList events;
};

Told after(const FaultsModel& model, double end_s,
           PerchingState phase = PerchingState::pre_positioning) {
    Told run;
    for (int tick = 0; tick <= static_cast<int>(end_s * 1000.0 + 0.5); ++tick) {
        const double time_s = 1e-3 * tick;
        step(model, run.state, phase, kFour, time_s, run.events);
        if (tick % 10 == 0) {
            Readings& sensed = run.state.sensed;
            sensed.cup_pressure = {time_s, {1000.0 * time_s}};
            sensed.force = {time_s, {time_s}};
            sensed.lidar_left = {time_s, {time_s, true}};
            sensed.lidar_right = {time_s, {time_s, true}};
            sensed.motion_capture = {time_s, {Vector3(time_s, 0.0, 0.0), Quaternion::Identity()}};
            sensed.imu.time_s = time_s;
        }
        hear(model, run.state, time_s, run.told);
    }
    return run;
}

FaultsModel one(FaultKind kind, double size = 0.0) {
    return {.faults = {{.kind = kind, .size = size, .after_s = 0.5}}};
}

TEST(Faults, NoneChangesNothingAndSaysNothing) {
    const Told run = after({.faults = {{.kind = FaultKind::none}}}, 1.0);
    EXPECT_EQ(run.events.count, 0U);
    EXPECT_EQ(run.told.force.time_s, 1.0);
    EXPECT_EQ(run.told.force.value.axial_N, 1.0);
}

TEST(Faults, WhatIsLostKeepsItsLastSample) {
    const Told run = after(one(FaultKind::force_lost), 1.0);
    EXPECT_DOUBLE_EQ(run.told.force.time_s, 0.49);
    EXPECT_DOUBLE_EQ(run.told.cup_pressure.time_s, 1.0);
    ASSERT_EQ(run.events.count, 1U);
    EXPECT_EQ(run.events.events[0].name, EventName::fault_began);
    EXPECT_EQ(run.events.events[0].reason, "force_lost");
    EXPECT_DOUBLE_EQ(run.events.events[0].time_s, 0.5);
}

TEST(Faults, WhatIsStuckRepeatsItsLastValueWithNewStamps) {
    const Told run = after(one(FaultKind::pressure_stuck), 1.0);
    EXPECT_DOUBLE_EQ(run.told.cup_pressure.time_s, 1.0);
    EXPECT_DOUBLE_EQ(run.told.cup_pressure.value.pressure_Pa, 490.0);
}

TEST(Faults, AnOffsetIsAddedOnceToEachSample) {
    const Told run = after(one(FaultKind::force_offset, 10.0), 1.003);
    EXPECT_DOUBLE_EQ(run.told.force.value.axial_N, 11.0);
}

TEST(Faults, ADriftGrowsFromItsBeginning) {
    const Told run = after(one(FaultKind::pressure_drifts, 2000.0), 1.0);
    EXPECT_NEAR(run.told.cup_pressure.value.pressure_Pa, 1000.0 + 1000.0, 1e-9);
}

TEST(Faults, HitTheUnitThatIsSaidOrAll) {
    FaultsModel model = one(FaultKind::lidar_ghost, 0.3);
    Told run = after(model, 1.0);
    EXPECT_EQ(run.told.lidar_left.value.distance_m, 0.3);
    EXPECT_EQ(run.told.lidar_right.value.distance_m, 0.3);
    model.faults[0].unit = 1;
    run = after(model, 1.0);
    EXPECT_EQ(run.told.lidar_left.value.distance_m, 1.0);
    EXPECT_EQ(run.told.lidar_right.value.distance_m, 0.3);
}

TEST(Faults, PassAndTheReadingsComeBack) {
    FaultsModel model = one(FaultKind::force_lost);
    model.faults[0].for_s = 0.2;
    const Told run = after(model, 1.0);
    EXPECT_EQ(run.told.force.time_s, 1.0);
    ASSERT_EQ(run.events.count, 2U);
    EXPECT_EQ(run.events.events[1].name, EventName::fault_ended);
    EXPECT_NEAR(run.events.events[1].time_s, 0.7, 1e-9);
}

TEST(Faults, BeginWithTheirPhaseAndNotBefore) {
    FaultsModel model = one(FaultKind::force_lost);
    model.faults[0].phase = PerchingState::approaching;
    EXPECT_EQ(after(model, 1.0).events.count, 0U);
    const Told run = after(model, 1.0, PerchingState::approaching);
    ASSERT_EQ(run.events.count, 1U);
    EXPECT_DOUBLE_EQ(run.events.events[0].time_s, 0.5);  // after_s later
}

TEST(Faults, TwoAtOnceAdd) {
    FaultsModel model = one(FaultKind::hose_leaks, 0.2);
    model.faults.push_back({.kind = FaultKind::lip_torn, .size = 3.0});
    model.faults.push_back({.kind = FaultKind::motor_weak, .unit = 2, .size = 0.49});
    model.faults.push_back({.kind = FaultKind::motor_lost, .unit = 0});
    const Told run = after(model, 1.0);
    const Acting& now = run.state.now;
    EXPECT_DOUBLE_EQ(now.hole_mm2, 3.2);
    ASSERT_TRUE(now.rotors_hit);
    EXPECT_EQ(now.speed_share, (RotorList<double>{0.0, 1.0, 0.7, 1.0}));
}

TEST(Faults, AGustAcrossComesFromTheLeftOfWhoFacesTheWall) {
    FaultsModel model = one(FaultKind::gust_across, 4.0);
    model.ahead_W = Vector3::UnitX();                                           // north
    EXPECT_EQ(after(model, 1.0).state.now.gust_W_m_s, Vector3(0.0, 4.0, 0.0));  // to the east
}

TEST(Faults, AnEstimateDriftsOnceAnEstimate) {
    const FaultsModel model = one(FaultKind::estimate_drifts, 0.2);
    Told run = after(model, 1.5);
    Estimate estimate;
    estimate.time_s = 1.5;
    mislead(model, run.state, 1.5, estimate);
    mislead(model, run.state, 1.5, estimate);
    EXPECT_NEAR(estimate.p_WB_m.x(), 0.2, 1e-12);
    EXPECT_NEAR(estimate.v_WB_m_s.x(), 0.2, 1e-12);
}

}  // namespace
}  // namespace limpet::faults
