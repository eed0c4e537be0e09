// SPDX-License-Identifier: Apache-2.0
// The paper's Fig. 5: simulator, autopilot and companion as three programs on loopback.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "free_port.hpp"
#include "limpet/record/recording.hpp"
#include "program.hpp"

namespace limpet {
namespace {

using namespace std::chrono_literals;

struct DevicePorts {
    std::string hil = "tcp:" + free_port(SOCK_STREAM);
    std::string onboard = "udp:" + free_port(SOCK_DGRAM);
    std::string autopilot = "udp:" + free_port(SOCK_DGRAM);
    std::string sensors = "udp:" + free_port(SOCK_DGRAM);
    std::string motive = "udp:" + free_port(SOCK_DGRAM);
};

struct OverDevices : testing::Test {
    Bench bench;
    DevicePorts ports;
    std::optional<Started> stand_in;
    std::optional<Started> sim_io;
    std::optional<Started> companion;
    std::string pose_limit_s = "1";

    void write_companion(const std::string& sources) const {
        (void)bench.write(
            "companion.yaml",
            "description: three processes\n"
            "vehicle: perching_uav\n"
            "mission: perch_and_take_off\n"
            "autopilot:\n"
            "  address: " +
                ports.autopilot +
                "\n"
                "  asks_for_mode: true\n"
                // a busy machine is no reason to hand back
                "limits: {late_limit_s: 0.9, estimate_limit_s: 1, silence_limit_s: 10, "
                "wait_limit_s: 20, pose_limit_s: " +
                pose_limit_s +
                "}\n"
                "guidance: {sensor_limit_s: 1}\n"
                "sensors:\n"
                "  address: " +
                ports.sensors + "\n" + sources);
    }

    /// @param fault  of the scenario's table; empty: none
    void start(const std::string& speed, const std::string& fault = "") {
        std::vector<std::string> words = {
            "sim-io", "perch_metal_valve", "companion.yaml", "--hil",    ports.hil, "--speed",
            speed,    "--no-figures",      "--expect",       "released", "--out",   "sim"};
        if (!fault.empty()) {
            words.insert(words.end(), {"--set", "faults={" + fault + "}"});
        }
        sim_io.emplace(bench.folder(), "sim_io", words);
        stand_in.emplace(
            bench.folder(), "stand_in",
            std::vector<std::string>{"stand-in", "perch_metal_valve", "--hil", ports.hil,
                                     "--onboard", ports.onboard, "--peer", ports.autopilot});
        // its serial ports are there once it waits for the autopilot
        EXPECT_TRUE(sim_io->prints("waiting for PX4", 30s)) << sim_io->output();
        companion.emplace(
            bench.folder(), "companion",
            std::vector<std::string>{"companion", "companion.yaml", "--speed", speed, "--expect",
                                     "released", "--out", "companion_out"});
    }

    void expect_released(std::chrono::seconds limit) {
        const Finished flown = sim_io->wait(limit);
        const Finished guided = companion->wait(30s);
        EXPECT_EQ(flown.exit_code, 0) << flown.out << flown.err << guided.out << guided.err;
        EXPECT_EQ(guided.exit_code, 0) << guided.out << guided.err;
        // The simulator's recording holds what guidance reported and what the cup did, in order.
        const record::Recording recording =
            record::read_recording(bench.folder() / "sim" / "flight.mcap");
        std::vector<std::string> wanted = {"approach_started", "attached",  "perched",
                                           "motors_off",       "motors_on", "pump_off",
                                           "valve_open",       "detached",  "backed_off"};
        for (const auto& event : recording.events) {
            if (!wanted.empty() && event.name == wanted.front()) {
                wanted.erase(wanted.begin());
            }
        }
        EXPECT_TRUE(wanted.empty()) << "no " << wanted.front();
    }
};

TEST_F(OverDevices, ThreeProcessesPerchOverNatNetRangeFindersAndTheMechanismsLine) {
    const std::string folder = bench.folder().string();
    write_companion(
        "motion_capture:\n"
        "  source: natnet\n"
        "  address: " +
        ("udp:" + free_port(SOCK_DGRAM)) +
        "\n"
        "  command: " +
        ports.motive +
        "\n"
        "  rigid_body: 3\n"
        "  up: y\n"
        "  x_axis_yaw_deg: 40\n"
        "  nose_yaw_deg: -25\n"
        "  pivot_z_m: -0.05\n"
        "lidars:\n"
        "  source: tfmini\n"
        "  left: serial:" +
        folder +
        "/left:115200\n"
        "  right: serial:" +
        folder +
        "/right:115200\n"
        "mechanism:\n"
        "  source: line\n"
        "  address: serial:" +
        folder +
        "/mechanism:115200\n"
        "  readings: mavlink\n"
        "  valve: true\n");
    start("1");
    expect_released(180s);
}

/// Motive over NatNet 3.1, the rest over MAVLink.
struct PosesThatAreWrong : OverDevices {
    Finished guided;
    std::optional<record::Recording> flown;

    void fly(const std::string& fault) {
        write_companion(
            "motion_capture:\n"
            "  source: natnet\n"
            "  address: " +
            ("udp:" + free_port(SOCK_DGRAM)) +
            "\n"
            "  command: " +
            ports.motive +
            "\n"
            "  rigid_body: 3\n"
            "  up: y\n"
            "lidars:\n"
            "  source: mavlink\n"
            "mechanism:\n"
            "  source: mavlink\n"
            "  valve: true\n");
        start("1", fault);
        guided = companion->wait(120s);
        sim_io->signal(SIGINT);
        (void)sim_io->wait(30s);
    }
    [[nodiscard]] bool happened(const std::string& event) {
        if (!flown) {
            flown.emplace(record::read_recording(bench.folder() / "sim" / "flight.mcap"));
        }
        return std::any_of(flown->events.begin(), flown->events.end(),
                           [&](const auto& each) { return each.name == event; });
    }
};

TEST_F(PosesThatAreWrong, AJumpInTheApproachIsHandedBackBeforeTheWall) {
    pose_limit_s = "0.25";
    fly("fault: mocap_jumps, size: -5, phase: approaching, after_s: 0.3");
    EXPECT_EQ(guided.exit_code, 1) << guided.out << guided.err;
    EXPECT_NE(guided.err.find("motion-capture pose stale: its pose jumped (5."), std::string::npos)
        << guided.err;
    EXPECT_TRUE(happened("approach_started"));
    EXPECT_FALSE(happened("impact")) << "flew on into the wall";
}

/// From the flight's first instant, while it stands: the stand-in's estimate follows.
TEST_F(PosesThatAreWrong, ADriftOnTheStandArmsNobody) {
    fly("fault: mocap_drifts, size: 1, at_s: 0");
    EXPECT_EQ(guided.exit_code, 2) << guided.out << guided.err;
    EXPECT_NE(guided.err.find("its pose moves while motors are off and the gyros are still"),
              std::string::npos)
        << guided.err;
    EXPECT_EQ(guided.out.find("begins"), std::string::npos) << guided.out;
}

TEST_F(OverDevices, CtrlCLeavesTheSimulatorsRecordingWhole) {
    write_companion(
        "motion_capture:\n"
        "  source: mavlink\n"
        "lidars:\n"
        "  source: mavlink\n"
        "mechanism:\n"
        "  source: mavlink\n"
        "  valve: false\n");
    start("2");
    ASSERT_TRUE(sim_io->prints("approach_started", 60s));
    sim_io->signal(SIGINT);
    const Finished flown = sim_io->wait(30s);
    EXPECT_EQ(flown.exit_code, 130) << flown.out << flown.err;
    EXPECT_NE(flown.err.find("the recording is whole"), std::string::npos);
    EXPECT_FALSE(record::read_recording(bench.folder() / "sim" / "flight.mcap").events.empty());
}

TEST(SimIo, WhatItCannotUseIsSaidInOneLine) {
    const Bench bench;
    const auto refused = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> words = {"sim-io", "perch_concrete"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Finished finished = bench.run(words);
        EXPECT_EQ(finished.exit_code, 2) << finished.out;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        return finished.err;
    };
    EXPECT_NE(refused({"--speed", "max"}).find("--speed max"), std::string::npos);
    EXPECT_NE(refused({"--sensors", "tcp:127.0.0.1:9"}).find("udp:HOST:PORT"), std::string::npos);
    EXPECT_NE(refused({"--motion-capture", "tcp:127.0.0.1:9"}).find("--motion-capture"),
              std::string::npos);
    EXPECT_NE(refused({"--motion-capture", "udp:127.0.0.1:9000", "--natnet", "2.9"}).find("2.9"),
              std::string::npos);
    EXPECT_NE(refused({"--lidar-left", "/dev/ttyUSB0"}).find("--lidar-left"), std::string::npos);
    EXPECT_NE(refused({"--mechanism", "pty:/no/such/folder/x"}).find("/no/such/folder/x"),
              std::string::npos);
    EXPECT_NE(
        refused({"--hil", "tcp:" + free_port(SOCK_STREAM), "--wait", "0.2"}).find("no PX4 came"),
        std::string::npos);
}

}  // namespace
}  // namespace limpet
