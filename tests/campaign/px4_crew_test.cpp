// SPDX-License-Identifier: Apache-2.0
//
// A campaign on PX4s, by the stand-in: a process a flight, several at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "campaigns.hpp"
#include "running.hpp"

namespace limpet::campaign {
namespace {

using testing::HasSubstr;

/// Instances that no other test meets, which may run beside: their ports are PX4's own, not free
/// ones.
constexpr const char *kEach = "4", *kInterrupted = "6", *kAmiss = "8";

std::string stand_in() {
    return std::string(LIMPET_PROGRAM) + " stand-in hover --instance {instance}";
}

std::string hovers(int runs) {
    return "description: short hovers\nscenario: hover\noverrides: [simulation.hover_s=0.5]\n"
           "seed: 3\nruns: " +
           std::to_string(runs) +
           "\nparameters:\n  sensors.lidar_noise_m: {uniform: [0.002, 0.02]}\n";
}

std::vector<std::string> on_px4(const char* first, const std::string& start,
                                std::vector<std::string> more) {
    more.insert(more.begin(), {"campaign", "x.yaml", "--autopilot", "px4", "--px4", start,
                               "--instance", first, "--wait", "30"});
    return more;
}

class CampaignOnPx4 : public testing::Test {
protected:
    Bench bench_;
};

TEST_F(CampaignOnPx4, EachFlightHasOneOfItsOwnAndTellsWhoFlewIt) {
    (void)bench_.write("x.yaml", hovers(4));
    const Finished flown = bench_.run(on_px4(kEach, stand_in(), {"--instances", "2"}));
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    EXPECT_THAT(flown.out, HasSubstr("4 runs of hover, seed 3, on 2 PX4s"));
    EXPECT_THAT(flown.out, HasSubstr("flown by the stand-in, as PX4 1.15.1, system 5"));
    EXPECT_THAT(flown.out, HasSubstr("flown by the stand-in, as PX4 1.15.1, system 6"));
    const auto file = bench_.folder() / "out/x_px4/results.sqlite";
    Results results(file, Access::read);
    EXPECT_EQ(results.outcomes(), (std::map<std::string, std::uint32_t>{{"released", 4}}));
    EXPECT_GT(results.row(3).simulated_s, 0.4);
    EXPECT_NE(results.row(0).sample, results.row(1).sample);

    const auto json = nlohmann::json::parse(bench_.run({"summary", "out/x_px4", "--json"}).out);
    EXPECT_EQ(json.at("flown_by").size(), 2U);
    const Finished replay = bench_.run({"replay", "out/x_px4", "1"});
    EXPECT_EQ(replay.exit_code, 2);
    EXPECT_THAT(replay.err, HasSubstr("run 1 was flown by the stand-in"));
    const Finished mixed = bench_.run({"campaign", "x.yaml", "--out", "out/x_px4", "--resume"});
    EXPECT_EQ(mixed.exit_code, 2);
    EXPECT_THAT(mixed.err, HasSubstr("the autopilot (--autopilot px4) has changed"));
}

TEST_F(CampaignOnPx4, InterruptedItLeavesNoneRunningAndGoesOn) {
    (void)bench_.write("x.yaml", hovers(40));
    const auto mark = bench_.folder() / "started";
    const std::string start = "echo $$ >> '" + mark.string() + "'; exec " + stand_in();
    {
        Running running(bench_.folder(), on_px4(kInterrupted, start, {"--instances", "2"}));
        const auto file = bench_.folder() / "out/x_px4/results.sqlite";
        EXPECT_TRUE(eventually([&] {
            try {
                return std::filesystem::exists(file) && Results(file, Access::read).finished() >= 2;
            } catch (const std::exception&) {
                return false;  // between two states of its log
            }
        }));
        running.signal(SIGINT);
        EXPECT_EQ(running.wait(), 130) << text_of(bench_.folder() / "log");
    }
    const std::string log = text_of(bench_.folder() / "log");
    EXPECT_THAT(log, HasSubstr("--autopilot px4 --px4 "));
    EXPECT_THAT(log, HasSubstr("stand-in hover --instance {instance}"));
    EXPECT_THAT(log, HasSubstr(" --instances 2 --instance 6 --wait 30 --resume"));
    std::istringstream started(text_of(mark));
    int count = 0;
    for (pid_t pid = 0; started >> pid; ++count) {
        EXPECT_NE(kill(pid, 0), 0) << "still runs: " << pid;
    }
    EXPECT_GE(count, 3);
}

TEST_F(CampaignOnPx4, WhatDoesNotFlyIsARowAndWhatDoesNotStartEndsIt) {
    (void)bench_.write("x.yaml", hovers(1));
    const Finished other = bench_.run(on_px4(kAmiss, stand_in(), {"--only-px4"}));
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_THAT(other.out, HasSubstr("no_flight"));
    EXPECT_THAT(other.out, HasSubstr("the stand-in answered, and a PX4 is required"));

    for (const auto& [start, told] : std::map<std::string, std::string>{
             {"echo out of order >&2; exit 3", "ended by itself, its last line: out of order"},
             {".", ".: no PX4 built for simulation is there (bin/px4, etc)"}}) {
        const Finished none = bench_.run(on_px4(kAmiss, start, {"--out", "none", "--resume"}));
        EXPECT_EQ(none.exit_code, 2);
        EXPECT_TRUE(none.one_line_of_error()) << none.err;
        EXPECT_THAT(none.err, HasSubstr(told));
    }
    const Finished many = bench_.run(on_px4(kAmiss, stand_in(), {"--instances", "3"}));
    EXPECT_EQ(many.exit_code, 2);
    EXPECT_THAT(many.err, HasSubstr("the last would be 10"));
    const Finished alone = bench_.run({"campaign", "x.yaml", "--instances", "2"});
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_THAT(alone.err, HasSubstr("--autopilot px4"));
}

}  // namespace
}  // namespace limpet::campaign
