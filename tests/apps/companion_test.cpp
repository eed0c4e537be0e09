// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "free_port.hpp"
#include "limpet/record/recording.hpp"
#include "program.hpp"

// The companion as a user starts it, alone and as one of three processes.

namespace limpet {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// Addresses of one set of three processes.
struct Ports {
    std::string hil = "tcp:" + free_port(SOCK_STREAM);
    std::string onboard = "udp:" + free_port(SOCK_DGRAM);
    std::string companion = "udp:" + free_port(SOCK_DGRAM);
    std::string sensors = "udp:" + free_port(SOCK_DGRAM);

    [[nodiscard]] std::vector<std::string> companion_words(
        const std::vector<std::string>& more) const {
        std::vector<std::string> words = {"companion", "simulation",
                                          "--set",     "autopilot.address=" + companion,
                                          "--set",     "sensors.address=" + sensors};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
};

TEST(CompanionVerb, CheckSaysWhatItWouldDoAndOpensNothing) {
    const Bench bench;
    const Finished finished = bench.run({"companion", "optitrack_px4", "--check"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    for (const char* part : {"autopilot   serial:/dev/ttyAMA0:921600", "waits until an operator",
                             "NatNet on udp-multi", "TFmini Plus, left serial:",
                             "lines over serial:", "signing     none", "hands back  pose",
                             "loop        requests SCHED_FIFO 20 and locked memory"}) {
        EXPECT_THAT(finished.out, HasSubstr(part));
    }
    EXPECT_TRUE(bench.files().empty());
}

TEST(CompanionVerb, RefusesBadInputInOneLine) {
    const Bench bench;
    const auto refused = [&](const std::vector<std::string>& words, const char* part) {
        const Finished finished = bench.run(words);
        EXPECT_EQ(finished.exit_code, 2) << part;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(part));
    };
    refused({"companion", "nobody"}, "no such companion");
    refused({"companion", "simulation", "--set", "limits.pose_limit_s=9"}, "allowed 0.05..5 s");
    refused({"companion", "simulation", "--speed", "0"}, "--speed 0: must be 0.01..100");
    refused({"companion", "optitrack_px4", "--speed", "2"}, "only 1 with serial wires");
    refused({"companion", "simulation", "--expect", "landed"}, "no such outcome");
    refused({"companion", "optitrack_px4", "--no-record"}, "/dev/ttyAMA0");
    (void)bench.write("half.yaml", "vehicle: perching_uav\nmission: perch\n");
    refused({"companion", "half.yaml", "--check"},
            "half.yaml: is half a companion, missing lidars.source, mechanism.source, "
            "mechanism.valve, motion_capture.source");
    EXPECT_EQ(bench.files(), std::vector<std::string>{"half.yaml"});
}

TEST(CompanionVerb, WhereNobodyIsItSaysSoAndExitsWithTwo) {
    const Bench bench;
    const Finished finished =
        bench.run(Ports().companion_words({"--set", "limits.wait_limit_s=2", "--speed", "4"}));
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_THAT(finished.out,
                HasSubstr("waits: no motion-capture pose (no ODOMETRY comes over the sensors' "
                          "wire), no left LiDAR, "
                          "no right LiDAR, no force, no cup pressure, no heartbeat of "
                          "the autopilot"));
    EXPECT_THAT(finished.err, HasSubstr("limpet: nothing was flown: waited 2 s: no"));
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    EXPECT_EQ(record::read_recording(bench.folder() / "out/companion/flight.mcap").damage, "");
}

TEST(CompanionVerb, SaysWhetherItGotRealTimeAndHowLateItWas) {
    for (const std::string priority : {"5", "0"}) {
        const Bench bench;
        const Finished finished = bench.run(
            Ports().companion_words({"--set", "limits.wait_limit_s=1", "--set",
                                     "loop.real_time_priority=" + priority, "--no-record"}));
        EXPECT_EQ(finished.exit_code, 2) << finished.err;
        EXPECT_THAT(finished.out,
                    testing::ContainsRegex(priority == "0" ? "real time: not requested"
                                                           : "real time: .*(SCHED_FIFO 5|memory)"));
        EXPECT_THAT(finished.out, testing::ContainsRegex(
                                      "[0-9]+ ticks, [0-9]+ of them late by more than a period; "
                                      "late by [0-9.]+ ms .median., .* ms .worst."));
    }
}

TEST(CompanionVerb, TellsItsServiceManagerThatItsLoopRuns) {
    const Bench bench;
    const std::string name = (bench.folder() / "notify").string();
    const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    sockaddr_un here{};
    here.sun_family = AF_UNIX;
    ASSERT_LT(name.size(), sizeof(here.sun_path));
    std::memcpy(here.sun_path, name.c_str(), name.size() + 1);
    ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&here), sizeof(here)), 0);
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    setenv("WATCHDOG_USEC", "1200000", 1);
    const Finished finished =
        bench.run(Ports().companion_words({"--set", "limits.wait_limit_s=1", "--no-record"}));
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    EXPECT_EQ(finished.exit_code, 2) << finished.err;
    std::vector<std::string> words;
    char text[100];
    for (ssize_t size = 0; (size = recv(socket, text, sizeof(text), 0)) >= 0;) {
        words.emplace_back(text, static_cast<std::size_t>(size));
    }
    close(socket);
    ASSERT_GE(words.size(), 3U);
    EXPECT_EQ(words.front(), "READY=1");
    EXPECT_EQ(words[1], "WATCHDOG=1");
    EXPECT_EQ(words.back(), "STOPPING=1");
}

const char* const kUnit = LIMPET_SOURCE_DIR "/packaging/limpet-companion@.service";

TEST(CompanionUnit, StartsWhatTheProgramKnows) {
    const std::string unit = text_of(kUnit);
    const std::string start = "ExecStart=limpet ";
    const auto at = unit.find(start);
    ASSERT_NE(at, std::string::npos);
    std::istringstream line(
        unit.substr(at + start.size(), unit.find('\n', at) - at - start.size()));
    std::vector<std::string> words;
    for (std::string word; line >> word;) {
        if (word != "$OPTIONS") {
            words.push_back(word == "/etc/limpet/%i.yaml" ? "simulation" : word);
        }
    }
    words.emplace_back("--check");
    const Bench bench;
    const Finished finished = bench.run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("waits until an operator")) << "a restart arms nobody";
}

/// The shipped unit, with this program in the installed one's place.
TEST(CompanionUnit, IsAsSystemdWantsIt) {
    if (std::system("systemd-analyze --version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "no systemd-analyze (package systemd)";
    }
    const Bench bench;
    std::string unit = text_of(kUnit);
    const std::string start = "ExecStart=limpet ";
    const auto at = unit.find(start);
    ASSERT_NE(at, std::string::npos);
    unit.replace(at, start.size(), "ExecStart=" LIMPET_PROGRAM " ");
    const std::string folder = bench.folder().string();
    const auto complaint = [&](const std::string& text) {
        (void)bench.write("limpet-companion@.service", text);
        (void)std::system(("cd " + folder +
                           " && systemd-analyze verify --man=no ./limpet-companion@wall.service "
                           ">log 2>&1; echo exit $? >>log")
                              .c_str());
        std::istringstream log(text_of(bench.folder() / "log"));
        std::string ours;
        for (std::string line;
             std::getline(log, line);) {  // it reports on the machine's units, too
            if (line.find("limpet-companion") != std::string::npos || line == "exit 1") {
                ours += line + "\n";
            }
        }
        return ours;
    };
    EXPECT_EQ(complaint(unit), "");
    EXPECT_NE(complaint(unit + "\n[Service]\nLimitRTPRIO=many\n"), "") << "it looks";
}

TEST(CompanionVerb, CtrlCEndsItsWaitInGoodOrder) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Bench bench;
        Started companion(bench.folder(), "companion", Ports().companion_words({"--out", "o"}));
        ASSERT_TRUE(companion.prints("waits: no", 20s)) << companion.output();
        companion.signal(signal);
        const Finished finished = companion.wait(20s);
        EXPECT_EQ(finished.exit_code, 130) << finished.err;
        EXPECT_EQ(record::read_recording(bench.folder() / "o/flight.mcap").damage, "");
    }
}

/// Autopilot, surroundings and companion, twice as fast as real time. Patience is longer than in
/// flight: a busy machine that sleeps for 0.2 s makes 0.4 s of it.
struct ThreeProcesses : testing::Test {
    static constexpr auto kLong = 120s;
    [[nodiscard]] std::vector<std::string> patient(std::vector<std::string> words) const {
        for (const char* set :
             {"limits.late_limit_s=0.9", "limits.pose_limit_s=1", "limits.estimate_limit_s=1",
              "limits.silence_limit_s=10", "guidance.sensor_limit_s=1"}) {
            words.insert(words.end(), {"--set", set});
        }
        words.insert(words.end(), {"--speed", "2"});
        return ports.companion_words(words);
    }
    Bench bench;
    Ports ports;
    Started autopilot{bench.folder(),
                      "autopilot",
                      {"stand-in", "perch_concrete", "--hil", ports.hil, "--onboard", ports.onboard,
                       "--peer", ports.companion}};
    Started surroundings{bench.folder(),
                         "surroundings",
                         {"sim-io", "perch_concrete", "--hil", ports.hil, "--sensors",
                          ports.sensors, "--speed", "2", "--no-figures", "--out", "sim"}};
};

TEST_F(ThreeProcesses, PerchAndTakeOff) {
    Started companion(bench.folder(), "companion",
                      patient({"--out", "companion_out", "--expect", "released"}));
    const Finished flown = companion.wait(kLong);
    EXPECT_EQ(flown.exit_code, 0) << flown.out << flown.err << surroundings.output();
    EXPECT_THAT(flown.out, HasSubstr("released: back at the pre-position"));
    const Finished seen = surroundings.wait(20s);
    EXPECT_EQ(seen.exit_code, 0) << seen.out << seen.err;
    EXPECT_THAT(seen.out, HasSubstr("released"));
    for (const char* event : {"impact", "attached", "perched", "motors_off", "detached"}) {
        EXPECT_THAT(seen.out, HasSubstr(event));
    }
    const record::Recording recording =
        record::read_recording(bench.folder() / "companion_out/flight.mcap");
    EXPECT_EQ(recording.damage, "");
    const Finished drawn = bench.run({"plot", "companion_out/flight.mcap"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
}

TEST_F(ThreeProcesses, CtrlCWhileItLandsLeavesTheVehicleOnTheWall) {
    Started companion(bench.folder(), "companion", patient({"--out", "companion_out"}));
    ASSERT_TRUE(companion.prints("landing_started", kLong)) << companion.output();
    companion.signal(SIGINT);
    companion.signal(SIGTERM);  // no further one hastens it
    std::this_thread::sleep_for(1200ms);
    companion.signal(SIGTERM);
    const Finished flown = companion.wait(60s);
    EXPECT_EQ(flown.exit_code, 130) << flown.out << flown.err;
    EXPECT_THAT(flown.out, HasSubstr("goes on until it rests or is off the wall"));
    EXPECT_THAT(flown.out, HasSubstr("nothing requested; the pump stays on"));
    EXPECT_THAT(flown.out, testing::Not(HasSubstr("motors_on")));
    EXPECT_EQ(record::read_recording(bench.folder() / "companion_out/flight.mcap").damage, "");
    const Finished seen = surroundings.wait(20s);
    EXPECT_THAT(seen.out, HasSubstr("motors_off"));
    EXPECT_THAT(seen.out, testing::Not(HasSubstr("detached")));
}

}  // namespace
}  // namespace limpet
