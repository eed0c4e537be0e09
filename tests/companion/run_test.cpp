// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "tests/companion/rehearsal.hpp"
#include "tests/support/allocations.hpp"

namespace limpet::companion {
namespace {

namespace fs = std::filesystem;

/// The outside and the clock in one: time goes on when the companion waits, and the world with it.
struct Theatre {
    explicit Theatre(const std::vector<std::string>& overrides = {})
        : config(rehearsal_config(overrides)),
          wires(open_wires(config)),
          stage(wires.autopilot->transport().address(), wires.sensors->transport().address()) {}

    CompanionConfig config;
    Wires wires;
    Stage stage;
    double now_s = 0.0;
    double tick_costs_s = 0.0;  ///< by looking at the clock
    std::function<void(double)> at = [](double) {};

    CompanionClock clock() {
        return {.now_s = [this] { return now_s += tick_costs_s; },
                .wait_until_s =
                    [this](double time_s) {
                        now_s = std::max(now_s, time_s);
                        while (stage.time_s() + guidance::Puppet::kDt_s <= now_s) {
                            stage.step();
                        }
                        at(now_s);
                    }};
    }
    CompanionResult run(const CompanionConduct& conduct = {}, const CompanionWatch& watch = {}) {
        return companion::run(config, wires, clock(), conduct, watch);
    }
};

fs::path recording_of(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / "limpet_companion_run";
    fs::create_directories(folder);
    return folder / (name + ".mcap");
}

TEST(Run, FliesAMissionOnAbsoluteDeadlinesAndRecordsIt) {
    Theatre theatre;
    theatre.tick_costs_s = 0.0005;
    const fs::path file = recording_of("mission");
    const CompanionResult result = theatre.run({.recording = file});
    EXPECT_EQ(result.outcome, Outcome::released) << result.reason;
    EXPECT_NEAR(static_cast<double>(result.ticks), result.last_s / 0.02, 2.0)
        << "what a tick costs must not add up";
    EXPECT_EQ(result.late_ticks, 0U);

    const record::Recording recording = record::read_recording(file);
    EXPECT_EQ(recording.damage, "");
    EXPECT_EQ(recording.events.size(), result.events.size());
    for (const char* topic : {"/sensors/range_left", "/sensors/range_right", "/sensors/force",
                              "/sensors/cup_pressure", "/sensors/motion_capture", "/estimate/pose",
                              "/estimate/twist", "/setpoint", "/guidance"}) {
        EXPECT_GT(recording.table(topic).time_s.size(), 1000U) << topic;
    }
    EXPECT_THROW((void)recording.table("/truth/pose"), InputError) << "nobody knows it";
    ASSERT_NE(recording.attachment("companion.yaml"), nullptr);
    ASSERT_NE(recording.attachment("summary.json"), nullptr);
    const auto summary = nlohmann::json::parse(recording.attachment("summary.json")->text);
    EXPECT_EQ(summary["outcome"], "released");
    EXPECT_EQ(summary["lateness_s"]["worst"], result.lateness.largest_s());
    EXPECT_EQ(summary["lateness_s"]["median"], result.lateness.quantile_s(0.5));
    fs::remove(file);
}

TEST(Run, CountsATickThatCameLateAndDoesNotMakeUpForIt) {
    Theatre theatre;
    bool stalled = false;
    theatre.at = [&](double now_s) {
        if (!stalled && now_s > 10.0) {
            stalled = true;
            theatre.now_s += 0.1;
        }
    };
    const CompanionResult result = theatre.run();
    EXPECT_EQ(result.outcome, Outcome::released) << result.reason;
    EXPECT_EQ(result.late_ticks, 1U);
    EXPECT_NEAR(result.lateness.largest_s(), 0.1, 0.021);
    EXPECT_EQ(result.lateness.count(), result.ticks);
    EXPECT_LT(result.lateness.quantile_s(0.99), 0.001) << "one of many";
    EXPECT_NEAR(static_cast<double>(result.ticks), (result.last_s - 0.1) / 0.02, 3.0);
}

TEST(Run, ALongStallInTheAirHandsControlBack) {
    Theatre theatre({"guidance.dock_speed_m_s=0.1"});
    bool stalled = false;
    theatre.at = [&](double now_s) {
        if (!stalled && theatre.stage.sensors.events.size() == 2) {  // the approach has begun
            stalled = true;
            theatre.now_s = now_s + 0.4;
        }
    };
    const CompanionResult result = theatre.run();
    EXPECT_EQ(result.end, CompanionEnd::handed_back);
    EXPECT_THAT(result.reason, testing::HasSubstr("guidance came too late"));
    EXPECT_EQ(theatre.stage.mode, Stage::kLoiter);
}

TEST(Run, WithoutMemoryInTheAirControlIsHandedBack) {
    Theatre theatre({"guidance.dock_speed_m_s=0.1"});
    bool lacks = false;
    const CompanionResult result =
        theatre.run({}, {.on_event =
                             [&lacks](const Event& event) {
                                 if (event.name == EventName::approach_started && !lacks) {
                                     lacks = true;
                                     throw std::bad_alloc();
                                 }
                             },
                         .on_line = {}});
    EXPECT_TRUE(lacks);
    EXPECT_EQ(result.end, CompanionEnd::handed_back);
    EXPECT_THAT(result.reason, testing::StartsWith("not enough memory; interrupted"));
    EXPECT_EQ(theatre.stage.mode, Stage::kLoiter);
    EXPECT_FALSE(theatre.stage.mechanism.pump_on);
}

TEST(Run, TheRecordingIsWholeWhereNothingWasFlown) {
    for (const bool stop_at_once : {true, false}) {
        Theatre theatre({"limits.wait_limit_s=2"});
        theatre.stage.beats = false;
        const std::atomic<bool> stop = stop_at_once;
        const fs::path file = recording_of("nothing");
        const CompanionResult result = theatre.run({.stop = &stop, .recording = file});
        EXPECT_EQ(result.end, stop_at_once ? CompanionEnd::interrupted : CompanionEnd::absent);
        EXPECT_EQ(record::read_recording(file).damage, "");
        fs::remove(file);
    }
}

TEST(Run, AllocatesNothingInFlight) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::aligning));
    long during = 0;
    for (int k = 0; k < 200; ++k) {
        r.stage.step();
        const long before = allocations();
        r.companion->tick(r.stage.time_s(), 0.0, false);
        during += allocations() - before;
    }
    EXPECT_EQ(during, 0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
}

TEST(SteadyClock, RunsAsFastAsItIsTold) {
    const CompanionClock clock = steady_clock(50.0);
    const auto begin = std::chrono::steady_clock::now();
    clock.wait_until_s(2.0);
    const double real_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_GE(clock.now_s(), 2.0);
    EXPECT_GE(real_s, 0.039);
    EXPECT_LT(real_s, 1.0);
}

}  // namespace
}  // namespace limpet::companion
