// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

using enum EventName;
constexpr double kWeight_N = 3.2 * kGravity_m_s2;

TEST(PerchConcrete, IsReleasedAfterTheWholeManoeuvre) {
    const Trace& trace = flown("perch_concrete");
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    std::vector<EventName> names;
    for (const Event& event : trace.result.events) {
        names.push_back(event.name);
    }
    EXPECT_THAT(names,
                testing::ElementsAre(pre_positioned, approach_started, impact, attached, hold_over,
                                     landing_started, perched, motors_off, motors_on, level,
                                     pump_off, pressure_released, detached, backed_off));
}

TEST(PerchConcrete, IsAlignedBeforeTheApproach) {
    EXPECT_LT(flown("perch_concrete").result.metrics.alignment_at_approach_deg, 2.0);
}

TEST(PerchConcrete, StartsFromThePrePosition) {
    const Trace& trace = flown("perch_concrete");
    for (const Event& event : trace.result.events) {
        if (event.name == approach_started) {
            EXPECT_NEAR(event.values[0].value, 1.5, 0.06);  // distance_m
        }
    }
}

TEST(PerchConcrete, HitsAtTheIdealSpeed) {
    const Metrics& m = flown("perch_concrete").result.metrics;
    EXPECT_GE(m.impact_speed_m_s, 1.0);
    EXPECT_LE(m.impact_speed_m_s, 1.2);
}

TEST(PerchConcrete, ImpactIsANegativeForceSpikeThenThePitchGoesDown) {
    const Trace& trace = flown("perch_concrete");
    const double impact_s = trace.first(impact);
    double spike_N = 0.0;
    double before_N = 0.0;
    double pitch_before_deg = 0.0;
    double pitch_lowest_deg = 90.0;
    for (std::size_t i = 0; i < trace.truth.size(); ++i) {
        const double t_s = trace.truth[i].time_s - impact_s;
        if (t_s > -1.0 && t_s < -0.1) {
            before_N = std::min(before_N, trace.force_sensor_N[i]);
            pitch_before_deg = pitch_deg(trace.truth[i]);
        } else if (t_s > -0.1 && t_s < 0.5) {
            spike_N = std::min(spike_N, trace.force_sensor_N[i]);
            pitch_lowest_deg = std::min(pitch_lowest_deg, pitch_deg(trace.truth[i]));
        }
    }
    EXPECT_LT(spike_N, -30.0);
    EXPECT_GT(before_N, -3.0);
    EXPECT_LT(pitch_lowest_deg, pitch_before_deg - 1.0);
}

TEST(PerchConcrete, IsBelowPLandAtTheEndOfTheHold) {
    const Trace& trace = flown("perch_concrete");
    EXPECT_LT(trace.result.metrics.pressure_at_hold_end_Pa, 88000.0);
    EXPECT_NEAR(trace.first(hold_over) - trace.first(impact), 0.5, 0.021);
}

TEST(PerchConcrete, ThrustFallsWhilePitchAndCupPullRise) {
    const Trace& trace = flown("perch_concrete");
    const double start_s = trace.first(landing_started);
    const double end_s = trace.first(perched);
    std::vector<const Truth*> thirds;
    for (const double share : {0.1, 0.4, 0.65, 1.0}) {
        const double t_s = start_s + share * (end_s - start_s);
        thirds.push_back(&*std::find_if(trace.truth.begin(), trace.truth.end(),
                                        [t_s](const Truth& t) { return t.time_s >= t_s; }));
    }
    for (std::size_t i = 1; i < thirds.size(); ++i) {
        EXPECT_LT(thirds[i]->thrust_N, thirds[i - 1]->thrust_N);
        EXPECT_GT(pitch_deg(*thirds[i]), pitch_deg(*thirds[i - 1]));
        EXPECT_GT(thirds[i]->slider.force_N, thirds[i - 1]->slider.force_N);
    }
    EXPECT_GT(pitch_deg(*thirds.back()), 60.0);
    EXPECT_GT(thirds.back()->cup_status.pull_N, thirds.front()->cup_status.pull_N + 5.0);
    EXPECT_GT(thirds.back()->slider.force_N, 20.0);
}

TEST(PerchConcrete, RestsSteadyWithItsMotorsOff) {
    const Trace& trace = flown("perch_concrete");
    EXPECT_LT(trace.result.metrics.perched_pitch_spread_deg, 0.1);
    const double off_s = trace.first(motors_off);
    for (const Truth& truth : trace.truth) {
        if (truth.time_s > off_s + 1.0 && truth.time_s < trace.first(motors_on)) {
            ASSERT_LT(truth.thrust_N, 1e-3);
        }
    }
}

TEST(PerchConcrete, CupAndLegsCarryTheWeight) {
    const Trace& trace = flown("perch_concrete");
    const double on_s = trace.first(motors_on);
    const Truth* last = nullptr;
    for (const Truth& truth : trace.truth) {
        last = truth.time_s < on_s - 0.1 ? &truth : last;
    }
    ASSERT_NE(last, nullptr);
    const Vector3 cup_W = last->cup.q_WF * last->cup_status.wrench_C.force_N;
    const Vector3 sum_W = cup_W + last->legs_force_W_N;
    EXPECT_NEAR(-sum_W.z(), kWeight_N, 0.01 * kWeight_N);
    // Along the wall's normal the legs push as much as the cup pulls.
    EXPECT_NEAR(sum_W.x(), 0.0, 0.01 * kWeight_N);
    EXPECT_GT(cup_W.x(), 5.0);
}

TEST(PerchConcrete, StaticsOfTheHangingVehicleByHand) {
    // Moments about the leg tips: the cup's pull N over the height h between tips and lip carries
    // the weight at its distance d from the wall, less the lip's own moment and shear's lever.
    const Trace& trace = flown("perch_concrete");
    const double on_s = trace.first(motors_on);
    const Truth* last = nullptr;
    for (const Truth& truth : trace.truth) {
        last = truth.time_s < on_s - 0.1 ? &truth : last;
    }
    ASSERT_NE(last, nullptr);
    const auto model = model_of("perch_concrete");
    const vehicle::LegParameters& legs = model->scenario->airframe.legs;
    const Vector3 tip_W = last->base.p_WF_m +
                          last->base.q_WF * Vector3(legs.tip_x_m, 0.0, legs.tip_z_m) +
                          Vector3(legs.tip_radius_m, 0.0, 0.0);
    // Slider out, joint turned: the parts' centre of mass is B's origin to within a millimetre.
    const Vector3 weight_arm = last->base.p_WF_m - tip_W;
    const Vector3 cup_arm = last->cup.p_WF_m - tip_W;
    const Vector3 cup_W = last->cup.q_WF * last->cup_status.wrench_C.force_N;
    const Vector3 cup_moment_W = last->cup.q_WF * last->cup_status.wrench_C.moment_N_m;
    const Vector3 moment_W =
        weight_arm.cross(Vector3(0.0, 0.0, kWeight_N)) + cup_arm.cross(cup_W) + cup_moment_W;
    EXPECT_NEAR(moment_W.y(), 0.0, 0.02 * kWeight_N * std::abs(cup_arm.z()));
}

TEST(PerchConcrete, NoLoadExceedsWhatTheCupHolds) {
    const Metrics& m = flown("perch_concrete").result.metrics;
    EXPECT_GT(m.cup_margin_min_N, 0.0);
    for (const CupLoads& load : m.loads) {
        EXPECT_GT(load.margin_N, 0.0);
        EXPECT_TRUE(std::isfinite(load.margin_N));  // every phase was flown
    }
}

TEST(PerchConcrete, ReleasesInAboutASecond) {
    const Metrics& m = flown("perch_concrete").result.metrics;
    EXPECT_GE(m.release_s, 0.8);
    EXPECT_LE(m.release_s, 1.4);
}

TEST(PerchConcrete, RestingCostsAFractionOfFlying) {
    const Metrics& m = flown("perch_concrete").result.metrics;
    const Trace& trace = flown("perch_concrete");
    const double rest_s = trace.first(motors_on) - trace.first(motors_off);
    const double fly_s = trace.truth.back().time_s - rest_s;
    EXPECT_LT(m.energy_perched_Wh / rest_s, 0.1 * m.energy_flying_Wh / fly_s);
}

class PerchesOn : public testing::TestWithParam<const char*> {};

TEST_P(PerchesOn, ReachesTheWallWithMargin) {
    const Trace& trace = flown(GetParam());
    EXPECT_LT(trace.result.metrics.pressure_at_hold_end_Pa, 88000.0);
    EXPECT_GT(trace.result.metrics.cup_margin_min_N, 0.0);
    EXPECT_NEAR(trace.result.metrics.perched_pitch_deg, 66.5, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, PerchesOn,
                         testing::Values("perch_concrete", "perch_cinder_block",
                                         "perch_turbine_blade", "perch_metal", "perch_metal_valve",
                                         "failed_perch"));

TEST(FailedPerch, RetreatsHalfASecondAfterTheImpactAndTriesAgain) {
    const Trace& trace = flown("failed_perch");
    EXPECT_EQ(trace.result.outcome, Outcome::released);
    EXPECT_EQ(trace.result.attempts, 2);
    ASSERT_EQ(trace.times(impact).size(), 2U);
    ASSERT_EQ(trace.times(retreat_started).size(), 1U);
    EXPECT_NEAR(trace.first(retreat_started) - trace.first(impact), 0.5, 0.021);
    ASSERT_EQ(trace.times(pre_positioned).size(), 2U);
    // Back at the pre-position before the second run, with the pressure where it was.
    for (const Event& event : trace.result.events) {
        if (event.name == approach_started) {
            EXPECT_NEAR(event.values[0].value, 1.5, 0.06);
            EXPECT_GT(event.values[4].value, 100000.0);
        }
    }
}

TEST(FailedPerch, PressureStaysHighInTheFirstRun) {
    const Trace& trace = flown("failed_perch");
    for (const Truth& truth : trace.truth) {
        if (truth.time_s < trace.first(retreat_started)) {
            ASSERT_GT(truth.cup_status.pressure_Pa, 100000.0);
        }
    }
}

TEST(Missions, PerchEndsOnTheWall) {
    const Trace trace = simulation::trace(model_of("perch_concrete", {"mission=perch"}));
    EXPECT_EQ(trace.result.outcome, Outcome::perched);
}

TEST(Missions, AWallThatNeverSealsUsesUpTheAttempts) {
    const Trace trace = simulation::trace(
        model_of("perch_concrete", {"wall.surface=spalled_concrete", "guidance.attempts=2"}));
    EXPECT_EQ(trace.result.outcome, Outcome::failed_to_seal);
    EXPECT_EQ(trace.result.attempts, 2);
}

TEST(Missions, TurnedAndLeaningWallsAreFlownToo) {
    for (const char* heading :
         {"wall.heading_deg=90", "wall.heading_deg=-135", "wall.lean_deg=3", "wall.lean_deg=-3"}) {
        const Trace trace = simulation::trace(model_of("perch_concrete", {heading}));
        EXPECT_EQ(trace.result.outcome, Outcome::released) << heading;
        EXPECT_NEAR(trace.result.metrics.impact_speed_m_s,
                    flown("perch_concrete").result.metrics.impact_speed_m_s, 0.03);
    }
}

TEST(Missions, TimeOver) {
    const Trace trace =
        simulation::trace(model_of("perch_concrete", {"simulation.time_limit_s=3"}));
    EXPECT_EQ(trace.result.outcome, Outcome::timed_out);
}

TEST(Crashes, RotorsTooWeakForTheWeightReachTheGround) {
    const Trace trace =
        simulation::trace(model_of("perch_concrete", {"vehicle.rotor.speed_max_rad_s=540"}));
    EXPECT_EQ(trace.result.outcome, Outcome::crashed);
    EXPECT_EQ(trace.result.reason, "hit the ground");
}

TEST(Crashes, AnArmShorterThanThePropellersPutsThemIntoTheWall) {
    // Propeller tips reach 0.357 m ahead of the centre of mass; this lip 0.32 m.
    const Trace trace =
        simulation::trace(model_of("perch_concrete", {"vehicle.cup.joint_x_m=0.28"}));
    EXPECT_EQ(trace.result.outcome, Outcome::crashed);
    EXPECT_EQ(trace.result.reason, "a propeller hit the wall");
}

TEST(Crashes, InTheTickInWhichGuidanceEndsAreCrashesToo) {
    Flight flight(model_of("perch_concrete", {"vehicle.rotor.speed_max_rad_s=540"}));
    Snapshot before = flight.save();
    while (!flight.ended()) {
        before = flight.save();
        (void)flight.tick();
    }
    ASSERT_EQ(flight.state().ending->outcome, Outcome::crashed);
    before.state.guidance.ending =
        guidance::Ending{.outcome = Outcome::aborted, .reason = "position estimate lost"};
    flight.restore(before);
    (void)flight.tick();
    EXPECT_EQ(flight.state().ending->outcome, Outcome::crashed);
}

/// A sensor that fails at some moment of the manoeuvre; the vehicle must not come down with it.
struct FaultAt {
    const char* fault;
    double time_s;
};
void PrintTo(const FaultAt& fault, std::ostream* out) {
    *out << fault.fault << " " << fault.time_s;
}
class SurvivesFault : public testing::TestWithParam<FaultAt> {};

TEST_P(SurvivesFault, OnConcreteAndOnMetalWithAValve) {
    for (const char* scenario : {"perch_concrete", "perch_metal_valve"}) {
        const std::string fault =
            fmt::format("faults={{fault: {}, at_s: {}}}", GetParam().fault, GetParam().time_s);
        const Trace trace = simulation::trace(model_of(scenario, {fault}));
        EXPECT_NE(trace.result.outcome, Outcome::crashed)
            << scenario << ": " << trace.result.reason;
        EXPECT_NE(trace.result.outcome, Outcome::timed_out) << scenario;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Faults, SurvivesFault,
    testing::Values(FaultAt{"pressure_stuck", 0.0}, FaultAt{"pressure_stuck", 5.0},
                    FaultAt{"pressure_stuck", 8.0}, FaultAt{"pressure_stuck", 15.0},
                    FaultAt{"pressure_stuck", 22.0}, FaultAt{"pressure_stuck", 26.5},
                    FaultAt{"pressure_stuck", 27.2}, FaultAt{"mocap_lost", 0.5},
                    FaultAt{"mocap_lost", 4.0}, FaultAt{"mocap_lost", 5.4},
                    FaultAt{"mocap_lost", 8.0}, FaultAt{"mocap_lost", 15.0},
                    FaultAt{"mocap_lost", 24.0}, FaultAt{"mocap_lost", 29.0},
                    FaultAt{"force_lost", 2.0}, FaultAt{"force_lost", 4.5},
                    FaultAt{"lidar_lost, unit: 0", 1.0}, FaultAt{"lidar_lost, unit: 1", 4.5}));

TEST(Touches, OneDockIsOneTouch) {
    for (const char* scenario :
         {"perch_concrete", "perch_cinder_block", "perch_turbine_blade", "perch_metal"}) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            Flight flight(model_of(scenario, {"mission=perch", "guidance.rest_s=0"}, seed));
            while (!flight.ended()) {
                flight.tick();
            }
            EXPECT_EQ(flight.state().cup.touches, flight.seen().metrics.attempts)
                << scenario << " " << seed;
        }
    }
}

TEST(Missions, ACupThatHoldsIsNotLetGoByAPoseThatSlipped) {
    const Trace trace = simulation::trace(model_of("perch_metal", {"guidance.land_pitch_s=1.0"}));
    EXPECT_EQ(trace.result.outcome, Outcome::release_aborted) << trace.result.reason;
}

TEST(Missions, WhoNeverRestedIsNotReleased) {
    // It feels no impact, and rotors that turn too fast when idle do not let it come to rest.
    const Trace trace = simulation::trace(model_of(
        "perch_cinder_block", {"sensors.force_range_N=3.8", "guidance.zero_thrust=0.42",
                               "faults=[{fault: gust_across, size: 24.6, phase: backing_off, "
                               "after_s: 1.95, for_s: 2.9}]"}));
    EXPECT_TRUE(trace.times(perched).empty());
    EXPECT_FALSE(trace.times(detached).empty());
    EXPECT_EQ(trace.result.outcome, Outcome::aborted) << trace.result.reason;
}

TEST(Missions, WithAnEmptyBatteryItIsNotReleased) {
    const Trace trace = simulation::trace(model_of(
        "perch_metal", {"vehicle.battery.initial_charge=0.02", "guidance.battery_reserve=0"}));
    EXPECT_NE(trace.result.outcome, Outcome::released) << trace.result.reason;
}

TEST(Missions, WithAValveACupWhosePressureIsUnknownComesOff) {
    const Trace trace = simulation::trace(
        model_of("perch_metal_valve", {"faults={fault: pressure_stuck, at_s: 5.0}"}));
    EXPECT_EQ(trace.result.reason, "no landing in any attempt");
    EXPECT_FALSE(trace.times(detached).empty());
}

TEST(Missions, ASenseLostAtTheImpactOnMetalLandsItAgain) {
    for (const char* fault :
         {"faults={fault: force_lost, at_s: 5.15}", "faults={fault: pressure_stuck, at_s: 5.15}",
          "faults={fault: pressure_stuck, at_s: 5.25}"}) {
        const Trace trace = simulation::trace(model_of("perch_metal", {fault}));
        EXPECT_EQ(trace.result.outcome, Outcome::release_aborted)
            << fault << ": " << trace.result.reason;
    }
}

TEST(Missions, WithoutMotionCaptureInTheApproachItComesToAStand) {
    for (const char* fault :
         {"faults={fault: mocap_lost, at_s: 4.0}", "faults={fault: mocap_lost, at_s: 4.3}",
          "faults={fault: mocap_lost, at_s: 4.6}"}) {
        const Trace trace = simulation::trace(model_of("perch_metal", {fault}));
        EXPECT_EQ(trace.result.outcome, Outcome::aborted) << fault << ": " << trace.result.reason;
        EXPECT_LT(trace.truth.back().base.v_WF_W_m_s.norm(), 0.3) << fault;
    }
}

TEST(Missions, LidarLostInFlightIsSurvived) {
    const Trace trace = simulation::trace(
        model_of("perch_concrete", {"faults={fault: lidar_lost, unit: 0, at_s: 4.2}"}));
    EXPECT_EQ(trace.result.outcome, Outcome::aborted);
    EXPECT_EQ(trace.result.reason, "no pre-position before the wall in time");
    EXPECT_FALSE(trace.times(aborted).empty());
    const Vector3 moved_m = trace.truth.back().base.p_WF_m - trace.truth.front().base.p_WF_m;
    EXPECT_LT(moved_m.norm(), 1.0);  // still there, in the air
}

}  // namespace
}  // namespace limpet::simulation
