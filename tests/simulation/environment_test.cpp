// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

/// 4 lambda_1 w v = m g tan(pitch): nobody tells the autopilot, it finds the angle itself.
TEST(WindInTheLoop, AHoverLeansIntoTheWindByWhatTheRotorsDragAsks) {
    const auto model =
        model_of("hover", {"environment.wind_speed_m_s=2", "environment.wind_from_deg=0",
                           "simulation.start_yaw_deg=0", "simulation.hover_s=20"});
    Flight flight(model);
    double pitch = 0.0;
    int count = 0;
    while (!flight.ended()) {
        flight.tick();
        if (seconds(flight.state().tick) > 15.0) {
            pitch += pitch_deg(flight.state().truth);
            ++count;
        }
    }
    const vehicle::Airframe& airframe = model->scenario->airframe;
    const double weight_N = airframe.mass_kg * kGravity_m_s2;
    const double speed_rad_s = std::sqrt(weight_N / 4.0 / airframe.rotor.motor_constant_kg_m);
    const double drag_N = 4.0 * airframe.rotor.drag_constant_kg * speed_rad_s * 2.0;
    EXPECT_NEAR(pitch / count, -degrees(std::atan(drag_N / weight_N)), 0.3);  // nose down, north
}

TEST(WindInTheLoop, GustsAreTheSameForTheSameSeed) {
    const std::vector<std::string> gusty = {"environment.gust_sigma_m_s=0.5",
                                            "simulation.hover_s=3"};
    const auto hash = [&](std::uint64_t seed) {
        return fly(model_of("hover", gusty, seed)).state_hash;
    };
    EXPECT_EQ(hash(1), hash(1));
    EXPECT_NE(hash(1), hash(2));
    EXPECT_NE(hash(1), fly(model_of("hover", {"simulation.hover_s=3"})).state_hash);
}

TEST(WindInTheLoop, ThePerchedVehicleStandsACrosswindAndATailWind) {
    for (const char* surface : {"metal", "porous_concrete"}) {
        for (const char* from : {"90", "180", "315"}) {
            const Trace flight = trace(
                model_of("perch_metal_valve",
                         {std::string("wall.surface=") + surface, "environment.wind_speed_m_s=3",
                          std::string("environment.wind_from_deg=") + from}));
            EXPECT_EQ(flight.result.outcome, Outcome::released)
                << surface << " " << from << ": " << flight.result.reason;
        }
    }
}

TEST(WindInTheLoop, MoreThanItCanLeanAgainstIsDeclined) {
    const Trace flight = trace(model_of(
        "perch_concrete", {"environment.wind_speed_m_s=6.5", "environment.wind_from_deg=90"}));
    EXPECT_EQ(flight.result.outcome, Outcome::aborted);
    EXPECT_EQ(flight.result.reason,
              "too much wind along the wall: at rest it would tip over a leg");
    EXPECT_EQ(flight.result.attempts, 0);
}

TEST(WindInTheLoop, BetweenWhatItFliesAndDeclinesNothingHitsTheWall) {
    for (const char* speed : {"6.5", "7"}) {
        for (const char* from : {"45", "135", "315"}) {
            const Trace flight = trace(
                model_of("perch_metal_valve", {std::string("environment.wind_speed_m_s=") + speed,
                                               std::string("environment.wind_from_deg=") + from}));
            EXPECT_NE(flight.result.outcome, Outcome::crashed) << speed << " from " << from;
        }
    }
}

/// From the first wind to those that it declines, along the wall from both sides: no vehicle is
/// carried into the wall, and each flies what the page on wind says.
TEST(WindInTheLoop, EveryVehicleStandsACrosswindOrDeclinesIt) {
    struct Case {
        const char* vehicle;
        const char* speed;
        Outcome outcome;
    };
    for (const auto& [vehicle, speed, outcome] : {Case{"perching_x8", "3", Outcome::released},
                                                  Case{"perching_x8", "3.5", Outcome::released},
                                                  Case{"perching_x8", "4.5", Outcome::aborted},
                                                  Case{"perching_hexa", "4", Outcome::released},
                                                  Case{"perching_hexa", "4.5", Outcome::aborted},
                                                  Case{"perching_uav", "4.5", Outcome::released},
                                                  Case{"perching_uav", "5.5", Outcome::aborted}}) {
        for (const char* from : {"90", "270"}) {
            const Trace flight = trace(
                model_of("perch_metal_valve", {std::string("vehicle=") + vehicle,
                                               std::string("environment.wind_speed_m_s=") + speed,
                                               std::string("environment.wind_from_deg=") + from}));
            SCOPED_TRACE(std::string(vehicle) + " " + speed + " m/s from " + from);
            EXPECT_EQ(flight.result.outcome, outcome) << flight.result.reason;
            EXPECT_EQ(flight.result.attempts, outcome == Outcome::released ? 1 : 0);
        }
    }
}

/// It pitches up in the plane that the lip holds, and never leans over one leg.
TEST(WindInTheLoop, OnTheWallBothLegsMeetIt) {
    const auto model = model_of(
        "perch_metal_valve",
        {"vehicle=perching_x8", "environment.wind_speed_m_s=3", "environment.wind_from_deg=90"});
    const Trace flight = trace(model);
    double most_deg = 0.0;
    for (std::size_t i = 0; i < flight.truth.size(); ++i) {
        if (flight.state[i] == guidance::PerchingState::pitching_up ||
            flight.state[i] == guidance::PerchingState::resting) {
            const Vector3 n_B = flight.truth[i].base.q_WF.conjugate() * Vector3::UnitX();
            most_deg = std::max(most_deg, std::abs(degrees(std::asin(n_B.y()))));
        }
    }
    EXPECT_LT(most_deg, 6.0);  // 16 when it was held below the cup, and a propeller hit the wall
}

TEST(WindInTheLoop, InGustsItIsPatientAndLeaves) {
    const auto released = [](const std::string& rms, const char* from) {
        return trace(model_of("perch_metal_valve",
                              {"environment.wind_speed_m_s=2", "environment.gust_sigma_m_s=" + rms,
                               std::string("environment.wind_from_deg=") + from}))
                   .result.outcome == Outcome::released;
    };
    int in_strong_ones = 0;
    for (const char* from : {"0", "90", "180", "270"}) {
        EXPECT_TRUE(released("0.5", from)) << from;
        in_strong_ones += released("1", from) ? 1 : 0;
    }
    EXPECT_GE(in_strong_ones, 3);
}

TEST(WindInTheLoop, ACrosswindThatBeginsOnTheWallIsStood) {
    for (const char* phase :
         {"holding", "pitching_up", "unloading", "pitching_down", "releasing"}) {
        const Trace flight =
            trace(model_of("perch_metal_valve", {std::string("faults={fault: gust_across, size: "
                                                             "2.5, phase: ") +
                                                 phase + "}"}));
        EXPECT_EQ(flight.result.outcome, Outcome::released) << phase << flight.result.reason;
    }
    for (const char* phase : {"unloading", "resting", "spinning_up", "pitching_down"}) {
        const Trace flight = trace(
            model_of("perch_metal_valve",
                     {std::string("faults={fault: gust_across, size: 4, phase: ") + phase + "}"}));
        EXPECT_NE(flight.result.outcome, Outcome::crashed) << phase << flight.result.reason;
    }
}

TEST(WindInTheLoop, AResumedRunGoesOnInTheSameGusts) {
    const auto model =
        model_of("perch_concrete",
                 {"environment.gust_wind_m_s=2", "environment.recirculation_moment_rms_N_m=0.03"});
    Flight flight(model);
    while (seconds(flight.state().tick) < 5.2) {
        flight.tick();
    }
    const Snapshot snapshot = flight.save();
    while (!flight.ended()) {
        flight.tick();
    }
    Flight other(model, 99);
    other.restore(snapshot);
    while (!other.ended()) {
        other.tick();
    }
    EXPECT_EQ(other.seen().hash, flight.seen().hash);
}

TEST(WallInTheLoop, PerchesWithTheAirOfTheWall) {
    const Trace flight = trace(model_of("perch_concrete", {"environment.wall_aerodynamics=true"}));
    EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
    EXPECT_NE(flight.result.state_hash, flown("perch_concrete").result.state_hash);
}

/// Away from the wall the air of the wall does nothing: the same bits as without.
TEST(WallInTheLoop, FarFromTheWallNothingChanges) {
    const std::vector<std::string> far = {"mission=hover", "wall.surface=metal",
                                          "simulation.hover_s=3"};
    std::vector<std::string> with_air = far;
    with_air.push_back("environment.wall_aerodynamics=true");
    with_air.push_back("environment.recirculation_moment_rms_N_m=0.1");
    EXPECT_EQ(fly(model_of("hover", far)).state_hash, fly(model_of("hover", with_air)).state_hash);
}

TEST(WallInTheLoop, RecirculationShakesTheVehicleThatWaitsAtTheWall) {
    const auto swing_deg = [](const char* rms) {
        return trace(model_of("perch_metal",
                              {std::string("environment.recirculation_moment_rms_N_m=") + rms}))
            .result.metrics.pitch_oscillation_max_deg;
    };
    EXPECT_GT(swing_deg("0.1"), 1.5 * swing_deg("0"));
}

}  // namespace
}  // namespace limpet::simulation
