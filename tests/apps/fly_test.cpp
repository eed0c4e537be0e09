// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace limpet {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

TEST(Fly, PrintsExactlyOneJsonObject) {
    const Bench bench;
    const Finished flight = bench.run({"fly", "perch_concrete", "--json"});
    ASSERT_EQ(flight.exit_code, 0) << flight.err;
    const json result = json::parse(flight.out);  // throws on anything else
    EXPECT_EQ(result["outcome"], "released");
    EXPECT_EQ(result["attempts"], 1);
    EXPECT_EQ(result["scenario"], "perch_concrete");
    EXPECT_TRUE(std::filesystem::exists(bench.folder() / result["recording"].get<std::string>()));
    EXPECT_EQ(result["events"][0]["name"], "pre_positioned");
    EXPECT_GT(result["events"][0]["t_s"], 0.0);
    EXPECT_TRUE(result["events"][0]["values"].contains("distance_m"));
    EXPECT_THAT(flight.err, HasSubstr("pre_positioned"));
}

TEST(Fly, TellsAPersonWhatHappenedAndWhereItLies) {
    const Bench bench;
    const Finished flight = bench.run({"fly", "perch_concrete", "--out", "here"});
    ASSERT_EQ(flight.exit_code, 0) << flight.err;
    for (const char* text : {"outcome    released", "impact", "perched", "to spare N", "energy",
                             "times real time", "here/flight.mcap", "here/overview.png"}) {
        EXPECT_THAT(flight.out, HasSubstr(text));
    }
    EXPECT_THAT(bench.files(), Contains("here/perching.svg"));
    EXPECT_THAT(bench.files(), Contains("here/take_off.png"));
}

/// A picture next to a recording is of that flight.
TEST(Fly, FiguresOfTheFlightBeforeGoWithIt) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "perch_concrete", "--out", "."}).exit_code, 0);
    (void)bench.write("perching.txt", "mine");
    ASSERT_THAT(bench.files(), testing::IsSupersetOf({"overview.png", "take_off.svg"}));
    ASSERT_EQ(bench.run({"fly", "hover", "--out", "."}).exit_code, 0);
    EXPECT_THAT(bench.files(), testing::UnorderedElementsAre("flight.mcap", "overview.png",
                                                             "overview.svg", "perching.txt"));
    ASSERT_EQ(bench.run({"fly", "hover", "--quiet", "--out", "."}).exit_code, 0);
    EXPECT_THAT(bench.files(), testing::UnorderedElementsAre("flight.mcap", "perching.txt"));
    std::filesystem::create_symlink("old.ulg", bench.folder() / "flight.ulg");
    EXPECT_EQ(bench.run({"ulog", "flight.mcap"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(bench.folder() / "flight.ulg"));
}

/// A stranger's folder puts nothing of its own under a flight.
TEST(Fly, IsTheSameFromEveryFolder) {
    const Bench bench;
    namespace fs = std::filesystem;
    const fs::path foreign = bench.folder() / "foreign", empty = bench.folder() / "empty";
    fs::create_directories(empty);
    for (const char* root : {"", "share/limpet"}) {
        for (const char* folder : {"scenarios", "vehicles"}) {
            fs::create_directories(foreign / root / folder);
        }
        const auto put = [&](const char* name, const char* text) {
            (void)bench.write((foreign.filename() / root / name).string(), text);
        };
        put("surfaces.yaml", "concrete: {friction: 0.01}\n");
        put("scenarios/perch_concrete.yaml", "mission: hover\n");
        put("vehicles/perching_hexa.yaml", "mass_kg: 9\n");
    }
    std::string first;
    for (const fs::path& folder :
         {empty, foreign, fs::path(LIMPET_SOURCE_DIR "/data"), fs::path("/")}) {
        const std::string out = (bench.folder() / "out").string();
        const Finished flight = bench.run_in(
            folder,
            {"fly", "perch_concrete", "--set", "vehicle=perching_hexa", "--json", "--out", out});
        ASSERT_EQ(flight.exit_code, 0) << folder << flight.err;
        const std::string hash = json::parse(flight.out)["state_hash"];
        first = first.empty() ? hash : first;
        EXPECT_EQ(hash, first) << folder;
    }
}

TEST(Fly, WritesOnlyIntoOut) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "hover", "--json"}).exit_code, 0);
    EXPECT_THAT(bench.files(), testing::ElementsAre("out", "out/hover", "out/hover/flight.mcap"));
}

TEST(Fly, NoRecordWritesNothing) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "hover", "--no-record"}).exit_code, 0);
    EXPECT_TRUE(bench.files().empty());
}

TEST(Fly, QuietSaysNothing) {
    const Bench bench;
    const Finished flight = bench.run({"fly", "hover", "--quiet"});
    EXPECT_EQ(flight.exit_code, 0);
    EXPECT_EQ(flight.out + flight.err, "");
}

TEST(Fly, ExpectationsDecideTheExitCode) {
    const Bench bench;
    EXPECT_EQ(bench.run({"fly", "hover", "--no-record", "--expect", "released"}).exit_code, 0);
    const Finished other =
        bench.run({"fly", "hover", "--no-record", "--quiet", "--expect", "perched"});
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_TRUE(other.one_line_of_error()) << other.err;
    EXPECT_EQ(bench.run({"fly", "hover", "--expect", "landed"}).exit_code, 2);
}

TEST(Fly, SeedsAndSettingsReachTheFlight) {
    const Bench bench;
    const auto hash = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"fly", "hover", "--json", "--no-record"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return json::parse(bench.run(arguments).out)["state_hash"].get<std::string>();
    };
    const std::string first = hash({"--seed", "5"});
    EXPECT_EQ(first, hash({"--seed", "5"}));
    EXPECT_NE(first, hash({"--seed", "6"}));
    EXPECT_NE(first, hash({"--seed", "5", "--set", "vehicle.mass_kg=3.3"}));
}

TEST(Fly, CsvOnRequest) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "hover", "--json", "--csv"}).exit_code, 0);
    EXPECT_THAT(bench.files(), Contains("out/hover/csv/events.csv"));
    EXPECT_THAT(bench.files(), Contains("out/hover/csv/sensors_imu.csv"));
}

TEST(Fly, TheRecordedScenarioFliesTheSameAgain) {
    const Bench bench;
    ASSERT_EQ(bench
                  .run({"fly", "perch_concrete", "--json", "--seed", "9", "--set",
                        "guidance.dock_speed_m_s=1.05", "--out", "a"})
                  .exit_code,
              0);
    // The scenario as flown is attached to the recording: take it out and fly it.
    ASSERT_EQ(bench.run({"csv", "a/flight.mcap"}).exit_code, 0);
    const std::string yaml = text_of(bench.folder() / "a/csv/scenario.yaml");
    ASSERT_FALSE(yaml.empty());
    const auto path = bench.write("again.yaml", yaml);
    ASSERT_EQ(bench.run({"fly", path.string(), "--json", "--out", "b"}).exit_code, 0);
    ASSERT_EQ(bench.run({"csv", "b/flight.mcap"}).exit_code, 0);
    EXPECT_EQ(json::parse(text_of(bench.folder() / "a/csv/summary.json"))["state_hash"],
              json::parse(text_of(bench.folder() / "b/csv/summary.json"))["state_hash"]);
}

}  // namespace
}  // namespace limpet
