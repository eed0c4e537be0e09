// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limpet/limpet.hpp>

namespace {

void fly_until(limpet::Flight& flight, double time_s) {
    while (flight.time_s() < time_s && flight.tick()) {
    }
}

TEST(PublicFlight, IsTheFlightOfTheProgram) {
    limpet::Flight flight(limpet::load("perch_concrete"));
    const limpet::Result result = flight.fly();
    EXPECT_EQ(result.outcome, limpet::Outcome::released);
    EXPECT_EQ(result.state_hash, 0x7aebe0860aeb550eU);  // tests/simulation/golden_test.cpp
    EXPECT_EQ(result.attempts, 1);
    EXPECT_GT(result.metric("impact_force_N"), 10.0);
    EXPECT_FALSE(flight.tick());
}

TEST(PublicFlight, BranchesWithTheSameBits) {
    const limpet::Scenario scenario = limpet::load("perch_concrete");
    limpet::Flight flight(scenario);
    fly_until(flight, 5.3);  // in the middle of the touch
    const limpet::Moment moment = flight.save();
    const limpet::Result through = flight.fly();
    limpet::Flight branch(scenario, moment);
    const limpet::Result again = branch.fly();
    EXPECT_EQ(again.state_hash, through.state_hash);
    EXPECT_EQ(again.events.size(), through.events.size());
    EXPECT_NE(limpet::Flight(scenario.with({"wall.surface=metal"}), moment).fly().outcome,
              through.outcome);
}

TEST(PublicFlight, RecordsWhatReadsBack) {
    const auto file = std::filesystem::path(testing::TempDir()) / "public_flight.mcap";
    limpet::Flight flight(limpet::load("perch_concrete"));
    flight.record(file);
    const limpet::Result result = flight.fly();
    const limpet::Recording recording(file);
    EXPECT_EQ(recording.damage(), "");
    EXPECT_EQ(recording.events().size(), result.events.size());
    const limpet::Series pressure = recording.series("/cup", "pressure_Pa");
    EXPECT_NEAR(*std::min_element(pressure.values.begin(), pressure.values.end()),
                result.metric("pressure_min_Pa"), 50.0);
    EXPECT_THAT(recording.scenario_yaml(), testing::HasSubstr("mission: perch_and_take_off"));
    std::filesystem::remove(file);
}

/// What it throws.
template <class Call>
std::string error_of(Call&& call) {
    try {
        call();
    } catch (const limpet::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(PublicScenario, SaysInOneLineWhatIsWrong) {
    EXPECT_THAT(error_of([] { (void)limpet::load("perch_concret"); }),
                testing::HasSubstr("did you mean perch_concrete?"));
    EXPECT_THAT(error_of([] { (void)limpet::load("hover", {"autopilot.kind=cascad"}); }),
                testing::HasSubstr("\"cascad\": no such autopilot (did you mean cascade?)"));
    EXPECT_EQ(error_of([] { (void)limpet::load("hover", {"autopilot.kind=cascade"}); }), "");
    const limpet::Result nothing;
    EXPECT_THAT(error_of([&] { (void)nothing.metric("impact"); }),
                testing::HasSubstr("no such metric"));
    EXPECT_THAT(limpet::scenario_names(), testing::Contains("perch_metal_valve"));
}

TEST(Library, IsTheOneOfTheHeaders) {
    EXPECT_EQ(limpet::library_version(), limpet::kVersion);
}

}  // namespace
