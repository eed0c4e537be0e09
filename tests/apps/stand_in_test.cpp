// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "free_port.hpp"
#include "program.hpp"

using namespace limpet;
using testing::HasSubstr;

TEST(StandInVerb, FliesWhatAPx4Would) {
    const Bench bench;
    const std::string hil = "tcp:" + free_port(SOCK_STREAM);
    const std::string onboard = "udp:" + free_port(SOCK_DGRAM);
    const std::string offboard = "udp:" + free_port(SOCK_DGRAM);
    Started stand_in(
        bench.folder(), "stand_in",
        {"stand-in", "perch_concrete", "--hil", hil, "--onboard", onboard, "--peer", offboard});
    const Finished flight =
        bench.run({"fly", "perch_concrete", "--autopilot", "px4", "--hil", hil, "--offboard",
                   offboard, "--expect", "released", "--quiet", "--wait", "30"});
    EXPECT_EQ(flight.exit_code, 0) << flight.err;
    EXPECT_TRUE(std::filesystem::exists(bench.folder() / "out/perch_concrete/flight.mcap"));
    EXPECT_TRUE(std::filesystem::exists(bench.folder() / "out/perch_concrete/link.json"));
    stand_in.signal(SIGINT);
    const Finished end = stand_in.wait(std::chrono::seconds(30));
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("a simulator is there"));
    EXPECT_THAT(end.out, HasSubstr("answers"));
}

/// Of a PX4 that was started, console and logs stay next to the recording, also where no flight
/// came of it.
TEST(StandInVerb, WhatAStartedPx4PrintedIsKeptAndSummed) {
    const Bench bench;
    const std::string start =
        "echo 'ERROR [param] Parameter GONE not found.'; mkdir {folder}/log;"
        "echo x > {folder}/log/1.ulg; exec " +
        std::string(LIMPET_PROGRAM) + " stand-in hover --instance {instance}";
    const Finished flight = bench.run({"fly", "hover", "--autopilot", "px4", "--px4", start,
                                       "--instance", "9", "--wait", "30", "--no-figures"});
    EXPECT_EQ(flight.exit_code, 0) << flight.err;
    EXPECT_THAT(flight.out, HasSubstr("px4.log    1 error\n"));
    EXPECT_THAT(flight.out, HasSubstr("ERROR [param] Parameter GONE not found."));
    EXPECT_TRUE(std::filesystem::exists(bench.folder() / "out/hover/px4.ulg"));

    const Finished none =
        bench.run({"fly", "hover", "--autopilot", "px4", "--px4", "echo port in use; sleep 60",
                   "--instance", "9", "--wait", "1", "--out", "none"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_EQ(text_of(bench.folder() / "none/px4.log"), "port in use\n");
}

TEST(StandInVerb, WhoAnsweredIsToldAndWhereAPx4IsAskedForItWillNotDo) {
    for (const bool only_px4 : {false, true}) {
        const Bench bench;
        const std::string hil = "tcp:" + free_port(SOCK_STREAM);
        const std::string offboard = "udp:" + free_port(SOCK_DGRAM);
        Started stand_in(bench.folder(), "stand_in",
                         {"stand-in", "hover", "--instance", "3", "--hil", hil, "--onboard",
                          "udp:" + free_port(SOCK_DGRAM), "--peer", offboard});
        std::vector<std::string> words = {
            "fly",    "hover",  "--autopilot", "px4",    "--hil", hil,          "--offboard",
            offboard, "--json", "--no-record", "--wait", "30",    "--instance", "3"};
        if (only_px4) {
            words.emplace_back("--only-px4");
        }
        const Finished flight = bench.run(words);
        EXPECT_EQ(flight.exit_code, only_px4 ? 2 : 0) << flight.err;
        if (only_px4) {
            EXPECT_THAT(flight.err, HasSubstr("the stand-in answered, and a PX4 is required"));
            continue;
        }
        EXPECT_THAT(flight.err, HasSubstr("the stand-in, as PX4 1.15.1, system 4"));
        const auto who = nlohmann::json::parse(flight.out).at("autopilot");
        EXPECT_EQ(who.at("name"), "stand-in");
        EXPECT_EQ(who.at("version"), "1.15.1");
        EXPECT_TRUE(who.at("git_hash").is_null());
        EXPECT_TRUE(who.at("airframe").is_null());
        EXPECT_EQ(who.at("system"), 4);
    }
}

TEST(StandInVerb, OneThatADebuggerStopsIsWaitedForWhereThatIsAsked) {
    for (const std::string patience : {"0.3", "60"}) {
        const Bench bench;
        const std::string hil = "tcp:" + free_port(SOCK_STREAM);
        const std::string offboard = "udp:" + free_port(SOCK_DGRAM);
        Started stand_in(bench.folder(), "stand_in",
                         {"stand-in", "hover", "--hil", hil, "--onboard",
                          "udp:" + free_port(SOCK_DGRAM), "--peer", offboard});
        Started flight(bench.folder(), "flight",
                       {"fly", "hover", "--autopilot", "px4", "--hil", hil, "--offboard", offboard,
                        "--patience", patience, "--speed", "4", "--wait", "30"});
        ASSERT_TRUE(flight.prints("armed", std::chrono::seconds(20))) << flight.output();
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        stand_in.signal(SIGSTOP);
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        stand_in.signal(SIGCONT);
        const Finished end = flight.wait(std::chrono::seconds(30));
        EXPECT_THAT(end.out + end.err,
                    HasSubstr(patience == "60" ? "outcome    released"
                                               : "the autopilot answers no longer"));
    }
}

TEST(StandInVerb, WithoutItThereIsNoFlightAndNothingIsWritten) {
    const Bench bench;
    const Finished flight = bench.run({"fly", "perch_concrete", "--autopilot", "px4", "--hil",
                                       "tcp:" + free_port(SOCK_STREAM), "--offboard",
                                       "udp:" + free_port(SOCK_DGRAM), "--quiet", "--wait", "0.3"});
    EXPECT_EQ(flight.exit_code, 2);
    EXPECT_TRUE(flight.one_line_of_error()) << flight.err;
    EXPECT_THAT(flight.err, HasSubstr("no PX4 came"));
    EXPECT_EQ(bench.files(), std::vector<std::string>());
}

TEST(StandInVerb, WhoWaitsForItSaysHowToStartItAndLeavesNothingOnCtrlC) {
    for (const std::string verb : {"fly", "sim-io"}) {
        const Bench bench;
        const std::string hil = "tcp:" + free_port(SOCK_STREAM);
        std::vector<std::string> words = {verb,    "hover", "--hil",        hil,
                                          "--out", "a/b",   "--record-wire"};
        if (verb == "fly") {
            words.insert(words.end(),
                         {"--autopilot", "px4", "--offboard", "udp:" + free_port(SOCK_DGRAM)});
        } else {
            words.insert(words.end(), {"--sensors", "udp:" + free_port(SOCK_DGRAM)});
        }
        Started waiting(bench.folder(), "waiting", words);
        ASSERT_TRUE(waiting.prints("limpet stand-in hover --hil " + hil, std::chrono::seconds(20)))
            << waiting.output();
        waiting.signal(SIGINT);
        const Finished end = waiting.wait(std::chrono::seconds(20));
        EXPECT_EQ(end.exit_code, 130) << end.err;
        EXPECT_TRUE(end.one_line_of_error()) << end.err;
        EXPECT_THAT(end.err, HasSubstr("interrupted while waiting for PX4"));
        EXPECT_FALSE(std::filesystem::exists(bench.folder() / "a"));
    }
}

TEST(StandInVerb, CtrlCEndsTheWaitForIt) {
    const Bench bench;
    Started fly(bench.folder(), "fly",
                {"fly", "perch_concrete", "--autopilot", "px4", "--hil",
                 "tcp:" + free_port(SOCK_STREAM), "--offboard", "udp:" + free_port(SOCK_DGRAM)});
    ASSERT_TRUE(fly.prints("waiting for PX4", std::chrono::seconds(30)));
    fly.signal(SIGINT);
    const Finished end = fly.wait(std::chrono::seconds(30));
    EXPECT_EQ(end.exit_code, 130);
    EXPECT_TRUE(end.one_line_of_error()) << end.err;
    EXPECT_THAT(end.err, HasSubstr("interrupted while waiting for PX4"));
}

TEST(StandInVerb, CtrlCBeforeTheFlightKeepsTheWireThatLedThere) {
    const Bench bench;
    const std::string hil = "tcp:" + free_port(SOCK_STREAM);
    const std::string offboard = "udp:" + free_port(SOCK_DGRAM);
    Started stand_in(bench.folder(), "stand_in",
                     {"stand-in", "hover", "--hil", hil, "--onboard",
                      "udp:" + free_port(SOCK_DGRAM), "--peer", offboard});
    Started flight(bench.folder(), "flight",
                   {"fly", "hover", "--autopilot", "px4", "--hil", hil, "--offboard", offboard,
                    "--record-wire", "--speed", "0.1", "--out", "o"});
    ASSERT_TRUE(flight.prints("the autopilot boots", std::chrono::seconds(20))) << flight.output();
    flight.signal(SIGINT);
    const Finished end = flight.wait(std::chrono::seconds(20));
    EXPECT_EQ(end.exit_code, 130) << end.err;
    EXPECT_TRUE(end.one_line_of_error()) << end.err;
    EXPECT_THAT(text_of(bench.folder() / "o/wire.mcap"),
                testing::EndsWith("\x89"
                                  "MCAP0\r\n"));  // whole: MCAP's last magic
    EXPECT_FALSE(std::filesystem::exists(bench.folder() / "o/flight.mcap"));
}

TEST(StandInVerb, RefusesInOneLine) {
    const Bench bench;
    const std::vector<std::vector<std::string>> wrong = {
        {"stand-in", "nowhere"},
        {"stand-in", "hover", "--hil", "udp:127.0.0.1:4560"},
        {"stand-in", "hover", "--hil", "serial:/dev/not_there:921600"},
        {"stand-in", "hover", "--onboard", "tcp:127.0.0.1:14580"},
        {"stand-in", "hover", "--param", "FD_FAIL_P"},
        {"stand-in", "hover", "--param", "FD_FAIL_P=much"},
        {"stand-in", "hover", "--param", "FD_FAIL_P=1000"},
        {"stand-in", "hover", "--param", "NO_SUCH=1"},
    };
    for (const auto& arguments : wrong) {
        const Finished done = bench.run(arguments);
        EXPECT_EQ(done.exit_code, 2) << arguments.back();
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
    }
}
