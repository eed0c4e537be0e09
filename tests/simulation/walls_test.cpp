// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

/// Walls that the paper did not fly: wet, round, overhanging. Each against a closed form.
namespace limpet::simulation {
namespace {

/// A flight until it has rested for some seconds, and how it stood there.
struct Rested {
    FlightState state;
    double pitch_deg = 0.0;
};

Rested rested(const std::string& name) {
    constexpr double kRest_s = 3.0;
    Flight flight(build_model(scenario::load_scenario(name)));
    double since_s = -1.0;
    while (!flight.ended()) {
        flight.tick();
        const FlightState& state = flight.state();
        const bool rests = state.guidance.state == guidance::PerchingState::resting;
        since_s = !rests ? -1.0 : since_s < 0.0 ? seconds(state.tick) : since_s;
        if (rests && seconds(state.tick) - since_s > kRest_s) {
            return {state, degrees(euler_from_quaternion(state.truth.base.q_WF).pitch_rad)};
        }
    }
    ADD_FAILURE() << name << " never rested";
    return {};
}

TEST(Walls, WetMetalHoldsAsMuchShearAsItsFrictionSays) {
    const FlightState state = rested("perch_wet_metal").state;
    const CupStatus& cup = state.cup.status;
    const double vacuum_N = (kAtmosphere_Pa - cup.pressure_Pa) * kPi * 0.04 * 0.04;
    EXPECT_NEAR(cup.shear_margin_N, 0.25 * (vacuum_N - cup.pull_N) - cup.shear_N, 0.5);
    EXPECT_GT(cup.shear_margin_N, 0.0);
    EXPECT_LT(cup.shear_N, 3.2 * kGravity_m_s2);  // the legs carry some
}

TEST(Walls, AnOverhangTurnsTheRestByItsLean) {
    EXPECT_NEAR(rested("perch_overhang").pitch_deg, rested("perch_concrete").pitch_deg + 10.0, 0.3);
}

/// On a blade the tips of the legs, y to either side, go y^2 / 2R farther before they meet it.
TEST(Walls, ABladeTurnsTheRestByWhatTheLegsReach) {
    const vehicle::LegParameters legs;
    const vehicle::CupMountParameters cup;
    const double farther_m = legs.tip_y_m * legs.tip_y_m / (2.0 * 2.0);
    const double lever_m = std::hypot(cup.joint_x_m - legs.tip_x_m, legs.tip_z_m);
    EXPECT_NEAR(rested("perch_blade").pitch_deg - rested("perch_turbine_blade").pitch_deg,
                degrees(farther_m / lever_m), 0.15);
}

/// The lip comes out by the cup's pull over the wall's stiffness, each tip goes in by half of what
/// the legs push (the rest of the pull is idling rotors'); the vehicle turns by both over its
/// lever.
TEST(Walls, CladdingTurnsTheRestByWhatItYields) {
    const vehicle::LegParameters legs;
    const vehicle::CupMountParameters mount;
    const double lever_m = std::hypot(mount.joint_x_m - legs.tip_x_m, legs.tip_z_m);
    const double compliance_m_N = scenario::load_scenario("perch_cladding").wall.compliance_m_N;
    const Rested rigid = rested("perch_metal_valve"), cladding = rested("perch_cladding");
    const double pull_N = cladding.state.cup.status.pull_N;
    const double legs_N =
        pull_N - cladding.state.truth.thrust_N * std::sin(radians(cladding.pitch_deg));
    const double yields_m = (pull_N + 0.5 * legs_N) * compliance_m_N;
    EXPECT_GT(yields_m, 2e-3);
    EXPECT_NEAR(cladding.pitch_deg - rigid.pitch_deg, degrees(yields_m / lever_m), 0.03);
}

TEST(Walls, AllAreReleased) {
    for (const char* name : {"perch_wet_metal", "perch_blade", "perch_overhang", "perch_cladding",
                             "perch_swaying_blade"}) {
        EXPECT_EQ(fly(build_model(scenario::load_scenario(name))).outcome, Outcome::released)
            << name;
    }
}

}  // namespace
}  // namespace limpet::simulation
