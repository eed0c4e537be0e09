// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Letters of the longest line.
std::size_t width(const std::string& text) {
    std::size_t longest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        longest = std::max(longest, line.size());
    }
    return longest;
}

/// A heading of the help and the verbs below it.
struct Group {
    std::string heading;
    std::vector<std::string> verbs;
};

/// Of the help after its options, up to "Start here:".
std::vector<Group> groups_of(const std::string& help) {
    std::vector<Group> groups;
    const std::size_t from = help.find("\n\n", help.find("Options:"));
    std::istringstream lines(help.substr(from, help.find("\nStart here:") - from));
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.rfind("    ", 0) == 0) {
            continue;  // between groups, or what a verb is about
        }
        if (line[0] != ' ') {
            groups.push_back({line.substr(0, line.size() - 1), {}});
        } else {
            std::istringstream(line) >> groups.back().verbs.emplace_back();
        }
    }
    return groups;
}

TEST(Verbs, EachHasAHelpThatNamesItsOptionsAndFitsAHundredColumns) {
    const Bench bench;
    const Finished all = bench.run({"--help"});
    EXPECT_THAT(all.out, HasSubstr("limpet fly perch_concrete"));
    EXPECT_LE(width(all.out), 100U);
    const std::vector<Group> groups = groups_of(all.out);
    ASSERT_EQ(groups.size(), 5U) << all.out;
    for (const Group& group : groups) {
        EXPECT_THAT(group.verbs, testing::SizeIs(testing::AllOf(testing::Ge(4U), testing::Le(7U))))
            << group.heading << ": as many as one takes in at a glance";
        for (const std::string& verb : group.verbs) {
            const Finished help = bench.run({verb, "--help"});
            EXPECT_EQ(help.exit_code, 0) << verb;
            EXPECT_THAT(help.out, HasSubstr("--help"));
            EXPECT_LE(width(help.out), 100U) << help.out;
            EXPECT_EQ(help.err, "");
        }
    }
    EXPECT_EQ(groups.front().verbs.front(), "fly");
    EXPECT_THAT(bench.run({"help", "--man"}).out, HasSubstr(".SH \"FLY MANY\""));
}

/// As cargo does, which answers who does not know what to ask; git's exit code 1 is another
/// outcome than --expect here, 2 is bad input, and this is neither.
TEST(Verbs, TheProgramAlonePrintsItsHelp) {
    const Bench bench;
    const Finished alone = bench.run({});
    EXPECT_EQ(alone.exit_code, 0);
    EXPECT_EQ(alone.err, "");
    EXPECT_EQ(alone.out, bench.run({"--help"}).out);
}

TEST(Verbs, HelpEndsWithTheProgramsFooterUnlessAVerbHasItsOwn) {
    const Bench bench;
    EXPECT_THAT(bench.run({"list", "--help"}).out, HasSubstr("Start here:"));
    EXPECT_THAT(bench.run({"check", "--help"}).out, Not(HasSubstr("Start here:")));
}

TEST(Verbs, HelpIsAVerbToo) {
    const Bench bench;
    EXPECT_EQ(bench.run({"help"}).out, bench.run({"--help"}).out);
    EXPECT_EQ(bench.run({"help", "fly"}).out, bench.run({"fly", "--help"}).out);
    const Finished wrong = bench.run({"help", "flyy"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("\"flyy\": no such verb, did you mean fly?"));
}

TEST(Verbs, AVehiclesPathCountsFromWhereTheCommandIsGiven) {
    const Bench bench;
    std::filesystem::copy(
        std::filesystem::path(LIMPET_SOURCE_DIR) / "data/vehicles/perching_uav.yaml",
        bench.folder() / "mine.yaml");
    const Finished own = bench.run({"fly", "hover", "--set", "vehicle=mine.yaml", "--no-record"});
    EXPECT_EQ(own.exit_code, 0) << own.err;
    const Finished none = bench.run({"fly", "hover", "--set", "vehicle=none.yaml", "--no-record"});
    EXPECT_EQ(none.exit_code, 2);
}

TEST(Verbs, Version) {
    const Finished version = Bench{}.run({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, testing::MatchesRegex("limpet [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Verbs, ListsWhatShips) {
    const Bench bench;
    for (const char* name : {"perch_concrete", "perch_cinder_block", "perch_turbine_blade",
                             "perch_metal", "perch_metal_valve", "failed_perch", "hover"}) {
        EXPECT_THAT(bench.run({"list", "scenarios"}).out, HasSubstr(name));
        EXPECT_EQ(bench.run({"check", name}).exit_code, 0) << name;
    }
    for (const char* name : {"porous_concrete", "cinder_block", "turbine_blade", "metal"}) {
        EXPECT_THAT(bench.run({"list", "surfaces"}).out, HasSubstr(name));
    }
    EXPECT_THAT(bench.run({"list", "samples"}).out,
                testing::AllOf(HasSubstr("pressure_log      Pressure under a cup"),
                               HasSubstr("\npropeller_static  GENERATED")));
    EXPECT_THAT(bench.run({"list", "vehicles"}).out, HasSubstr("iris"));
    EXPECT_THAT(bench.run({"list", "campaigns"}).out, HasSubstr("impact_speed"));
}

/// In any kind that a verb finds by name, from any folder.
TEST(Verbs, CheckFindsByName) {
    const Bench bench;
    for (const auto& [name, kind] :
         {std::pair("perch_metal", "a good scenario"),
          std::pair("iris", "a good vehicle of 1.50 kg"),
          std::pair("fig3", "a good campaign: 253 runs of pendulum_concrete"),
          std::pair("optitrack_px4",
                    "a good companion; what it would do: limpet companion "
                    "optitrack_px4 --check"),
          std::pair("metal", "a good surface: "),
          std::pair("pressure_log", "a good log (CSV), samples: pressure 738"),
          std::pair("samples/pressure_log.csv", "a good log (CSV)"),
          std::pair("propeller_static", "a good propeller file of 12 rows")}) {
        const Finished done = bench.run({"check", name});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_THAT(done.out, testing::StartsWith(std::string(name) + ": " + kind));
    }
    const Finished unknown = bench.run({"check", "iriss"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_EQ(unknown.err,
              "limpet: \"iriss\": no such file, scenario, vehicle, campaign, companion, surface or "
              "sample, did you mean iris?\n");
    EXPECT_THAT(bench.run({"check", "qqqq"}).err, HasSubstr("limpet list KIND"));
    EXPECT_EQ(bench.run({"check", "nowhere.csv"}).exit_code, 2);
}

/// With data in which a name stands for two things.
TEST(Verbs, CheckAsksWhichOfTwo) {
    const Bench bench;
    std::filesystem::create_directories(bench.folder() / "scenarios");
    std::filesystem::create_directories(bench.folder() / "vehicles");
    (void)bench.write("surfaces.yaml", "stone: {description: grey}\n");
    (void)bench.write("scenarios/mine.yaml", "mission: hover\nvehicle: mine\n");
    (void)bench.write("vehicles/mine.yaml", "mass_kg: 3\n");
    ::setenv("LIMPET_DATA", bench.folder().c_str(), 1);
    const Finished two = bench.run({"check", "mine"});
    const Finished one = bench.run({"check", "vehicles/mine.yaml"});
    ::unsetenv("LIMPET_DATA");
    EXPECT_EQ(two.exit_code, 2);
    EXPECT_TRUE(two.one_line_of_error()) << two.err;
    EXPECT_THAT(two.err, HasSubstr("\"mine\": is a scenario and a vehicle; give "));
    EXPECT_EQ(one.exit_code, 0) << one.err;
}

TEST(Verbs, CheckKnowsAFileByWhatIsInIt) {
    const Bench bench;
    const std::filesystem::path root = LIMPET_SOURCE_DIR "/data";
    for (const auto& [file, kind] :
         {std::pair("vehicles/perching_x8.yaml", "a good vehicle of 4.10 kg"),
          std::pair("campaigns/fig3.yaml", "a good campaign: 253 runs"),
          std::pair("companions/optitrack_px4.yaml", "a good companion"),
          std::pair("scenarios/perch_concrete.yaml", "a good scenario")}) {
        std::filesystem::copy_file(root / file, bench.folder() / "big.yaml",
                                   std::filesystem::copy_options::overwrite_existing);
        const Finished done = bench.run({"check", "big.yaml"});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_THAT(done.out, HasSubstr(kind));
    }
    (void)bench.write("big.yaml", "mass_kg: 3\nrotors: [{x_m: 1}]\n");
    const Finished bad = bench.run({"check", "big.yaml"});
    EXPECT_EQ(bad.exit_code, 2);
    EXPECT_TRUE(bad.one_line_of_error());
    EXPECT_THAT(bad.err, HasSubstr("big.yaml:2: rotors: must be a list of 4 to 12 rotors, has 1"));
    (void)bench.write("big.yaml", "has_cup: true\nmass_kg: 30\n");
    const Finished heavy = bench.run({"check", "big.yaml"});
    EXPECT_EQ(heavy.exit_code, 2);
    EXPECT_TRUE(heavy.one_line_of_error()) << heavy.err;
    EXPECT_THAT(heavy.err, HasSubstr("big.yaml: guidance.hover_thrust follows from it as 2.307"));
    EXPECT_THAT(heavy.err, HasSubstr("its rotors do not lift it"));
    std::filesystem::create_directory(bench.folder() / "a #b: c");
    std::filesystem::copy_file(root / "vehicles/iris.yaml", bench.folder() / "a #b: c/iris.yaml");
    EXPECT_EQ(bench.run({"check", "a #b: c/iris.yaml"}).exit_code, 0);
}

/// The verdict counts what does not stop a flight, and a vehicle that does not hover is no good
/// one.
TEST(Verbs, CheckCountsItsRemarks) {
    const Bench bench;
    (void)bench.write("legs.yaml", "mass_kg: 3.2\nlegs: {tip_z_m: 0.9}\n");
    const Finished legs = bench.run({"check", "legs.yaml"});
    EXPECT_EQ(legs.exit_code, 0) << legs.err;
    EXPECT_THAT(legs.out, testing::AllOf(HasSubstr("a good vehicle of 3.20 kg; 1 remark\n"),
                                         HasSubstr("\n  remark: legs.tip_z_m: the legs reach")));
    (void)bench.write("light.yaml", "mass_kg: 0.565\n");
    const Finished light = bench.run({"check", "light.yaml"});
    EXPECT_THAT(light.out + light.err, HasSubstr("it hovers at motor command 0.19"));
    (void)bench.write("far.yaml",
                      "vehicle: perching_uav\nwall: {surface: metal}\n"
                      "simulation: {start_distance_m: 8}\n");
    const Finished far = bench.run({"check", "far.yaml"});
    EXPECT_EQ(far.exit_code, 0) << far.err;
    EXPECT_THAT(far.out, testing::AllOf(HasSubstr("; 1 remark\n"),
                                        HasSubstr("guidance.wall_near_limit_m 6")));
    (void)bench.write("grid.yaml",
                      "scenario: hover\nruns: 2\nparameters:\n"
                      "  simulation.start_yaw_deg: {grid: [1, 2, 3]}\n");
    EXPECT_THAT(bench.run({"check", "grid.yaml"}).out,
                testing::AllOf(HasSubstr("2 runs of hover; 1 remark\n"),
                               HasSubstr("runs: 2 is fewer than the grids' 3 points")));
    EXPECT_THAT(bench.run({"campaign", "grid.yaml", "--jobs", "1"}).out,
                HasSubstr("note: runs: 2 is fewer"));
    (void)bench.write("p.csv", "\xEF\xBB\xBFRPM,CT,CP\n3000,0.1,0.04\n");
    EXPECT_THAT(bench.run({"check", "p.csv"}).out, HasSubstr("a good propeller file of 1 rows"));
    std::string log = "t_s,pressure_Pa\n";
    for (int k = 0; k < 100; ++k) {
        log += std::to_string(0.01 * k) + (k < 50 ? ",1010\n" : ",650\n");
    }
    (void)bench.write("log.csv", log);
    EXPECT_THAT(bench.run({"check", "log.csv"}).out,
                testing::AllOf(HasSubstr("; 1 remark\n"), HasSubstr("hPa? It must be in Pa")));
}

/// Of a flight on a real PX4 v1.15.1.
TEST(Verbs, CheckCountsWhatWentOverAWire) {
    const Bench bench;
    const std::string data = std::string(LIMPET_SOURCE_DIR) + "/tests/data/";
    const std::string wire = text_of(data + "px4_1.15.1_hil_perch_concrete.mcap");
    (void)bench.write("wire.mcap", wire);
    const Finished whole = bench.run({"check", "wire.mcap"});
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_THAT(whole.out, HasSubstr("wire.mcap: a whole recording of a wire, "));
    EXPECT_THAT(whole.out, testing::ContainsRegex("\n  sent      .*HIL_SENSOR [0-9]{4}"));
    EXPECT_THAT(whole.out,
                testing::ContainsRegex("\n  received  .*HIL_ACTUATOR_CONTROLS [0-9]{4}"));
    (void)bench.write("wire.mcap", wire.substr(0, wire.size() / 2));
    const Finished half = bench.run({"check", "wire.mcap"});
    EXPECT_EQ(half.exit_code, 2);
    EXPECT_TRUE(half.one_line_of_error()) << half.err;
}

TEST(Verbs, ExportNamesWhatItWroteAndMakesItsFolder) {
    const Bench bench;
    const Finished model = bench.run({"export", "perching_hexa", "--out", "new/hexa.xml"});
    EXPECT_EQ(model.out, "new/hexa.xml\n");
    EXPECT_THAT(text_of(bench.folder() / "new/hexa.xml"), HasSubstr("rotor_5"));
    const Finished world =
        bench.run({"export", "perch_metal", "--format", "world", "--out", "g/m.world"});
    EXPECT_THAT(world.out, testing::StartsWith("g/m.world\n"));
    EXPECT_THAT(world.out, HasSubstr(".material\n"));
}

/// Neither a link nor a device becomes a file in its place.
TEST(Verbs, ExportWritesThroughWhatIsNoFile) {
    const Bench bench;
    (void)bench.write("real.xml", "old");
    std::filesystem::create_symlink("real.xml", bench.folder() / "link.xml");
    EXPECT_EQ(bench.run({"export", "perching_uav", "--out", "link.xml"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(bench.folder() / "link.xml"));
    EXPECT_THAT(text_of(bench.folder() / "real.xml"), HasSubstr("rotor_3"));
    const auto pipe = bench.folder() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDWR | O_NONBLOCK);  // it holds more than a model
    EXPECT_EQ(bench.run({"export", "perching_uav", "--out", "pipe"}).exit_code, 0);
    std::string piped(1U << 16U, ' ');
    piped.resize(
        static_cast<std::size_t>(std::max<ssize_t>(0, read(reader, piped.data(), piped.size()))));
    close(reader);
    EXPECT_EQ(piped, text_of(bench.folder() / "real.xml"));
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    std::filesystem::create_symlink("new.xml", bench.folder() / "ahead.xml");
    EXPECT_EQ(bench.run({"export", "perching_uav", "--out", "ahead.xml"}).exit_code, 0);
    EXPECT_EQ(text_of(bench.folder() / "new.xml"), piped);
    EXPECT_EQ(bench.run({"export", "perching_uav", "--out", "/dev/stdout"}).out,
              piped + "/dev/stdout\n");
}

/// Neither does it on a narrow one, where descriptions go on further left.
TEST(Verbs, HelpFitsAnyTerminal) {
    for (const auto columns : std::initializer_list<unsigned short>{60, 80, 120}) {
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"--help"}, {"check", "--help"}}) {
            std::istringstream lines(
                std::regex_replace(on_terminal(words, columns), std::regex("\r"), ""));
            for (std::string line; std::getline(lines, line);) {
                EXPECT_LE(line.size(), columns) << line;
            }
        }
    }
}

/// On a terminal of 80 columns nothing wraps by itself.
TEST(Verbs, FoldsItsLinesToTheTerminal) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"fly", "perch_concrete", "--no-record"}, {"fly", "--help"}}) {
        const std::string text = on_terminal(words, 80);
        ASSERT_THAT(text, HasSubstr(words.back() == "--help" ? "--seed" : "released"));
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            // what the next progress replaces, and colours, are no part of a line
            const std::string_view cleared = "\x1b[K";
            if (const auto at = line.rfind(cleared); at != std::string::npos) {
                line.erase(0, at + cleared.size());
            }
            line = std::regex_replace(line, std::regex("\x1b\\[[0-9;]*m|\r"), "");
            EXPECT_LE(line.size(), 80U) << line;
        }
    }
}

TEST(Verbs, ParamsOfOneRoomAndTheGeneratedPage) {
    const Bench bench;
    EXPECT_THAT(bench.run({"params", "guidance"}).out, HasSubstr("dock_speed_m_s"));
    EXPECT_THAT(bench.run({"params", "guidance"}).out,
                testing::ContainsRegex("^ +default  unit +allowed +what  \\[source\\]\n"));
    EXPECT_THAT(bench.run({"params", "guidance"}).out, Not(HasSubstr("MC_PITCHRATE_P")));
    EXPECT_EQ(bench.run({"params", "--format", "markdown"}).out,
              text_of(std::filesystem::path(LIMPET_SOURCE_DIR) / "docs/parameters.md"))
        << "limpet params --format markdown > docs/parameters.md";
}

TEST(Verbs, ExportsEveryFormat) {
    const Bench bench;
    EXPECT_THAT(bench.run({"export", "perching_uav"}).out, HasSubstr("<mujoco"));
    EXPECT_THAT(bench.run({"export", "perching_uav", "--format", "sdf"}).out, HasSubstr("<sdf"));
    EXPECT_THAT(bench.run({"export", "iris", "--format", "urdf"}).out, HasSubstr("<robot"));
    ASSERT_EQ(bench.run({"export", "perching_uav", "--wall", "metal", "--out", "a.xml"}).exit_code,
              0);
    EXPECT_THAT(text_of(bench.folder() / "a.xml"), HasSubstr("wall"));
}

TEST(Verbs, ExportsAWorldWithWhatStandsBesideIt) {
    const Bench bench;
    const Finished plain = bench.run(
        {"export", "perch_metal", "--format", "world", "--set", "suction.valve_fitted=1"});
    EXPECT_EQ(plain.exit_code, 0) << plain.err;
    EXPECT_THAT(plain.out, HasSubstr("<scenario>perch_metal</scenario>"));
    EXPECT_THAT(plain.out, HasSubstr("<set>suction.valve_fitted=1</set>"));
    EXPECT_THAT(plain.out, Not(HasSubstr("file://materials")));
    EXPECT_TRUE(bench.files().empty());
    ASSERT_EQ(bench
                  .run({"export", "perching_uav", "--format", "world", "--wall", "metal",
                        "--camera", "frames", "--out", "wall.world"})
                  .exit_code,
              0);
    EXPECT_THAT(bench.files(),
                testing::IsSupersetOf({"wall.world", "materials/scripts/showroom.material",
                                       "materials/textures/limpet_steel.tga"}));
    const std::string world = text_of(bench.folder() / "wall.world");
    EXPECT_THAT(world, HasSubstr("wall_metal"));
    EXPECT_THAT(world, Not(HasSubstr("wall_cinder_block")));
    EXPECT_THAT(world, HasSubstr((bench.folder() / "frames").string()));
    // A user's file is named so that a gzserver finds it from anywhere.
    (void)bench.write("mine.yaml", "mission: hover\nvehicle: perching_uav\n");
    EXPECT_THAT(bench.run({"export", "mine.yaml", "--format", "world"}).out,
                HasSubstr("<scenario>" + (bench.folder() / "mine.yaml").string()));
}

TEST(Verbs, FilmDrawsTheManoeuvre) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "perch_concrete", "--json", "--out", "."}).exit_code, 0);
    const Finished film = bench.run({"film", "flight.mcap"});
    EXPECT_EQ(film.exit_code, 0) << film.err;
    EXPECT_GT(std::filesystem::file_size(bench.folder() / "perching_film.png"), 50000U);
    EXPECT_GT(std::filesystem::file_size(bench.folder() / "take_off_film.png"), 50000U);
}

}  // namespace
}  // namespace limpet
