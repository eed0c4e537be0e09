// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flown.hpp"
#include "limpet/simulation/snapshot.hpp"

// Vehicles with other than four rotors.
namespace limpet::simulation {
namespace {

class OtherRotors : public testing::TestWithParam<std::pair<const char*, const char*>> {
protected:
    [[nodiscard]] static std::shared_ptr<const FlightModel> model(
        std::vector<std::string> more = {}, const char* scenario = "perch_concrete") {
        more.push_back(std::string("vehicle=") + GetParam().first);
        more.push_back(std::string("simulation.engine=") + GetParam().second);
        return model_of(scenario, more);
    }
};

TEST_P(OtherRotors, PerchRestAndAreReleased) {
    const auto vehicle = model();
    const std::size_t rotors = vehicle->airframe.rotors.size();
    EXPECT_GT(rotors, 4U);
    const Trace flight = trace(vehicle);
    const Metrics& m = flight.result.metrics;
    EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
    EXPECT_EQ(flight.result.attempts, 1);
    EXPECT_NEAR(m.impact_speed_m_s, 1.1, 0.1);
    EXPECT_LT(m.alignment_at_approach_deg, 2.0);
    EXPECT_LT(m.pressure_at_hold_end_Pa, 88000.0);
    EXPECT_GT(m.cup_margin_min_N, 0.0);
    EXPECT_LT(m.perched_pitch_spread_deg, 0.5);
    for (const Truth& truth : flight.truth) {
        ASSERT_EQ(truth.rotor_speed_rad_s.size(), rotors);
    }
    // all of them carry it before the wall, all of them stand while it rests
    const auto slowest = [](const Truth& truth) {
        return *std::min_element(truth.rotor_speed_rad_s.begin(), truth.rotor_speed_rad_s.end());
    };
    const auto fastest = [](const Truth& truth) {
        return *std::max_element(truth.rotor_speed_rad_s.begin(), truth.rotor_speed_rad_s.end());
    };
    EXPECT_GT(flight.mean(guidance::PerchingState::approaching, slowest), 400.0);
    EXPECT_LT(fastest(flight.truth[static_cast<std::size_t>(
                  100.0 * (flight.first(EventName::motors_on) - 0.1))]),
              1.0);
}

TEST_P(OtherRotors, HoverAtTheirHoverCommand) {
    const auto vehicle = model({}, "hover");
    const Trace flight = trace(vehicle);
    EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
    const double hover_rad_s =
        vehicle->airframe.rotor.speed_offset_rad_s +
        vehicle->airframe.rotor.speed_scale_rad_s * hover_command(vehicle->airframe);
    const Truth& end = flight.truth.back();
    for (const double speed_rad_s : end.rotor_speed_rad_s) {
        EXPECT_NEAR(speed_rad_s, hover_rad_s, 0.1 * hover_rad_s);
    }
    EXPECT_NEAR(end.thrust_N, vehicle->airframe.mass_kg * kGravity_m_s2, 1.0);
}

TEST_P(OtherRotors, ASavedFlightGoesOnWithTheSameBits) {
    const auto vehicle = model();
    Flight whole(vehicle);
    Flight other(vehicle);
    for (int k = 0; k < 3000; ++k) {
        (void)whole.tick();
    }
    other.restore(snapshot_from(to_bytes(whole.save())));
    for (int k = 0; k < 1000; ++k) {
        (void)whole.tick();
        (void)other.tick();
    }
    EXPECT_EQ(whole.seen().hash, other.seen().hash);
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, OtherRotors,
    testing::Values(std::pair("perching_hexa", "reduced"), std::pair("perching_hexa", "mujoco"),
                    std::pair("perching_x8", "reduced"), std::pair("perching_x8", "mujoco")),
    [](const auto& row) { return std::string(row.param.first) + "_" + row.param.second; });

/// Its ropes are as many as they are, whatever the rotors.
TEST(PendulumOfAHexarotor, HangsLevelAndMeetsTheWallAtItsSpeed) {
    const Trace swing = trace(model_of("pendulum_concrete", {"vehicle=perching_hexa"}));
    EXPECT_NEAR(swing.result.metrics.impact_speed_m_s, 1.1, 0.03);
}

TEST(CoaxialPairs, HoverByWhatTheWakeLeaves) {
    const auto vehicle = model_of("hover", {"vehicle=perching_x8"});
    EXPECT_NEAR(vehicle::lifting_rotors(vehicle->airframe), 4.0 * 1.7, 1e-12);
    EXPECT_NEAR(vehicle->autopilot.vehicle.hover_thrust, 0.5517, 1e-3);
}

/// With speeds that follow the voltage a hover's command rises as the pack empties: at the same
/// speed (offset + scale u) V stays.
TEST(VoltageInTheLoop, AHoversCommandRisesAsTheVoltageFalls) {
    struct Hover {
        double command, voltage_V, speed_rad_s;
    };
    const auto hover = [](const char* charge) {
        const auto model =
            model_of("hover", {"vehicle.rotor.speed_follows_voltage=true",
                               std::string("vehicle.battery.initial_charge=") + charge,
                               "simulation.hover_s=4"});
        Flight flight(model);
        Hover mean{};
        int count = 0;
        while (!flight.ended()) {
            flight.tick();
            const FlightState& state = flight.state();
            EXPECT_NEAR(state.truth.base.p_WF_m.z(), 0.0, 0.05);  // begins in trim
            if (seconds(state.tick) > 2.0) {
                mean.command += state.command.command[0];
                mean.voltage_V += state.battery.voltage_V;
                mean.speed_rad_s += state.rotors.speed_rad_s[0];
                ++count;
            }
        }
        return Hover{mean.command / count, mean.voltage_V / count, mean.speed_rad_s / count};
    };
    const Hover full = hover("1"), low = hover("0.1");
    EXPECT_LT(low.voltage_V, full.voltage_V - 2.0);
    EXPECT_NEAR(low.speed_rad_s, full.speed_rad_s, 2.0);
    const auto told = [](const Hover& at) { return 100.0 + 700.0 * at.command; };
    EXPECT_NEAR(told(low) / told(full), full.voltage_V / low.voltage_V, 2e-3);
}

}  // namespace
}  // namespace limpet::simulation
