// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flown.hpp"
#include "limpet/scenario/fault_table.hpp"
#include "limpet/simulation/advance.hpp"

namespace limpet::simulation {
namespace {

using testing::ElementsAre;

Trace with_fault(const char* scenario, const std::string& fault) {
    return simulation::trace(model_of(scenario, {"faults={" + fault + "}"}));
}

TEST(FaultsInTheLoop, ATableOfNoneIsTheFlightWithoutOne) {
    const Trace none = with_fault("perch_concrete", "fault: none, phase: resting");
    EXPECT_EQ(none.result.state_hash, flown("perch_concrete").result.state_hash);
}

TEST(FaultsInTheLoop, BeginAndEndAreEventsAtTheirTime) {
    const Trace trace =
        with_fault("perch_concrete", "fault: motor_weak, unit: 1, phase: holding, for_s: 0.2");
    const auto impact_s = trace.times(EventName::impact);
    const auto began_s = trace.times(EventName::fault_began);
    const auto ended_s = trace.times(EventName::fault_ended);
    ASSERT_EQ(impact_s.size(), 1U);
    ASSERT_EQ(began_s.size(), 1U);
    ASSERT_EQ(ended_s.size(), 1U);
    EXPECT_NEAR(began_s[0], impact_s[0] + 1e-3, 1e-9);  // guidance speaks after the faults
    EXPECT_NEAR(ended_s[0], began_s[0] + 0.2, 1e-9);
}

TEST(FaultsInTheLoop, OneWhosePhaseNeverCameIsToldAtTheEnd) {
    const FlightResult result =
        fly(model_of("perch_concrete", {"faults={fault: motor_lost, phase: braking}"}));
    EXPECT_EQ(result.outcome, Outcome::released);
    EXPECT_THAT(result.faults_not_begun,
                ElementsAre("{fault: motor_lost, unit: 0, phase: braking, after_s: 0}"));
}

/// A tracker that repeats itself while the body turns, or follows another body, is as one that is
/// lost.
TEST(FaultsInTheLoop, PosesThatLieAreNotFlownBy) {
    for (const char* kind : {"mocap_frozen", "mocap_wrong_body"}) {
        for (const char* phase : {"approaching", "holding", "pitching_up", "resting",
                                  "pitching_down", "releasing", "backing_off"}) {
            const std::string fault = fmt::format("fault: {}, phase: {}", kind, phase);
            const Trace trace = with_fault("perch_concrete", fault);
            EXPECT_NE(trace.result.outcome, Outcome::crashed) << fault;
            EXPECT_NE(trace.result.outcome, Outcome::timed_out) << fault;
        }
    }
}

/// The impact is not felt, but the wall stops it and the pressure falls. A pressure that falls by
/// itself, on the way, is no wall.
TEST(FaultsInTheLoop, ATouchIsKnownByItsVacuumWhereTheForceIsStuck) {
    for (const char* scenario : {"perch_concrete", "perch_metal_valve"}) {
        const Trace trace = with_fault(scenario, "fault: force_stuck, phase: approaching");
        EXPECT_EQ(trace.result.outcome, Outcome::released) << scenario << trace.result.reason;
        EXPECT_EQ(trace.result.attempts, 1) << scenario;
    }
    const Trace drifts =
        with_fault("perch_concrete", "fault: pressure_drifts, phase: approaching, size: -50000");
    const auto approach_s = drifts.times(EventName::approach_started);
    const auto impact_s = drifts.times(EventName::impact);
    ASSERT_FALSE(impact_s.empty());
    EXPECT_NEAR(impact_s[0] - approach_s[0], 1.66, 0.1);
}

TEST(FaultsInTheLoop, WithoutAnImuItStaysOnTheWallThatItRestsOn) {
    for (const char* scenario : {"perch_concrete", "perch_metal"}) {
        const Trace trace = with_fault(scenario, "fault: imu_lost, phase: resting");
        EXPECT_EQ(trace.result.outcome, Outcome::release_aborted) << scenario;
        EXPECT_EQ(trace.result.reason, "no position estimate: rests on the wall") << scenario;
    }
}

/// A mass that has moved turns what nothing else turns: I dw/dt = s g, its side goes down.
TEST(FaultsInTheLoop, APayloadThatShiftsTurnsByItsMoment) {
    constexpr double kShift_kg_m = 0.02, kFor_s = 0.1;
    const auto model = model_of("hover", {"vehicle.has_cup=false"});
    const auto turned_rad = [&](double faults::Acting::*shift) {
        const auto plant = model->plant->make();
        FlightState state = start(*model, *plant);
        plant->set_pose(Vector3::Zero(), Quaternion::Identity());
        see_motion(*model, state.truth, *plant);
        state.faults.now.*shift = kShift_kg_m;
        std::fill(state.rotors.speed_rad_s.begin(), state.rotors.speed_rad_s.end(), 0.0);
        TickReport report;
        while (seconds(state.tick) < kFor_s) {
            const Stride stride = one_tick(*model, state);
            advance(*model, state, *plant, stride, report);
            state.tick += stride.ticks;
            see_motion(*model, state.truth, *plant);
        }
        return state.truth.base.w_WF_F_rad_s;
    };
    const Vector3& inertia_kg_m2 = model->airframe.inertia_kg_m2;
    const double moment_N_m = kShift_kg_m * kGravity_m_s2;
    const Vector3 right = turned_rad(&faults::Acting::payload_to_right_kg_m);
    const Vector3 ahead = turned_rad(&faults::Acting::payload_ahead_kg_m);
    EXPECT_NEAR(right.x(), moment_N_m * kFor_s / inertia_kg_m2.x(), 0.01 * right.x());
    EXPECT_NEAR(ahead.y(), -moment_N_m * kFor_s / inertia_kg_m2.y(), -0.01 * ahead.y());
    EXPECT_NEAR(right.y(), 0.0, 1e-9);
    EXPECT_NEAR(ahead.x(), 0.0, 1e-9);
}

/// Nothing holds it off the wall any more: two engines agree on how it falls against it.
TEST(FaultsInTheLoop, WithoutALegItTurnsAgainstTheWallAlikeOnBothEngines) {
    const auto falling = [](const char* engine, const std::string& fault) {
        const Trace trace = simulation::trace(
            model_of("perch_metal", {"faults={" + fault + ", phase: resting}",
                                     std::string("simulation.engine=") + engine}));
        const double looked_s = trace.first(EventName::fault_began) + 0.3;
        return *std::find_if(trace.truth.begin(), trace.truth.end(),
                             [&](const Truth& at) { return at.time_s >= looked_s; });
    };
    const double whole_deg = pitch_deg(falling("reduced", "fault: payload_shifts, size: 0"));
    for (const char* fault : {"fault: leg_broken", "fault: leg_broken, unit: 0"}) {
        const Truth reduced = falling("reduced", fault);
        const Truth mujoco = falling("mujoco", fault);
        EXPECT_NEAR(pitch_deg(reduced), pitch_deg(mujoco), 0.3) << fault;
        EXPECT_LT((reduced.base.p_WF_m - mujoco.base.p_WF_m).norm(), 3e-3) << fault;
        EXPECT_GT(std::abs(pitch_deg(reduced) - whole_deg), 1.0) << fault;
    }
}

/// What was heard before the jump looks old until it is heard again: a tick later.
TEST(FaultsInTheLoop, AClockThatJumpsMakesNobodyFall) {
    for (const char* phase : {"approaching", "holding", "pitching_up", "resting", "spinning_up",
                              "pitching_down", "releasing", "backing_off"}) {
        for (const char* size : {"0.3", "3", "60"}) {
            const Trace trace =
                with_fault("perch_concrete",
                           fmt::format("fault: clock_jumps, size: {}, phase: {}", size, phase));
            EXPECT_NE(trace.result.outcome, Outcome::crashed) << phase << " " << size;
            EXPECT_NE(trace.result.outcome, Outcome::timed_out) << phase << " " << size;
        }
    }
}

/// The pressure that pump and hole agree on, and the way there, in closed form.
TEST(FaultsInTheLoop, AHoleInTheHoseSettlesWherePumpAndHoleAgree) {
    constexpr double kHole_mm2 = 0.05;
    const Trace trace = with_fault(
        "perch_concrete", fmt::format("fault: hose_leaks, size: {}, phase: resting", kHole_mm2));
    const scenario::Scenario scenario = scenario::load_scenario("perch_concrete");
    const auto& surface = scenario.wall.surface;
    const double pump_1_s = 1.0 / surface.sealing_time_constant_s;
    const double hole_1_s = kHole_mm2 / kPi / scenario.cup.pressure.valve_time_constant_s;
    const double settled_Pa =
        (pump_1_s * surface.vacuum_pressure_Pa + hole_1_s * kAtmosphere_Pa) / (pump_1_s + hole_1_s);
    const double looked_s = trace.times(EventName::fault_began).at(0) + 5.0;
    const auto seen = std::find_if(trace.truth.begin(), trace.truth.end(),
                                   [&](const Truth& truth) { return truth.time_s >= looked_s; });
    ASSERT_NE(seen, trace.truth.end());
    EXPECT_NEAR(seen->cup_status.pressure_Pa, settled_Pa, 1.5 * surface.pump_ripple_Pa);
    EXPECT_GT(settled_Pa, surface.vacuum_pressure_Pa + 3000.0);  // the hole is felt
}

TEST(FaultsInTheLoop, AMotorThatIsLostGivesNoThrust) {
    Flight flight(model_of("hover", {"faults={fault: motor_lost, unit: 2, at_s: 1}"}));
    while (!flight.ended() && seconds(flight.state().tick) < 1.3) {
        flight.tick();
    }
    const auto& speed_rad_s = flight.state().truth.rotor_speed_rad_s;
    EXPECT_LT(speed_rad_s[2], 50.0);
    EXPECT_GT(speed_rad_s[0], 50.0);
}

TEST(FaultsInTheLoop, AFlightSavedInItsFaultGoesOnWithTheSameBits) {
    const auto model =
        model_of("perch_concrete", {"faults=[{fault: pressure_drifts, phase: holding, for_s: 3},"
                                    "{fault: lidar_offset, unit: 0, at_s: 1}]"});
    Flight flight(model);
    while (seconds(flight.state().tick) < 5.5) {
        flight.tick();
    }
    const Snapshot saved = flight.save();
    Flight again(model);
    again.restore(saved);
    while (!flight.ended()) {
        flight.tick();
        again.tick();
    }
    EXPECT_TRUE(again.ended());
    EXPECT_EQ(result_of(again, 0.0).state_hash, result_of(flight, 0.0).state_hash);
}

TEST(FaultsInTheLoop, AStalledCompanionLeavesSetPointAndPumpAsTheyWere) {
    const Trace trace = with_fault("perch_concrete", "fault: guidance_stalls, phase: resting");
    EXPECT_EQ(trace.result.outcome, Outcome::timed_out);  // it hangs there, pump on
    EXPECT_THAT(trace.times(EventName::contact_lost), ElementsAre());
}

/// Nothing that passes within a fraction of a second brings it down, at any phase.
TEST(FaultsInTheLoop, BlinksOfTheSensorsAreSurvived) {
    for (const char* kind :
         {"mocap_lost", "mocap_frozen", "lidar_lost", "lidar_ghost", "force_lost", "pressure_lost",
          "pressure_stuck", "magnetometer_lost", "guidance_stalls", "link_lost"}) {
        for (const char* phase : {"aligning", "approaching", "holding", "pitching_up",
                                  "pitching_down", "backing_off"}) {
            const std::string fault = fmt::format("fault: {}, phase: {}, for_s: 0.1", kind, phase);
            const Trace trace = with_fault("perch_concrete", fault);
            EXPECT_NE(trace.result.outcome, Outcome::crashed) << fault;
        }
    }
}

}  // namespace
}  // namespace limpet::simulation
