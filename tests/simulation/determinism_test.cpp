// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "../support/files.hpp"
#include "flown.hpp"

namespace limpet::simulation {
namespace {

TEST(Determinism, SameScenarioAndSeedGiveTheSameBytes) {
    const std::filesystem::path folder = testing::TempDir();
    const auto fly_once = [&](const char* name) {
        return fly(model_of("perch_concrete", {}, 3), folder / name);
    };
    const FlightResult a = fly_once("determinism_a.mcap");
    const FlightResult b = fly_once("determinism_b.mcap");
    EXPECT_EQ(a.state_hash, b.state_hash);
    const std::string bytes = load_text(a.recording);
    EXPECT_GT(bytes.size(), 100000U);
    EXPECT_TRUE(bytes == load_text(b.recording));
    std::filesystem::remove(a.recording);
    std::filesystem::remove(b.recording);
}

TEST(Determinism, RecordingDoesNotChangeTheFlight) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "determinism_c.mcap";
    EXPECT_EQ(fly(model_of("hover"), path).state_hash, fly(model_of("hover")).state_hash);
    std::filesystem::remove(path);
}

TEST(Determinism, AnotherSeedIsAnotherFlight) {
    EXPECT_NE(fly(model_of("hover", {}, 1)).state_hash, fly(model_of("hover", {}, 2)).state_hash);
}

TEST(Determinism, ThreadsShareOneModel) {
    const auto model = model_of("perch_concrete");
    std::array<std::uint64_t, 2> hashes{};
    std::thread first([&] { hashes[0] = fly(model).state_hash; });
    std::thread second([&] { hashes[1] = fly(model).state_hash; });
    first.join();
    second.join();
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], flown("perch_concrete").result.state_hash);
}

/// In the docking run, in the touch with its sub-steps, landing with legs in contact, at rest,
/// waiting for the release.
class SavedAt : public testing::TestWithParam<double> {};

TEST_P(SavedAt, AResumedRunEndsWithTheSameHash) {
    const auto model = model_of("perch_concrete");
    Flight flight(model);
    while (seconds(flight.state().tick) < GetParam()) {
        flight.tick();
    }
    const Snapshot snapshot = flight.save();
    while (!flight.ended()) {
        flight.tick();
    }
    Flight other(model, 99);  // its own start is forgotten
    for (int k = 0; k < 100; ++k) {
        other.tick();
    }
    other.restore(snapshot);
    while (!other.ended()) {
        other.tick();
    }
    EXPECT_EQ(other.seen().hash, flight.seen().hash);
    EXPECT_EQ(other.state().tick, flight.state().tick);
    EXPECT_EQ(flight.seen().hash, flown("perch_concrete").result.state_hash);
}

INSTANTIATE_TEST_SUITE_P(Times, SavedAt, testing::Values(1.0, 4.5, 5.2, 11.5, 15.0, 26.9));

TEST(Snapshot, BranchesGoTheirOwnWays) {
    const auto concrete = model_of("perch_concrete");
    Flight flight(concrete);
    while (seconds(flight.state().tick) < 4.0) {
        flight.tick();
    }
    const Snapshot snapshot = flight.save();
    const auto ends_on = [&](const char* surface) {
        Flight branch(model_of("perch_concrete", {std::string("wall.surface=") + surface}));
        branch.restore(snapshot);
        while (!branch.ended()) {
            branch.tick();
        }
        return branch.state().ending->outcome;
    };
    EXPECT_EQ(ends_on("porous_concrete"), Outcome::released);
    EXPECT_EQ(ends_on("metal"), Outcome::release_aborted);
    EXPECT_EQ(ends_on("spalled_concrete"), Outcome::failed_to_seal);
}

}  // namespace
}  // namespace limpet::simulation
