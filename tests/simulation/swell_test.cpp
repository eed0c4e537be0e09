// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "flown.hpp"
#include "limpet/simulation/advance.hpp"

namespace limpet::simulation {
namespace {

const std::vector<std::string> kSea = {
    "environment.swell_into_wall_m=0.4", "environment.swell_along_wall_m=0.3",
    "environment.swell_up_m=0.5", "environment.swell_period_s=4"};

/// With its rotors at rest, from the start, for a second.
Truth fallen(const std::string& engine, bool sea) {
    std::vector<std::string> changes = {"simulation.engine=" + engine,
                                        "simulation.start_height_m=50"};
    if (sea) {
        changes.insert(changes.end(), kSea.begin(), kSea.end());
    }
    const auto model = model_of("perch_concrete", changes);
    const auto plant = model->plant->make();
    FlightState state = start(*model, *plant);
    std::fill(state.rotors.speed_rad_s.begin(), state.rotors.speed_rad_s.end(), 0.0);
    TickReport report;
    while (state.tick < kTicksPerSecond) {
        const Stride stride = one_tick(*model, state);
        advance(*model, state, *plant, stride, report);
        state.tick += stride.ticks;
        see_motion(*model, state.truth, *plant);
    }
    return state.truth;
}

/// A body that nothing holds does not know of the sea: against the earth it falls as ever, its
/// joints stay as they are.
TEST(Swell, AFallingVehicleDoesNotKnowOfIt) {
    for (const std::string engine : {"reduced", "mujoco"}) {
        SCOPED_TRACE(engine);
        const Truth calm = fallen(engine, false), sea = fallen(engine, true);
        const auto model = model_of("perch_concrete", kSea);
        const Vector3 moved_W_m = swell_motion(model->swell, 1.0).p_EW_W_m;
        EXPECT_GT(moved_W_m.norm(), 0.5);
        EXPECT_LT((sea.base.p_WF_m + moved_W_m - calm.base.p_WF_m).norm(), 2e-3);  // steps of 1 ms
        EXPECT_NEAR(sea.slider.position_m, calm.slider.position_m, 1e-6);
        EXPECT_NEAR(sea.slider.force_N, calm.slider.force_N, 1e-3);
    }
}

/// At rest on the hull cup and legs bear the weight and what it takes to go along: m (g + a).
TEST(Swell, OnTheHullCupAndLegsLiftTheVehicleAlong) {
    constexpr double kHeave_m = 0.3, kPeriod_s = 6.0;
    Flight flight(model_of(
        "perch_metal_valve",
        {"environment.swell_up_m=0.3", "environment.swell_period_s=6", "guidance.rest_s=14"}));
    const double turn = 2.0 * kPi / kPeriod_s;
    double by_wave = 0.0, squares = 0.0, sum = 0.0, count = 0.0;
    while (!flight.ended()) {
        (void)flight.tick();
        const FlightState& state = flight.state();
        const double rested_s = seconds(state.tick) - state.guidance.since_s;
        if (state.guidance.state != guidance::PerchingState::resting || rested_s < 1.0 ||
            rested_s > 1.0 + 2.0 * kPeriod_s) {
            continue;
        }
        const double wave = std::cos(turn * seconds(state.tick));
        const double borne_N = state.cup.status.shear_N - flight.plant().contact_force_W().z();
        by_wave += wave * borne_N;
        squares += wave * wave;
        sum += borne_N;
        ++count;
    }
    EXPECT_EQ(flight.state().ending->outcome, Outcome::released);
    ASSERT_GT(count, 1000.0);
    const double mass_kg = flight.model().airframe.mass_kg;
    EXPECT_NEAR(sum / count, mass_kg * kGravity_m_s2, 0.02 * mass_kg * kGravity_m_s2);
    const double along_N = mass_kg * kHeave_m * turn * turn;
    EXPECT_NEAR(by_wave / squares, along_N, 0.05 * along_N);
}

/// A vehicle that stays with the hull is lifted with it: by GPS, barometer, and the sum of what the
/// IMU felt.
TEST(Swell, ImuGpsAndBarometerMeasureAgainstTheEarth) {
    constexpr double kHeave_m = 1.0, kPeriod_s = 4.0;
    Flight flight(model_of("hover", {"environment.swell_up_m=1", "environment.swell_period_s=4",
                                     "simulation.hover_s=9", "sensors.gps_noise_vertical_m=0",
                                     "sensors.gps_drift_vertical_m=0", "sensors.gps_latency_s=0",
                                     "sensors.baro_noise_Pa=0", "sensors.baro_bias_Pa=0"}));
    double gps_most_m = 0.0, baro_most_m = 0.0, felt_m_s = 0.0, last_s = 0.0;
    double began_up_m_s = kNaN, ended_up_m_s = kNaN;
    while (!flight.ended()) {
        (void)flight.tick();
        const FlightState& state = flight.state();
        const Readings& read = state.sensors.readings;
        const Kinematics& base = state.truth.base;
        gps_most_m = std::max(gps_most_m, base.p_WF_m.z() - read.gps.value.p_WB_m.z());
        baro_most_m = std::max(baro_most_m, base.p_WF_m.z() + read.barometer.value.altitude_m);
        // From rest on the wave to its fastest.
        const double time_s = read.imu.time_s;
        if (time_s > kPeriod_s && time_s < 1.25 * kPeriod_s && time_s > last_s) {
            if (last_s > 0.0) {
                const Vector3 felt_W_m_s2 = base.q_WF * read.imu.value.specific_force_B_m_s2;
                felt_m_s -= (felt_W_m_s2.z() + kGravity_m_s2) * (time_s - last_s);
            } else {
                began_up_m_s = -base.v_WF_W_m_s.z();
            }
            ended_up_m_s = -base.v_WF_W_m_s.z();
            last_s = time_s;
        }
    }
    EXPECT_NEAR(gps_most_m, 2.0 * kHeave_m, 0.01);
    EXPECT_NEAR(baro_most_m, 2.0 * kHeave_m, 0.05);
    const double wave_m_s = kHeave_m * 2.0 * kPi / kPeriod_s;
    EXPECT_NEAR(felt_m_s, wave_m_s + ended_up_m_s - began_up_m_s, 0.03 * wave_m_s);
}

}  // namespace
}  // namespace limpet::simulation
