// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"
#include "limpet/simulation/flight_log.hpp"
#include "tests/support/allocations.hpp"

namespace limpet::simulation {
namespace {

TEST(SteadyState, TheLoopAllocatesNothing) {
    Flight flight(model_of("perch_concrete"));
    flight.tick();
    const long before = allocations();
    while (!flight.ended()) {
        flight.tick();
    }
    EXPECT_EQ(allocations() - before, 0);
}

TEST(SteadyState, NorDoesATrialOnAMount) {
    for (const char* scenario : {"pendulum_concrete", "press_concrete"}) {
        Flight flight(model_of(scenario, {"environment.gust_sigma_m_s=0.5"}));
        flight.tick();
        const long before = allocations();
        while (!flight.ended()) {
            flight.tick();
        }
        EXPECT_EQ(allocations(), before) << scenario;
    }
}

TEST(SteadyState, NorDoesThePneumaticCup) {
    Flight flight(model_of("perch_concrete", {"suction.pressure_model=pneumatic"}));
    flight.tick();
    const long before = allocations();
    while (!flight.ended()) {
        flight.tick();
    }
    EXPECT_EQ(allocations() - before, 0);
}

TEST(SteadyState, NorDoesTheRecorder) {
    const auto model = model_of("perch_concrete");
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "steady_state.mcap";
    FlightLog log(path, *model, {});
    Flight flight(model);
    const auto tick = [&] {
        const guidance::EventList& events = flight.tick();
        log.tick(*model, flight.state(), events);
    };
    tick();
    const long before = allocations();
    while (!flight.ended()) {
        tick();
    }
    // The index of chunks grows by the doubling of a few vectors, not by the message.
    EXPECT_LT(allocations() - before, 64);
    log.finish("{}");
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace limpet::simulation
