// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "free_port.hpp"
#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kGood = "mission: hover\nvehicle: perching_uav\n";

/// Bad input: one clear line on standard error, exit code 2, and not a file more than before.
void expect_refused(const Bench& bench, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& texts) {
    const auto before = bench.files();
    const Finished finished = bench.run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << finished.err;
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    EXPECT_EQ(finished.out, "");
    for (const std::string& text : texts) {
        EXPECT_THAT(finished.err, HasSubstr(text));
    }
    EXPECT_EQ(bench.files(), before);
}

TEST(BadInput, MissingFile) {
    expect_refused(Bench{}, {"fly", "nowhere.yaml"}, {"nowhere.yaml", "No such file"});
}

TEST(BadInput, UnknownScenarioNamesWhatThereIs) {
    expect_refused(Bench{}, {"fly", "perch_concret"}, {"perch_concret", "perch_concrete"});
}

TEST(BadInput, YamlSyntax) {
    const Bench bench;
    (void)bench.write("x.yaml", std::string(kGood) + "wall: {surface: metal\n");
    expect_refused(bench, {"fly", "x.yaml"}, {"x.yaml:"});
}

TEST(BadInput, UnknownKeyWithItsLineAndASuggestion) {
    const Bench bench;
    (void)bench.write("x.yaml", std::string(kGood) + "simulation:\n  hovers_s: 3\n");
    expect_refused(bench, {"fly", "x.yaml"}, {"x.yaml:4", "hovers_s", "hover_s"});
}

TEST(BadInput, WrongTypeOutOfRangeAndNan) {
    const Bench bench;
    for (const char* value : {"fast", "-1", ".nan", "[1, 2]"}) {
        (void)bench.write("x.yaml", std::string(kGood) + "simulation:\n  hover_s: " + value + "\n");
        expect_refused(bench, {"fly", "x.yaml"}, {"x.yaml:4", "simulation.hover_s", "0.1..3600"});
    }
}

TEST(BadInput, UnknownSurfaceAndVehicle) {
    const Bench bench;
    expect_refused(bench, {"fly", "perch_concrete", "--set", "wall.surface=steel"},
                   {"steel", "metal"});
    expect_refused(bench, {"fly", "hover", "--set", "vehicle=perching_uva"},
                   {"perching_uva", "perching_uav"});
    expect_refused(bench, {"export", "nothing"}, {"nothing", "iris", "perch_concrete"});
}

TEST(BadInput, ExportRefusesOptionsThatWouldDoNothing) {
    const Bench bench;
    expect_refused(bench, {"export", "perching_uav", "--sensors"}, {"--sensors", "--format world"});
    expect_refused(bench, {"export", "perching_uav", "--format", "sdf", "--wall", "metal"},
                   {"--wall", "world"});
    expect_refused(bench, {"export", "perching_uav", "--format", "world", "--view", "side"},
                   {"--view", "--camera"});
    expect_refused(bench, {"export", "perch_metal", "--format", "world", "--wall", "metal"},
                   {"--wall", "vehicle"});
    expect_refused(bench, {"export", "perching_uav", "--set", "wall.surface=metal"},
                   {"--set", "scenario"});
    expect_refused(bench, {"export", "perching_uav", "--format", "world", "--wall", "steel"},
                   {"steel", "metal"});
    expect_refused(bench, {"export", "perching_uav", "--format", "wrold"}, {"wrold", "world"});
}

TEST(BadInput, ADirectoryAndAnEmptyFile) {
    const Bench bench;
    fs::create_directories(bench.folder() / "folder.yaml");
    expect_refused(bench, {"fly", "folder.yaml"}, {"folder.yaml", "directory"});
    (void)bench.write("empty.yaml", "");
    expect_refused(bench, {"fly", "empty.yaml"}, {"empty.yaml", "empty"});
}

TEST(BadInput, SettingsNameThemselves) {
    const Bench bench;
    expect_refused(bench, {"fly", "hover", "--set", "guidance.dock_speed_m_s=9"},
                   {"--set", "guidance.dock_speed_m_s", "0.01..3"});
    expect_refused(bench, {"fly", "hover", "--set", "guidance.dock_sped_m_s=1"},
                   {"dock_speed_m_s"});
    expect_refused(bench, {"fly", "hover", "--set", "nonsense"}, {"nonsense"});
    for (const char* seed : {"minus one", "-1", "18446744073709551616", "1.5", ""}) {
        expect_refused(bench, {"fly", "hover", "--seed", seed}, {"seed"});
    }
    expect_refused(bench, {"fly", "hover", "--set", "guidance.attempts=1.5"},
                   {"attempts", "whole"});
    expect_refused(bench, {"fly", "hover", "--set", "suction.valve_fitted=0.5"}, {"valve_fitted"});
}

TEST(BadInput, UnwritableOut) {
    const Bench bench;
    (void)bench.write("taken", "a file");
    expect_refused(bench, {"fly", "hover", "--out", "taken"}, {"--out", "taken"});
    expect_refused(bench, {"fly", "hover", "--out", "/proc/limpet"}, {"--out", "/proc/limpet"});
    (void)bench.write("file", "no folder");
    expect_refused(bench, {"export", "iris", "--out", "file/iris.xml"}, {"file"});
}

TEST(BadInput, AddressesOfTheWireNameTheirOption) {
    const Bench bench;
    const std::vector<std::string> px4 = {"fly", "hover", "--autopilot", "px4"};
    const auto with = [&px4](const char* option, const char* value) {
        std::vector<std::string> words = px4;
        words.insert(words.end(), {option, value});
        return words;
    };
    expect_refused(bench, with("--hil", ""), {"--hil", "tcp:HOST:PORT or serial:DEVICE:BAUD"});
    expect_refused(bench, with("--hil", "udp:127.0.0.1:4560"), {"--hil", "tcp:HOST:PORT"});
    expect_refused(bench, with("--hil", "tcp:127.0.0.1:0"), {"--hil", "'0'", "1 to 65535"});
    expect_refused(bench, with("--offboard", "tcp:127.0.0.1:1"), {"--offboard", "udp:HOST:PORT"});
    expect_refused(bench, with("--instance", "10"), {"--instance", "10", "0", "9"});
    expect_refused(bench, {"stand-in", "hover", "--peer", "tcp:1"}, {"--peer", "udp:HOST:PORT"});
    expect_refused(bench, {"sim-io", "hover", "--sensors", "tcp:1"},
                   {"--sensors", "udp:HOST:PORT"});
    expect_refused(bench, {"sim-io", "hover", "--sensors", "x"}, {"--sensors", "udp:HOST:PORT"});
}

TEST(BadInput, NoWaitOrSpeedIsNaN) {
    const Bench bench;
    for (const char* option : {"--wait", "--speed"}) {
        for (const char* value : {"nan", "inf", "0", "-1", "soon"}) {
            expect_refused(bench, {"fly", "hover", "--autopilot", "px4", option, value}, {option});
            expect_refused(bench, {"sim-io", "hover", option, value}, {option});
        }
    }
    expect_refused(bench, {"sim-io", "hover", "--start-limit", "nan"}, {"--start-limit"});
}

TEST(BadInput, OptionsThatWouldDoNothing) {
    const Bench bench;
    for (const char* option : {"--instance", "--hil", "--offboard", "--wait", "--patience"}) {
        expect_refused(bench, {"fly", "hover", option, "1"}, {option, "--autopilot px4"});
    }
    expect_refused(bench, {"fly", "hover", "--record-wire"}, {"--record-wire", "--autopilot px4"});
    expect_refused(bench, {"fly", "hover", "--no-record", "--csv"}, {"--csv", "--no-record"});
    expect_refused(bench, {"fly", "hover", "--no-record", "--out", "x"}, {"--out", "--no-record"});
    expect_refused(bench, {"fly", "hover", "--no-record", "--live"}, {"--live", "--no-record"});
    expect_refused(bench, {"fly", "hover", "--quiet", "--live"}, {"--live", "--quiet"});
    expect_refused(bench, {"fly", "hover", "--live-wait"}, {"--live-wait", "with --live"});
    expect_refused(bench, {"companion", "simulation", "--no-record", "--live"}, {"--live"});
    expect_refused(bench,
                   {"fly", "hover", "--autopilot", "px4", "--hil", "serial:/dev/null:57600",
                    "--offboard", "udp:127.0.0.1:14540"},
                   {"--offboard", "serial"});
    expect_refused(bench, {"fly", "pendulum_concrete", "--autopilot", "px4"}, {"mount"});
    expect_refused(bench, {"sim-io", "pendulum_concrete"}, {"mount"});
}

TEST(BadInput, APortOfALiveViewIsAPortThatIsFree) {
    const Bench bench;
    for (const char* port : {"hover", "65536", "-1", "8765x"}) {
        expect_refused(bench, {"fly", "hover", "--live", port}, {"--live", port, "0..65535"});
    }
    const TakenPort taken;
    expect_refused(bench, {"fly", "hover", "--live", taken.port()},
                   {"cannot serve on 127.0.0.1:" + taken.port(), "already in use"});
    EXPECT_TRUE(bench.files().empty());
}

TEST(BadInput, OptionsSayWhatTheyTake) {
    const Bench bench;
    expect_refused(bench, {"campaign", "x", "--jobs", "0"}, {"--jobs: must be 1 to 1024, not '0'"});
    expect_refused(bench, {"export", "iris", "--format", "foo"},
                   {"--format: foo not in {mjcf,sdf,urdf,world}"});
    expect_refused(bench, {"export", "iris", "--camera", "c", "--camera-rate", "nan"},
                   {"--camera-rate: must be 0.1 to 1000, not 'nan'"});
    expect_refused(bench, {"px4-params", "hover", "--mocap", "--gps"}, {"--mocap excludes --gps"});
    expect_refused(bench, {"compare", "one.mcap"}, {"recordings: At least 2 required"});
}

TEST(BadInput, UnknownVerbAndOption) {
    const Bench bench;
    expect_refused(bench, {"campain"},
                   {"\"campain\": no such verb, did you mean campaign? (limpet campaign --help)"});
    expect_refused(bench, {"xyzzy"}, {"no such verb; there are fly, ", "(limpet --help)"});
    expect_refused(bench, {"fly", "hover", "--sed", "3"},
                   {"\"--sed\": no such option, did you mean --seed? (limpet fly --help)"});
    expect_refused(bench, {"fly", "hover", "--sett", "a=b"}, {"did you mean --set?"});
    expect_refused(bench, {"fly", "hover", "-set", "a=b"}, {"did you mean --set?"});
    expect_refused(bench, {"fly", "hover", "--seeed=3"}, {"\"--seeed\"", "did you mean --seed?"});
    expect_refused(bench, {"fly", "--quiett"}, {"did you mean --quiet?"});
    expect_refused(bench, {"fly", "hover", "--qqqqqq"},
                   {"\"--qqqqqq\": no such option (limpet fly --help)"});
    expect_refused(bench, {"fly", "hover", "guidance.attempts=2"},
                   {"did you mean --set guidance.attempts=2? (limpet fly --help)"});
    expect_refused(bench, {"fly"}, {"scenario is required (limpet fly --help)"});
    expect_refused(bench, {"--versoin"}, {"did you mean --version? (limpet --help)"});
    expect_refused(bench, {"--json", "list", "faults"}, {"--json", "no such option"});
    expect_refused(bench, {"list", "planets"}, {"planets"});
    expect_refused(bench, {"params", "kitchen"}, {"kitchen", "guidance"});
}

TEST(BadInput, WhatIsNoRecording) {
    const Bench bench;
    (void)bench.write("x.mcap", "not a recording at all");
    (void)bench.write("empty.mcap", "");
    for (const char* verb : {"plot", "film", "csv", "check"}) {
        expect_refused(bench, {verb, "x.mcap"}, {"x.mcap"});
        expect_refused(bench, {verb, "empty.mcap"}, {"empty.mcap"});
        expect_refused(bench, {verb, "nowhere.mcap"}, {"nowhere.mcap"});
    }
}

TEST(BadInput, ARecordingCutInHalfIsPlottedAsFarAsItGoes) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "perch_concrete", "--json", "--out", "."}).exit_code, 0);
    const fs::path recording = bench.folder() / "flight.mcap";
    fs::resize_file(recording, fs::file_size(recording) / 2);
    const Finished plot = bench.run({"plot", "flight.mcap", "--out", "figures"});
    EXPECT_EQ(plot.exit_code, 2);
    EXPECT_THAT(plot.err, HasSubstr("flight.mcap"));
    EXPECT_TRUE(fs::exists(bench.folder() / "figures/overview.png"));
    EXPECT_TRUE(plot.one_line_of_error()) << plot.err;
    EXPECT_EQ(bench.run({"check", "flight.mcap"}).exit_code, 2);
    for (const char* verb : {"view", "calibrate"}) {
        const Finished used = bench.run({verb, "flight.mcap"});
        EXPECT_EQ(used.exit_code, 2) << verb;
        EXPECT_NE(used.out, "") << "what is whole is used";
        EXPECT_TRUE(used.one_line_of_error()) << used.err;
        EXPECT_THAT(used.err, HasSubstr("flight.mcap: cut off"));
    }
    fs::resize_file(recording, 100);  // not a message is whole
    expect_refused(bench, {"plot", "flight.mcap"}, {"flight.mcap"});
}

}  // namespace
}  // namespace limpet
