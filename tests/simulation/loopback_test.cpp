// SPDX-License-Identifier: Apache-2.0
#include "loopback.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>

#include "../support/files.hpp"
#include "flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/simulation/bring_up.hpp"
#include "limpet/simulation/px4_setup.hpp"

namespace limpet::simulation {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<EventName> names(const FlightResult& result) {
    std::vector<EventName> list;
    for (const Event& event : result.events) {
        list.push_back(event.name);
    }
    return list;
}

FlightResult fly_behind_wire(const std::shared_ptr<const FlightModel>& model, Loopback& loopback,
                             const std::filesystem::path& recording = {},
                             const FlightWatch& watch = {}) {
    return fly(model, recording, watch, 0, {.outside = {.autopilot = &loopback.autopilot()}});
}

FlightResult fly_behind_wire(const std::string& scenario) {
    const auto model = model_of(scenario);
    Loopback loopback(*model);
    return fly_behind_wire(model, loopback);
}

class LoopbackFile : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const {
        std::filesystem::create_directories(folder_);
        return folder_ / name;
    }

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    ("limpet_loopback_" + std::to_string(getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

class Scenarios : public testing::TestWithParam<const char*> {};

TEST_P(Scenarios, EndBehindTheWireAsWithoutIt) {
    const FlightResult behind = fly_behind_wire(GetParam());
    const FlightResult without = fly(model_of(GetParam()));
    EXPECT_EQ(behind.outcome, without.outcome) << behind.reason;
    EXPECT_EQ(behind.reason, without.reason);
    EXPECT_EQ(behind.attempts, without.attempts);
    EXPECT_EQ(names(behind), names(without));
}

INSTANTIATE_TEST_SUITE_P(Loopback, Scenarios,
                         testing::Values("hover", "perch_concrete", "perch_metal",
                                         "perch_metal_valve", "failed_perch"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Loopback, FliesEightRotorsBehindTheWire) {
    const auto model = model_of("perch_concrete", {"vehicle=perching_x8"});
    Loopback loopback(*model);
    const FlightResult behind = fly_behind_wire(model, loopback);
    EXPECT_EQ(behind.outcome, Outcome::released) << behind.reason;
}

/// PX4 v1.16 may not be armed for a moment after an origin that comes after its poses, and main
/// since 2026-06-29 is thrown off by it for good: it has it before them.
TEST(Loopback, TheOriginComesBeforeThePoses) {
    const auto model = model_of("hover");
    px4::StandInOptions options = Loopback::perching();
    options.origin_unsettles_s = 3.4;
    options.origin_throws_m = 5'227'320.0;
    Loopback loopback(*model, options);
    const FlightResult result = fly_behind_wire(model, loopback);
    EXPECT_EQ(result.outcome, Outcome::released) << result.reason;
    loopback.stand_in().end();
    const px4::StandInFlight& flight = loopback.stand_in().stand_in().flight();
    EXPECT_TRUE(flight.origin);
    EXPECT_EQ(flight.unsettled_until_s, 0.0);
    EXPECT_EQ(flight.thrown_north_m, 0.0);
    EXPECT_THAT(loopback.texts, Not(Contains(HasSubstr("Arming denied"))));
}

/// Another gives an origin after the poses.
TEST(Loopback, AnEstimateElsewhereThanTheMotionCaptureIsNotArmed) {
    const auto model = model_of("hover");
    px4::StandInOptions thrown = Loopback::perching();
    thrown.origin_throws_m = 5'227'320.0;
    Loopback loopback(*model, thrown, false);
    std::vector<std::string> obstacles;
    BringUp options;
    options.limit_s = 12.0;
    options.on_obstacle = [&](const std::string& text) {
        if (text == "the autopilot is not in OFFBOARD mode yet") {
            (void)loopback.companion().send(mavlink::SetGpsGlobalOrigin{.target_system = 1});
        }
        obstacles.push_back(text);
    };
    EXPECT_THROW((void)bring_up(*model, {.autopilot = &loopback.autopilot()}, options), InputError);
    EXPECT_THAT(obstacles.back(),
                testing::MatchesRegex("the autopilot's pose is 52273(19|20) m and 0 deg from the "
                                      "motion capture that it is sent"));
    loopback.stand_in().end();
    EXPECT_FALSE(loopback.stand_in().stand_in().flight().manners.armed());
}

/// It stands at one place, bit for bit, before the flight and at rest, and has not frozen.
TEST(Loopback, FliesByATrackerWithoutNoise) {
    const auto model = model_of("perch_concrete", {"sensors.mocap_position_noise_m=0",
                                                   "sensors.mocap_attitude_noise_deg=0"});
    Loopback loopback(*model);
    const FlightResult behind = fly_behind_wire(model, loopback);
    EXPECT_EQ(behind.outcome, Outcome::released) << behind.reason;
    EXPECT_EQ(behind.attempts, 1);
    EXPECT_EQ(names(behind), names(fly(model)));
}

/// One that would not arm again on the wall is named before it takes off.
TEST(Loopback, AnotherParameterThanExpectedIsNamedBeforeItIsArmed) {
    const auto model = model_of("hover");
    px4::StandInOptions options = Loopback::perching();
    options.parameters.FD_FAIL_P = 60;
    options.parameters.COM_DISARM_PRFLT = options.parameters.COM_DISARM_LAND = -1.0;
    const auto settings = px4::px4_settings(px4_airframe(*model->scenario));
    Loopback loopback(*model, options, true, px4::expected_parameters(settings));
    EXPECT_NO_THROW((void)bring_up(*model, {.autopilot = &loopback.autopilot()}, BringUp()));
    ASSERT_THAT(loopback.differences, testing::SizeIs(1));
    EXPECT_THAT(loopback.differences[0], testing::StartsWith("FD_FAIL_P 60 instead of 0 ("));
    EXPECT_FALSE(loopback.armed_when_compared);
}

/// PX4 flies on without poses for five seconds, by its own account well.
TEST(Loopback, ATrackerThatFallsSilentIsNotWaitedForAsLongAsPx4Would) {
    const auto patient = model_of("perch_concrete", {"autopilot.EKF2_NOAID_TOUT=5000000"});
    Loopback loopback(*patient);
    const FlightResult result = fly_behind_wire(
        model_of("perch_concrete", {"faults={fault: mocap_lost, phase: approaching}"}), loopback);
    EXPECT_EQ(result.outcome, Outcome::aborted);
    EXPECT_EQ(result.reason, "stands before the wall, position estimate lost");
}

TEST_F(LoopbackFile, TheSameFlightIsTheSameBytes) {
    const auto model = model_of("perch_concrete");
    for (const char* name : {"one.mcap", "two.mcap"}) {
        Loopback loopback(*model);
        EXPECT_EQ(fly_behind_wire(model, loopback, file(name)).outcome, Outcome::released);
    }
    const std::string one = load_text(file("one.mcap"));
    EXPECT_GT(one.size(), 100'000U);
    EXPECT_TRUE(one == load_text(file("two.mcap")));
}

TEST(Loopback, EverySensorIsAnsweredOnceAndNothingIsLost) {
    const auto model = model_of("hover");
    Loopback loopback(*model);
    ASSERT_EQ(fly_behind_wire(model, loopback).outcome, Outcome::released);
    loopback.stand_in().end();
    const mavlink::HilCount& count = loopback.autopilot().count();
    EXPECT_EQ(count.unanswered, 0U);
    EXPECT_EQ(count.strays, 0U);
    EXPECT_EQ(count.answers, count.sensors_sent - 25);
    EXPECT_EQ(count.sensors_sent, loopback.stand_in().stand_in().count().sensors);
    EXPECT_EQ(count.round_trip.count(), count.answers);
    for (const mavlink::Link* link :
         {&loopback.hil(), &loopback.offboard(), &loopback.stand_in().stand_in().hil()}) {
        EXPECT_EQ(link->count().lost, 0U);
        EXPECT_EQ(link->count().damaged, 0U);
        EXPECT_EQ(link->count().discarded_bytes, 0U);
    }
}

/// Kills, silences, ... at an event.
FlightWatch at(EventName name, std::function<void()> what) {
    FlightWatch watch;
    watch.on_event = [name, what = std::move(what)](const Event& event) {
        if (event.name == name) {
            what();
        }
    };
    return watch;
}

TEST_F(LoopbackFile, KilledInTheAirItCrashesAndTheRecordingIsWhole) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model);
    const FlightResult result =
        fly_behind_wire(model, loopback, file("killed.mcap"),
                        at(EventName::approach_started, [&] { loopback.kill_stand_in(); }));
    EXPECT_EQ(result.outcome, Outcome::crashed);
    EXPECT_THAT(result.reason, HasSubstr("closed the link"));
    const record::Recording recording = record::read_recording(file("killed.mcap"));
    EXPECT_TRUE(recording.damage.empty()) << recording.damage;
    EXPECT_FALSE(recording.events.empty());
}

TEST_F(LoopbackFile, KilledOnTheWallTheCupStillHolds) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model);
    const FlightResult result =
        fly_behind_wire(model, loopback, file("killed.mcap"),
                        at(EventName::perched, [&] { loopback.kill_stand_in(); }));
    EXPECT_EQ(result.outcome, Outcome::timed_out);
    EXPECT_THAT(result.reason, HasSubstr("closed the link"));
    EXPECT_TRUE(record::read_recording(file("killed.mcap")).damage.empty());
}

TEST(Loopback, SilentInTheAirItCrashesAfterTheWait) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model);
    const FlightResult result = fly_behind_wire(
        model, loopback, {},
        at(EventName::approach_started, [&] { loopback.stand_in().fall_silent(); }));
    EXPECT_EQ(result.outcome, Outcome::crashed);
    EXPECT_THAT(result.reason, HasSubstr("answers no longer"));
    EXPECT_EQ(loopback.autopilot().count().unanswered, 1U);
}

TEST(Loopback, OneThatComesBackInTheAirHasForgottenAllAndTheFlightEnds) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model);
    const FlightResult result =
        fly_behind_wire(model, loopback, {}, at(EventName::approach_started, [&] {
                            loopback.kill_stand_in();
                            loopback.start_stand_in(*model);
                        }));
    EXPECT_EQ(result.outcome, Outcome::crashed);
    EXPECT_THAT(result.reason, HasSubstr("closed the link"));
}

TEST(Loopback, ASecondClientIsRefusedAndDisturbsNothing) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model);
    std::string fate = "it did not try";
    const FlightResult result = fly_behind_wire(
        model, loopback, {}, at(EventName::approach_started, [&] {
            const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
            sockaddr_in there{};
            there.sin_family = AF_INET;
            there.sin_port = htons(loopback.hil().transport().address().port);
            there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            fate = ::connect(socket, reinterpret_cast<sockaddr*>(&there), sizeof(there)) == 0
                       ? "it tried"
                       : "no connection";
            ::close(socket);
        }));
    EXPECT_EQ(fate, "it tried");
    EXPECT_EQ(result.outcome, Outcome::released);
    EXPECT_EQ(loopback.hil().transport().statistics().peers_refused, 1U);
    EXPECT_EQ(result.state_hash, fly_behind_wire("perch_concrete").state_hash);
}

TEST(Loopback, AnotherSystemIsNotOurAutopilot) {
    const auto model = model_of("hover");
    px4::StandInOptions options = Loopback::perching();
    options.system = 2;
    Loopback loopback(*model, options);
    BringUp patience;
    patience.limit_s = 10.0;
    try {
        (void)bring_up(*model, {.autopilot = &loopback.autopilot()}, patience);
        FAIL() << "it was flown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no heartbeat of the autopilot"));
    }
}

TEST(Loopback, WhatTheAutopilotRefusesIsSaid) {
    const auto model = model_of("perch_concrete");
    Loopback loopback(*model,
                      px4::StandInOptions{});  // FD_FAIL_P as PX4 comes: it cannot arm perched
    const FlightResult result = fly_behind_wire(model, loopback);
    EXPECT_NE(result.outcome, Outcome::released);
    EXPECT_THAT(loopback.last_text, HasSubstr("FD_FAIL_P"));
}

}  // namespace
}  // namespace limpet::simulation
