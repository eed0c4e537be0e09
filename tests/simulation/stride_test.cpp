// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/stride.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "flown.hpp"
#include "limpet/plant/engines.hpp"

namespace limpet::simulation {
namespace {

int longest(const FlightModel& model) {
    return *std::max_element(model.strides.begin(), model.strides.end());
}

/// Every sample, decision and record has a tick of its own, in any second of a flight.
TEST(Stride, EndsWhereverAnybodyLooks) {
    const auto model = model_of("hover", {"sensors.mocap_rate_Hz=120", "sensors.force_rate_Hz=77"});
    ASSERT_EQ(longest(*model), 4);
    const auto rates_Hz = sensors::rates_Hz(model->sensors.parameters);
    Tick at = 0;
    while (at < 3 * kTicksPerSecond) {
        const Tick next = at + model->strides[static_cast<std::size_t>(at % kTicksPerSecond)];
        for (Tick passed = at + 1; passed < next; ++passed) {
            for (const int rate_Hz : rates_Hz) {
                EXPECT_FALSE(rate_Hz > 0 && due(passed, rate_Hz)) << passed << ": " << rate_Hz;
            }
            EXPECT_FALSE(due(passed, model->guidance_rate_Hz) ||
                         due(passed, model->record_rate_Hz));
        }
        at = next;
    }
    EXPECT_EQ(at, 3 * kTicksPerSecond);
}

/// Who steps by ticks: other engines, a bench, whoever asks for it.
TEST(Stride, IsATickWhereLongStepsAreNotAsGood) {
    EXPECT_EQ(longest(*model_of("perch_concrete")), 4);
    EXPECT_EQ(longest(*model_of("perch_concrete", {"simulation.longest_step_s=0.002"})), 2);
    EXPECT_EQ(longest(*model_of("perch_concrete", {"simulation.longest_step_s=0.001"})), 1);
    EXPECT_EQ(longest(*model_of("perch_concrete", {"simulation.step_s=0.00025"})), 1);
    EXPECT_EQ(longest(*model_of("pendulum_concrete")), 1);
    for (const plant::Engine* engine : plant::engines()) {
        const auto model =
            model_of("perch_concrete", {"simulation.engine=" + std::string(engine->name)});
        EXPECT_EQ(longest(*model), engine == &plant::kReducedEngine ? 4 : 1) << engine->name;
    }
}

TEST(Stride, IsATickBesideAWallThatIsNotHeld) {
    const auto model = model_of("perch_concrete");
    const auto plant = model->plant->make();
    FlightState state = start(*model, *plant);
    state.tick = 200;  // a look at 204, none before
    state.cup.status.gap_m = 1.0;
    EXPECT_EQ(next_stride(*model, state).ticks, 4);
    state.cup.status.gap_m = 0.2;
    EXPECT_EQ(next_stride(*model, state).ticks, 1);
    state.cup.status.gap_m = 0.01;
    EXPECT_EQ(next_stride(*model, state).ticks, 1);
    EXPECT_EQ(next_stride(*model, state).steps, 4);
    state.cup.status.phase = CupPhase::touching;
    EXPECT_EQ(next_stride(*model, state).ticks, 1);
    state.cup.status.phase = CupPhase::attached;
    EXPECT_EQ(next_stride(*model, state).ticks, 4);
    state.fine_until = 300;
    EXPECT_EQ(next_stride(*model, state).ticks, 1);
}

/// What carries a stamp is of that time: the lip's gap too, in strides, ticks and sub-steps, from
/// the first instant on.
TEST(Stride, TheGapIsThatOfItsStamp) {
    for (const char* scenario : {"perch_concrete", "perch_blade"}) {
        Flight flight(model_of(scenario));
        const WallGeometry& wall = flight.model().cup.wall;
        const auto error_m = [&flight, &wall] {
            const Truth& truth = flight.state().truth;
            return std::abs(truth.cup_status.gap_m - before_wall_m(wall, truth.cup.p_WF_m));
        };
        double worst_m = error_m(), moved_m = 0.0;
        while (!flight.ended() && flight.state().tick < 12 * kTicksPerSecond) {
            (void)flight.tick();
            const FlightState& state = flight.state();
            worst_m = std::max(worst_m, error_m());
            moved_m = std::max(moved_m, std::abs(state.cup.status.gap_m -
                                                 before_wall_m(wall, state.truth.cup.p_WF_m)));
        }
        EXPECT_LT(worst_m, 1e-12) << scenario;
        EXPECT_GT(moved_m, 1e-3) << scenario;  // between the cup's last step and now
    }
}

/// The same decisions, loads within a hundredth: on every surface, and with the motors that swing.
/// Guidance decides every 20 ms, and when it is steady enough hangs on noise: after two docking
/// runs three of its periods have been seen between them.
TEST(Stride, EndsAsTickByTick) {
    struct Case {
        const char* scenario;
        double apart_s;
    };
    for (const auto& [name, apart_s] :
         {Case{"perch_concrete", 0.021}, Case{"perch_metal_valve", 0.045},
          Case{"perch_cinder_block", 0.045}, Case{"failed_perch", 0.065},
          Case{"slow_motors_concrete", 0.045}, Case{"perch_payload", 0.021}}) {
        const FlightResult strides = fly(model_of(name));
        const FlightResult ticks = fly(model_of(name, {"simulation.longest_step_s=0.001"}));
        EXPECT_EQ(strides.outcome, ticks.outcome) << name;
        EXPECT_LT(strides.performance.physics_steps, 7 * ticks.performance.physics_steps / 10);
        ASSERT_EQ(strides.events.size(), ticks.events.size()) << name;
        for (std::size_t i = 0; i < ticks.events.size(); ++i) {
            EXPECT_EQ(strides.events[i].name, ticks.events[i].name);
            EXPECT_NEAR(strides.events[i].time_s, ticks.events[i].time_s, apart_s) << name << i;
        }
        const auto near = [&, name = name](double Metrics::*metric, double share) {
            EXPECT_NEAR(strides.metrics.*metric / (ticks.metrics.*metric), 1.0, share) << name;
        };
        near(&Metrics::impact_force_N, 0.01);
        near(&Metrics::cup_press_max_N, 0.01);
        near(&Metrics::perched_pitch_deg, 0.001);
    }
}

}  // namespace
}  // namespace limpet::simulation
