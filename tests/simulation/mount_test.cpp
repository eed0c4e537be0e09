// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

using testing::StartsWith;

std::vector<std::string> swing_at(double speed_m_s, std::vector<std::string> more = {}) {
    more.push_back("pendulum.impact_speed_m_s=" + std::to_string(speed_m_s));
    return more;
}

class SwingAt : public testing::TestWithParam<double> {};

/// v = sqrt(2 g h), and a quarter of the period of a mathematical pendulum until the touch.
TEST_P(SwingAt, MeetsTheWallWithTheSpeedOfItsHeight) {
    const auto model = model_of("pendulum_concrete", swing_at(GetParam()));
    const Trace trial = trace(model);
    const double height_m =
        touching_p_WB_m(*model->scenario).z() - model->scenario->start.p_WB_m.z();
    EXPECT_NEAR(std::sqrt(2.0 * kGravity_m_s2 * height_m), GetParam(), 1e-6);
    EXPECT_NEAR(trial.result.metrics.impact_speed_m_s, GetParam(), 0.01 * GetParam());
    const double angle_rad = vehicle::swing_angle_rad(GetParam(), 5.0);
    const double quarter_s =
        0.5 * kPi * std::sqrt(5.0 / kGravity_m_s2) * (1.0 + angle_rad * angle_rad / 16.0);
    EXPECT_NEAR(trial.first(EventName::impact), quarter_s, 0.01 * quarter_s);
}

/// baseline.md: slider peaks of the two-mass reference; nothing seals on the spalled spot.
TEST_P(SwingAt, PressesTheSliderLikeTwoMasses) {
    const std::map<double, double> expected_N = {{0.2, 11.9}, {0.4, 18.9}, {0.6, 25.7}, {0.8, 32.5},
                                                 {1.0, 39.1}, {1.1, 42.3}, {1.2, 45.8}};
    const Metrics m = trace(model_of("pendulum_concrete",
                                     swing_at(GetParam(), {"wall.surface=spalled_concrete"})))
                          .result.metrics;
    EXPECT_NEAR(m.impact_force_N, expected_N.at(GetParam()), 0.04 * expected_N.at(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Speeds, SwingAt, testing::Values(0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2));

TEST(PendulumTrial, KeepsItsEnergyAndItsAttitudeUntilTheWall) {
    const auto model =
        model_of("pendulum_concrete", {"pendulum.pitch_deg=5", "pendulum.yaw_deg=-8"});
    Flight flight(model);
    const double mass_kg = model->scenario->airframe.mass_kg;
    const auto energy_J = [&] {
        const Kinematics& base = flight.state().truth.base;
        return 0.5 * mass_kg * base.v_WF_W_m_s.squaredNorm() -
               mass_kg * kGravity_m_s2 * (base.p_WF_m.z() - touching_p_WB_m(*model->scenario).z());
    };
    const double at_first_J = energy_J();
    EXPECT_NEAR(at_first_J, 0.5 * mass_kg * 1.1 * 1.1, 1e-6);
    while (flight.state().cup.touches == 0) {
        flight.tick();
        ASSERT_LT(seconds(flight.state().tick), 2.0);
        ASSERT_NEAR(energy_J(), at_first_J, 0.01 * at_first_J) << seconds(flight.state().tick);
        const Euler angles = euler_from_quaternion(flight.state().truth.base.q_WF);
        ASSERT_NEAR(degrees(angles.pitch_rad), 5.0, 0.1);
        ASSERT_NEAR(degrees(angles.yaw_rad), -8.0, 0.1);
        ASSERT_NEAR(degrees(angles.roll_rad), 0.0, 0.1);
    }
}

TEST(PendulumTrial, ConvergesWithTheStep) {
    const auto with_step = [](const char* step_s, const char* touch_step_s) {
        return trace(model_of("pendulum_concrete",
                              {std::string("simulation.step_s=") + step_s,
                               std::string("simulation.touch_step_s=") + touch_step_s}))
            .result.metrics;
    };
    const Metrics coarse = with_step("1e-3", "2.5e-4");
    const Metrics fine = with_step("2.5e-4", "6.25e-5");
    EXPECT_NEAR(coarse.impact_speed_m_s, fine.impact_speed_m_s, 0.005 * fine.impact_speed_m_s);
    EXPECT_NEAR(coarse.impact_force_N, fine.impact_force_N, 0.02 * fine.impact_force_N);
    EXPECT_NEAR(coarse.cup_press_max_N, fine.cup_press_max_N, 0.06 * fine.cup_press_max_N);
    EXPECT_NE(coarse.impact_force_N, fine.impact_force_N);
}

TEST(PendulumTrial, SaysWhyItFailed) {
    struct Case {
        std::vector<std::string> overrides;
        const char* reason;
    };
    const std::string soft = "wall.surface.seal_threshold_median_N=1";
    for (const Case& c :
         {Case{{"wall.surface=spalled_concrete"}, "not enough force"},
          Case{{soft, "wall.surface.seal_tilt_median_deg=0", "wall.surface.seal_tilt_sigma_deg=0"},
               "tilted"},
          Case{{soft, "wall.surface.sealing_time_constant_s=5"}, "contact too short"},
          Case{{soft, "suction.attachment_pressure_Pa=100500",
                "wall.surface.vacuum_pressure_Pa=98000"},
               "came off"}}) {
        const Trace trial = trace(model_of("pendulum_concrete", c.overrides));
        EXPECT_EQ(trial.result.outcome, Outcome::failed_to_seal) << c.reason;
        EXPECT_THAT(std::string(trial.result.reason), StartsWith(c.reason));
    }
}

/// Neither where the trials of Fig. 3 end nor a flight: the seal pulls from its first vacuum on,
/// and guidance lands by another pressure.
TEST(AttachmentPressure, DecidesNoOutcome) {
    const auto at = [](const char* pressure_Pa) {
        return std::string("suction.attachment_pressure_Pa=") + pressure_Pa;
    };
    int perched = 0, failed = 0;
    for (const double speed_m_s : {0.5, 0.7, 0.9, 1.1}) {
        for (int seed = 1; seed <= 6; ++seed) {
            const auto ended_at = [&](const char* pressure_Pa) {
                return trace(model_of("pendulum_concrete",
                                      swing_at(speed_m_s,
                                               {"seed=" + std::to_string(seed), at(pressure_Pa)})))
                    .result.outcome;
            };
            const Outcome outcome = ended_at("88000");
            EXPECT_EQ(ended_at("75000"), outcome) << speed_m_s << " " << seed;
            EXPECT_EQ(ended_at("100000"), outcome) << speed_m_s << " " << seed;
            ++(outcome == Outcome::perched ? perched : failed);
        }
    }
    EXPECT_GT(perched, 4);
    EXPECT_GT(failed, 4);
    for (const char* pressure_Pa : {"75000", "100000"}) {
        const Trace flight = trace(model_of("perch_concrete", {at(pressure_Pa)}));
        EXPECT_EQ(flight.result.outcome, Outcome::released) << pressure_Pa;
        EXPECT_EQ(flight.first(EventName::landing_started),
                  flown("perch_concrete").first(EventName::landing_started));
    }
}

TEST(PendulumTrial, PerchesAndHoldsForHalfASecond) {
    const Trace& trial = flown("pendulum_concrete");
    EXPECT_EQ(trial.result.outcome, Outcome::perched);
    EXPECT_NEAR(trial.first(EventName::hold_over) - trial.first(EventName::attached), 0.5, 2e-3);
    // eq. (5) from the touch on: 0.151 s to 880 hPa, facts.md section 3
    EXPECT_NEAR(trial.result.metrics.time_to_land_pressure_s, 0.151, 0.01);
    EXPECT_EQ(trial.truth.back().thrust_N, 0.0);
    EXPECT_EQ(trial.result.metrics.energy_flying_Wh, 0.0);
}

TEST(PressRigTrial, PressureIsEquationsFiveAndSix) {
    const auto model = model_of("press_concrete");
    const suction::Surface& surface = model->scenario->wall.surface;
    Flight flight(model);
    double seal_s = -1.0;
    double leak_s = -1.0;
    double leak_from_Pa = 0.0;
    while (!flight.ended()) {
        flight.tick();
        const FlightState& state = flight.state();
        const double now_s = seconds(state.tick);
        const double p_Pa = state.cup.mean_pressure_Pa;
        if (state.cup.status.phase == CupPhase::sealing && seal_s < 0.0) {
            seal_s = now_s - kTick_s;
        }
        if (state.cup.status.phase == CupPhase::unsealing) {
            if (leak_s < 0.0) {
                leak_s = now_s;
                leak_from_Pa = p_Pa;
            }
            ASSERT_NEAR(p_Pa,
                        kAtmosphere_Pa -
                            (kAtmosphere_Pa - leak_from_Pa) *
                                std::exp(-(now_s - leak_s) / surface.unsealing_time_constant_s),
                        5.0);
        } else if (seal_s >= 0.0 && !flight.ended()) {
            ASSERT_NEAR(p_Pa,
                        surface.vacuum_pressure_Pa +
                            (kAtmosphere_Pa - surface.vacuum_pressure_Pa) *
                                std::exp(-(now_s - seal_s) / surface.sealing_time_constant_s),
                        150.0)  // it seals within a tick
                << now_s;
        }
    }
    EXPECT_GT(seal_s, 0.0);
    EXPECT_NEAR(leak_s - seal_s, 3.0, 0.02);
    EXPECT_EQ(flight.state().ending->outcome, Outcome::released);
}

TEST(PressRigTrial, PressesAsAskedAndHoldsStill) {
    const Trace& trial = flown("press_concrete");
    EXPECT_NEAR(trial.result.metrics.impact_force_N, 80.0, 0.02 * 80.0);
    for (const Truth& truth : trial.truth) {
        ASSERT_NEAR(pitch_deg(truth), 0.0, 0.5);
    }
}

TEST(PressRigTrial, EndsAsWhatItFound) {
    const auto outcome = [](const std::vector<std::string>& overrides) {
        return trace(model_of("press_metal", overrides)).result.outcome;
    };
    EXPECT_EQ(outcome({"press_rig.leak_s=0"}), Outcome::perched);
    EXPECT_EQ(outcome({"press_rig.leak_s=10"}), Outcome::perched);  // tau_2 is 16 s
    EXPECT_EQ(outcome({}), Outcome::released);
    EXPECT_EQ(outcome({"wall.surface=spalled_concrete"}), Outcome::failed_to_seal);
    EXPECT_EQ(outcome({"press_rig.start_gap_m=1", "press_rig.approach_speed_m_s=0.001",
                       "simulation.time_limit_s=3"}),
              Outcome::timed_out);
}

TEST(MountedTrial, ResumesBitExactly) {
    for (const auto& [scenario, cut_s] :
         {std::pair{"pendulum_concrete", 0.6}, std::pair{"pendulum_concrete", 1.2},
          std::pair{"press_concrete", 2.0}, std::pair{"press_concrete", 5.9}}) {
        const auto model = model_of(scenario);
        Flight flight(model);
        while (seconds(flight.state().tick) < cut_s) {
            flight.tick();
        }
        Flight other(model, 99);
        other.restore(flight.save());
        while (!other.ended()) {
            other.tick();
        }
        EXPECT_EQ(other.seen().hash, flown(scenario).result.state_hash) << cut_s;
    }
}

}  // namespace
}  // namespace limpet::simulation
