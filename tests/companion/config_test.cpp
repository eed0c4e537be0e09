// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "limpet/companion/wires.hpp"
#include "limpet/core/errors.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::companion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using wire::Medium;

const std::string kGood = R"(vehicle: perching_uav
mission: perch
motion_capture:
  source: natnet
  rigid_body: 3
  up: z
lidars:
  source: autopilot
mechanism:
  source: line
  address: serial:/dev/ttyACM0:115200
  valve: true
)";

CompanionConfig load(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const fs::path folder = fs::path(testing::TempDir()) /
                            testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder);
    const fs::path file = folder / "c.yaml";
    std::ofstream(file) << text;
    return load_companion(file.string(), overrides, LIMPET_SOURCE_DIR "/data");
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
        (void)load(text, overrides);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

TEST(CompanionConfig, ShippedOnesAreGood) {
    int count = 0;
    for (const auto& file :
         fs::directory_iterator(fs::path(LIMPET_SOURCE_DIR "/data") / "companions")) {
        const CompanionConfig config =
            load_companion(file.path().string(), {}, LIMPET_SOURCE_DIR "/data");
        EXPECT_FALSE(config.description.empty()) << file.path();
        EXPECT_GE(describe(config).size(), 8U);
        ++count;
    }
    EXPECT_EQ(count, 2);
    EXPECT_EQ(load_companion("simulation", {}, LIMPET_SOURCE_DIR "/data").name, "simulation");
}

TEST(CompanionConfig, HasTheDefaultsThatItsFilesName) {
    const CompanionConfig config = load(kGood);
    EXPECT_EQ(to_text(config.autopilot), "udp:127.0.0.1:14540");
    EXPECT_FALSE(config.asks_for_mode);
    EXPECT_EQ(config.system, 1);
    EXPECT_FALSE(config.sensors.has_value()) << "nothing needs it";
    EXPECT_EQ(to_text(config.pose_address), "udp-multicast:239.255.42.99:1511");
    EXPECT_EQ(config.rigid_body, 3);
    EXPECT_EQ(config.axes.up, devices::UpAxis::z);
    EXPECT_EQ(config.load_source, ReadingSource::serial);
    EXPECT_EQ(config.guidance.valve_fitted, true);
    EXPECT_FALSE(config.task.take_off);
    EXPECT_TRUE(has_serial(config));
    EXPECT_EQ(load(kGood + "sensors: {address: udp:14700}\n").sensors->port, 14700) << "named";
    EXPECT_EQ(load_companion("simulation", {}, LIMPET_SOURCE_DIR "/data").sensors->port, 14600);
}

TEST(CompanionConfig, DerivesGuidanceFromTheVehicleAsAScenarioDoes) {
    // 3.2 kg on four rotors of 2.5e-5, (sqrt(m g / 4 k) - 100) / 700: by hand.
    const CompanionConfig config = load(kGood);
    EXPECT_NEAR(config.guidance.hover_thrust,
                (std::sqrt(3.2 * kGravity_m_s2 / (4.0 * 2.5e-5)) - 100.0) / 700.0, 1e-12);
    EXPECT_EQ(config.guidance.joint_x_m, 0.46);
    EXPECT_EQ(load(kGood + "guidance: {hover_thrust: 0.5}\n").guidance.hover_thrust, 0.5);
}

TEST(CompanionConfig, TakesOverrides) {
    const CompanionConfig config =
        load(kGood, {"limits.wait_limit_s=5", "autopilot.address=udp:0.0.0.0:14541"});
    EXPECT_EQ(config.limits.wait_limit_s, 5.0);
    EXPECT_EQ(to_text(config.autopilot), "udp:0.0.0.0:14541");
    EXPECT_THAT(config.yaml, HasSubstr("# --set limits.wait_limit_s=5"));
    EXPECT_THAT(refusal(kGood, {"limits.wait_limit_s=0"}),
                HasSubstr("--set limits.wait_limit_s=0: 0 is out of range, allowed 1..3600 s"));
}

TEST(CompanionConfig, NamesAllThatIsMissingInOneLine) {
    EXPECT_THAT(refusal("description: nothing yet\n"),
                HasSubstr("c.yaml: is half a companion, missing lidars.source, mechanism.source, "
                          "mission, motion_capture.source, vehicle"));
    EXPECT_THAT(refusal(replaced(kGood, "  rigid_body: 3\n  up: z\n", "")),
                HasSubstr("missing motion_capture.rigid_body, motion_capture.up"));
    EXPECT_THAT(refusal(replaced(kGood, "  valve: true\n", "")),
                HasSubstr("missing mechanism.valve"));
    EXPECT_THAT(refusal(replaced(kGood, "source: autopilot", "source: tfmini")),
                HasSubstr("missing lidars.left, lidars.right"));
    EXPECT_THAT(refusal(kGood, {"motion_capture.address=udp:127.0.0.1:1511"}),
                HasSubstr("missing motion_capture.command"));
    EXPECT_THAT(refusal(replaced(kGood, "  address: serial:/dev/ttyACM0:115200\n", "")),
                HasSubstr("missing mechanism.address"));
}

TEST(CompanionConfig, RefusesWhatItDoesNotKnowWithPlaceAndHint) {
    struct Case {
        std::string text;
        const char* said;
    };
    const std::vector<Case> cases = {
        {kGood + "limit: {}\n", "c.yaml:13: limit: unknown key, did you mean limits?"},
        {kGood + "limits: {pose_limit: 1}\n",
         "c.yaml:13: limits.pose_limit: unknown key, did you mean pose_limit_s?"},
        {replaced(kGood, "up: z", "up: x"), "c.yaml:6: motion_capture.up: \"x\" is none of y, z"},
        {replaced(kGood, "source: natnet", "source: vicon"),
         "c.yaml:4: motion_capture.source: \"vicon\" is none of natnet, mavlink"},
        {replaced(kGood, "rigid_body: 3", "rigid_body: 0"),
         "c.yaml:5: motion_capture.rigid_body: 0 is out of range, allowed 1..65535"},
        {replaced(kGood, "rigid_body: 3", "rigid_body: 1.5"), "1.5 is not a whole number"},
        {replaced(kGood, "source: autopilot", "source: sonar"),
         "c.yaml:8: lidars.source: \"sonar\" is none of mavlink, autopilot, tfmini"},
        {replaced(kGood, "mission: perch", "mission: land"),
         "c.yaml:2: mission: \"land\" is none of hover, perch, perch_and_take_off"},
        {replaced(kGood, "serial:/dev/ttyACM0:115200", "udp:127.0.0.1:5"),
         "c.yaml:11: mechanism.address: \"udp:127.0.0.1:5\" cannot be used here, allowed "
         "serial:DEVICE:BAUD"},
        {kGood + "autopilot: {address: 14540}\n", "c.yaml:13: autopilot.address: "},
        {kGood + "autopilot: {address: udp-multicast:239.1.1.1:5}\n",
         "cannot be used here, allowed udp:HOST:PORT (listens)"},
        {kGood + "autopilot: {asks_for_mode: maybe}\n",
         "c.yaml:13: autopilot.asks_for_mode: must be true or false, is \"maybe\""},
        {replaced(kGood, "source: autopilot", "source: autopilot\n  left: serial:/dev/x:115200"),
         "c.yaml:9: lidars.left: is of use only with source: tfmini"},
        {replaced(kGood, "source: line\n  address: serial:/dev/ttyACM0:115200",
                  "source: mavlink\n  readings: line"),
         "mechanism.readings: line is of use only with source: line"},
        {kGood + "guidance: {valve_fitted: true}\n",
         "c.yaml:13: guidance.valve_fitted: is given by mechanism.valve"},
        {kGood + "guidance: {land_pressure_Pa: 99000}\n",
         "guidance.land_pressure_Pa must be below detach_pressure_Pa, 98000"},
        {kGood + "lidars2: 1\n", "lidars2: unknown key"},
        {replaced(kGood, "perching_uav", "submarine"), "submarine"},
    };
    for (const Case& c : cases) {
        EXPECT_THAT(refusal(c.text), HasSubstr(c.said));
        EXPECT_EQ(refusal(c.text).find('\n'), std::string::npos) << c.said;
    }
    const std::string odometry =
        replaced(kGood, "source: natnet\n  rigid_body: 3\n  up: z", "source: mavlink\n  up: z");
    EXPECT_THAT(refusal(odometry),
                HasSubstr("c.yaml:5: motion_capture.up: is of use only with source: natnet"));
}

TEST(CompanionConfig, RefusesAVehicleThatCannotPerchOrHover) {
    EXPECT_THAT(refusal(replaced(kGood, "vehicle: perching_uav",
                                 "vehicle: {base: perching_uav, has_cup: false}")),
                HasSubstr("has no cup to perch with"));
    EXPECT_THAT(refusal(replaced(kGood, "vehicle: perching_uav",
                                 "vehicle: {base: perching_uav, mass_kg: 9}")),
                HasSubstr("guidance.hover_thrust follows from it as"));
}

TEST(CompanionConfig, RefusesOneWireForTwo) {
    EXPECT_THAT(refusal(replaced(kGood, "source: autopilot",
                                 "source: tfmini\n  left: serial:/dev/ttyUSB0:115200\n"
                                 "  right: serial:/dev/ttyUSB0:115200")),
                HasSubstr("lidars.left and lidars.right are both serial:/dev/ttyUSB0:115200"));
}

TEST(CompanionConfig, TheLoopsPriorityCanBeTurnedAndTurnedOff) {
    EXPECT_EQ(load(kGood).real_time_priority, 20);
    EXPECT_EQ(load(kGood + "loop: {real_time_priority: 0}\n").real_time_priority, 0);
    EXPECT_EQ(load(kGood, {"loop.real_time_priority=49"}).real_time_priority, 49);
    EXPECT_THAT(refusal(kGood + "loop: {real_time_priority: 50}\n"),
                HasSubstr("loop.real_time_priority: 50 is out of range, allowed 0..49"));
    EXPECT_THAT(refusal(kGood + "loop: {real_time_priority: 1.5}\n"), HasSubstr("whole"));
    EXPECT_THAT(refusal(kGood + "loop: {priority: 5}\n"), HasSubstr("priority"));
    const auto describes = [](const CompanionConfig& config, const std::string& line) {
        const std::vector<std::string> lines = describe(config);
        return std::find(lines.begin(), lines.end(), line) != lines.end();
    };
    EXPECT_TRUE(describes(load(kGood), "loop        requests SCHED_FIFO 20 and locked memory"));
    EXPECT_TRUE(describes(load(kGood + "loop: {real_time_priority: 0}\n"),
                          "loop        at ordinary priority, as its file wants"));
}

TEST(CompanionConfig, KeepsSigningTimestampsBesideTheKeyOrElsewhere) {
    EXPECT_THAT(refusal(kGood + "signing_state_folder: s\n"),
                HasSubstr("signing_state_folder: is of use only with signing_key_file"));
    CompanionConfig config = load(kGood + "signing_key_file: key\nsigning_state_folder: s\n");
    EXPECT_EQ(config.signing_state_folder, config.signing_key_file.parent_path() / "s");
    config.autopilot = {.medium = Medium::udp};
    config.mechanism = MechanismWire::mavlink;
    config.pose_source = PoseSource::mavlink;
    fs::remove_all(config.signing_state_folder);
    fs::remove(config.signing_key_file);
    fs::create_directories(config.signing_state_folder);
    std::ofstream(config.signing_key_file) << std::string(64, 'b');
    fs::permissions(config.signing_key_file, fs::perms::owner_read | fs::perms::owner_write);
    check_signing(config);
    EXPECT_TRUE(fs::is_empty(config.signing_state_folder)) << "checks, writes nothing";
    EXPECT_TRUE(open_wires(config).notices.empty());
    const fs::path stamps = config.signing_state_folder / "key.stamps-1-191-0";
    EXPECT_TRUE(fs::exists(stamps));
    std::ofstream(stamps) << "rubbish\n";
    EXPECT_THROW(check_signing(config), InputError);
    EXPECT_THROW((void)open_wires(config), InputError);
}

TEST(CompanionConfig, RefusesAKeyFileThatIsNone) {
    const CompanionConfig config =
        load(replaced(kGood, "mission: perch", "mission: perch\nsigning_key_file: no_key"));
    EXPECT_TRUE(config.signing_key_file.is_absolute());
    try {
        (void)open_wires(config);
        FAIL() << "opened";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no_key"));
    }
}

TEST(CompanionParameters, AreAllInTheirTablesOnceAndInRange) {
    test::expect_whole(companion_limits_table(), "limits");
    CompanionConfig defaults;
    for (const scenario::Section& section : companion_sections(defaults)) {
        for (const BoundParameter& row : section.rows) {
            EXPECT_LT(row.minimum, row.maximum) << row.name;
            EXPECT_TRUE(row.allows(row.value.get())) << row.name;
            EXPECT_FALSE(row.source.empty() || row.description.empty() || row.unit.empty())
                << row.name;
        }
    }
}

}  // namespace
}  // namespace limpet::companion
