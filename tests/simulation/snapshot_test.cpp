// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/snapshot.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/visit.hpp"

namespace limpet::simulation {
namespace {

void fly_until(Flight& flight, double time_s) {
    while (!flight.ended() && seconds(flight.state().tick) < time_s) {
        flight.tick();
    }
}

struct Cut {
    const char* scenario;
    std::vector<std::string> overrides;
    double time_s;
};

void PrintTo(const Cut& cut, std::ostream* out) {
    *out << cut.scenario << " at " << cut.time_s;
}

/// Nothing but bytes goes from one flight to the other: model, plant and state are made anew.
class ThroughBytes : public testing::TestWithParam<Cut> {};

TEST_P(ThroughBytes, ARunGoesOnWithTheSameBits) {
    const auto& [scenario, overrides, time_s] = GetParam();
    Flight flight(model_of(scenario, overrides));
    fly_until(flight, time_s);
    const std::vector<std::byte> bytes = to_bytes(flight.save());
    EXPECT_TRUE(to_bytes(snapshot_from(bytes)) == bytes);
    Flight other(model_of(scenario, overrides), 99);
    fly_until(other, 0.1);
    other.restore(snapshot_from(bytes));
    EXPECT_TRUE(to_bytes(other.save()) == bytes);
    fly_until(flight, 1e9);
    fly_until(other, 1e9);
    EXPECT_EQ(other.state().tick, flight.state().tick);
    EXPECT_EQ(other.state().ending->reason.view(), flight.state().ending->reason.view());
    EXPECT_TRUE(to_bytes(other.save()) == to_bytes(flight.save()));
    EXPECT_EQ(other.seen().hash, flight.seen().hash);
}

const std::vector<std::string> kAirMoves = {"environment.gust_sigma_m_s=0.3",
                                            "environment.recirculation_moment_rms_N_m=0.1"};

INSTANTIATE_TEST_SUITE_P(
    Moments, ThroughBytes,
    testing::Values(Cut{"perch_concrete", {}, 4.5}, Cut{"perch_concrete", {}, 5.2},
                    Cut{"perch_concrete", {}, 15.0}, Cut{"perch_concrete", kAirMoves, 11.5},
                    Cut{"perch_concrete", {"suction.pressure_model=pneumatic"}, 5.5},
                    Cut{"perch_concrete", {"vehicle.rotor.command_delay_s=0.02"}, 3.0},
                    Cut{"perch_payload", {}, 5.3}, Cut{"pendulum_concrete", {}, 0.7},
                    Cut{"press_concrete", {}, 2.0}));

TEST(Snapshot, DamagedBytesAreRefused) {
    Flight flight(model_of("hover"));
    std::vector<std::byte> bytes = to_bytes(flight.save());
    EXPECT_NO_THROW((void)snapshot_from(bytes));
    EXPECT_THROW((void)snapshot_from(std::span(bytes).first(bytes.size() - 8)), InputError);
    EXPECT_THROW((void)snapshot_from(std::span(bytes).first(5)), InputError);
    bytes[bytes.size() / 2] ^= std::byte{1};
    EXPECT_THROW((void)snapshot_from(bytes), InputError);
    bytes[0] ^= std::byte{1};
    EXPECT_THROW((void)snapshot_from(bytes), InputError);
}

TEST(Snapshot, ClassesForgetNoneOfTheirOwn) {
    // Without padding inside: what no leaf has is the tail at most.
    const auto unvisited_bytes = [](const auto& value) {
        std::size_t visited = 0;
        visit_leaves(value, [&visited](const auto& leaf) { visited += sizeof leaf; });
        return sizeof value - visited;
    };
    EXPECT_LT(unvisited_bytes(sensors::DelayLine<ForceReading>()), 8U);
    EXPECT_LT(unvisited_bytes(vehicle::standing(kMaxRotors)), 8U);
}

}  // namespace
}  // namespace limpet::simulation
