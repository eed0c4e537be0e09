// SPDX-License-Identifier: Apache-2.0
//
// Campaigns as a user meets them: killed, interrupted, resumed, replayed, and fed with nonsense.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "campaigns.hpp"
#include "limpet/core/errors.hpp"
#include "running.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kRuns = 250;

std::uint32_t finished_in(const fs::path& file) {
    try {
        return fs::exists(file) ? Results(file, Access::read).finished() : 0;
    } catch (const InputError&) {
        return 0;  // between two states of its log
    }
}

/// Flies kRuns hovers, sends the signal when some are there, resumes; compares with a whole one.
struct Cut {
    int ended = 0;
    std::uint32_t kept = 0;
    std::string log;
    Finished resumed;
    bool same = false;
};

Cut cut_and_resume(const Bench& bench, int signal) {
    (void)bench.write("x.yaml", short_hovers(kRuns));
    const fs::path file = bench.folder() / "cut/results.sqlite";
    Cut cut;
    {
        Running running(bench.folder(), {"campaign", "x.yaml", "--jobs", "2", "--out", "cut"});
        EXPECT_TRUE(eventually([&] { return finished_in(file) >= 10; }));
        running.signal(signal);
        cut.ended = running.wait();
    }
    cut.log = text_of(bench.folder() / "log");
    cut.kept = finished_in(file);
    const auto before = table_of(file);
    cut.resumed = bench.run({"campaign", "x.yaml", "--jobs", "2", "--out", "cut", "--resume"});
    EXPECT_EQ(bench.run({"campaign", "x.yaml", "--jobs", "1", "--out", "whole", "-q"}).exit_code,
              0);
    const auto after = table_of(file);
    const auto whole = table_of(bench.folder() / "whole/results.sqlite");
    EXPECT_EQ(whole.size(), static_cast<std::size_t>(kRuns));
    cut.same = after == whole;
    for (const auto& row : before) {
        EXPECT_THAT(after, testing::Contains(row));
    }
    return cut;
}

TEST(CampaignProgram, KilledAndResumedItLosesNothingAndRepeatsNothing) {
    const Bench bench;
    const Cut cut = cut_and_resume(bench, SIGKILL);
    EXPECT_EQ(cut.ended, -SIGKILL);
    EXPECT_GE(cut.kept, 10U);
    EXPECT_LT(cut.kept, static_cast<std::uint32_t>(kRuns)) << "killed too late to prove anything";
    EXPECT_EQ(cut.resumed.exit_code, 0) << cut.resumed.err;
    EXPECT_THAT(cut.resumed.out, HasSubstr(std::to_string(kRuns - cut.kept) + " runs flown in"));
    EXPECT_TRUE(cut.same);
}

TEST(CampaignProgram, InterruptedItStopsCleanlyAndSaysHowToGoOn) {
    const Bench bench;
    const Cut cut = cut_and_resume(bench, SIGINT);
    EXPECT_EQ(cut.ended, 130);
    EXPECT_THAT(cut.log, HasSubstr("stopped after " + std::to_string(cut.kept)));
    EXPECT_THAT(cut.log, HasSubstr("limpet campaign x.yaml --out cut --resume"));
    EXPECT_TRUE(cut.same);
    EXPECT_THAT(bench.files(), testing::Not(testing::Contains(HasSubstr("-wal"))));
}

class Flown : public testing::Test {
protected:
    Flown() {
        (void)bench_.write("x.yaml", short_hovers(6));
        EXPECT_EQ(bench_.run({"campaign", "x.yaml", "--quiet", "--out", "."}).exit_code, 0);
    }
    [[nodiscard]] fs::path file() const { return bench_.folder() / "results.sqlite"; }
    void tamper(const std::string& sql) const { open_database(file(), Access::write).exec(sql); }
    /// One line, exit code 2, and not a byte of the folder has changed.
    void expect_refused(const std::vector<std::string>& arguments, const std::string& text) const {
        const auto files = bench_.files();
        const std::string before = text_of(file());
        const Finished finished = bench_.run(arguments);
        EXPECT_EQ(finished.exit_code, 2) << finished.err;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(text));
        EXPECT_EQ(finished.out, "");
        EXPECT_EQ(bench_.files(), files);
        EXPECT_TRUE(text_of(file()) == before) << "the file has changed";
    }
    void expect_no_reader(const std::string& text) const {
        expect_refused({"summary", "results.sqlite"}, text);
        expect_refused({"replay", "results.sqlite", "0"}, text);
        expect_refused({"campaign", "x.yaml", "--out", ".", "--resume"}, text);
    }

    Bench bench_;
};

TEST_F(Flown, ReplaysARowToItsHash) {
    const std::string hash = Results(file(), Access::read).row(3).state_hash;
    fs::remove(bench_.folder() / "x.yaml");  // the database stands for itself
    const Finished replay = bench_.run({"replay", ".", "3", "--out", "again"});
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_THAT(replay.out, HasSubstr(hash));
    EXPECT_THAT(bench_.files(), testing::IsSupersetOf({"again/flight.mcap", "again/overview.png"}));
    expect_refused({"replay", "results.sqlite", "6"}, "no run 6");
    expect_refused({"replay", "results.sqlite", "-1"}, "must be 0 to 999999999, not '-1'");
}

TEST_F(Flown, AnotherHashIsAFaultOfOurs) {
    tamper("UPDATE runs SET state_hash = '00000000000000ff' WHERE run = 2");
    const Finished replay = bench_.run({"replay", "results.sqlite", "2"});
    EXPECT_EQ(replay.exit_code, 70);
    EXPECT_TRUE(replay.one_line_of_error()) << replay.err;
    EXPECT_THAT(replay.err, HasSubstr("00000000000000ff"));
}

TEST_F(Flown, AnotherRowToTheSameHashIsAFaultOfOurs) {
    tamper(
        "UPDATE runs SET outcome = 'crashed' WHERE run = 2; UPDATE runs SET simulated_s = "
        "simulated_s + 1e-9 WHERE run = 3");
    const std::pair<std::string, std::string> changed[] = {
        {"2", "with outcome = released, its row says crashed"}, {"3", "with simulated_s = "}};
    for (const auto& [run, message] : changed) {
        const Finished replay = bench_.run({"replay", "results.sqlite", run});
        EXPECT_EQ(replay.exit_code, 70);
        EXPECT_TRUE(replay.one_line_of_error()) << replay.err;
        EXPECT_THAT(replay.err, HasSubstr("run " + run + " flew to the row's hash " + message));
    }
}

TEST_F(Flown, SummaryForPeopleAndForPrograms) {
    const Finished text = bench_.run({"summary", ".", "--out", "figures"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("6 of 6 runs of hover"));
    EXPECT_THAT(bench_.files(),
                testing::IsSupersetOf({"figures/summary.png", "figures/summary.svg"}));
    const std::string svg = text_of(bench_.folder() / "figures/summary.svg");
    EXPECT_THAT(svg, HasSubstr("start offset  [m], simulation"));
    EXPECT_THAT(svg, testing::Not(HasSubstr("simulation.start_offset_m")));
    const auto json = nlohmann::json::parse(bench_.run({"summary", ".", "--json"}).out);
    EXPECT_EQ(json["success"]["successes"], 6);
    EXPECT_EQ(json["keys"][1]["groups"][0]["value"], "iris");
    EXPECT_EQ(json["outcomes"][0]["outcome"], "released");
}

TEST(Summary, OfACampaignWithoutADescriptionIsHeadedByItsName) {
    const Bench bench;
    (void)bench.write("x.yaml",
                      "scenario: hover\noverrides: [simulation.hover_s=0.1]\nruns: 2\n"
                      "parameters: {sensors.lidar_noise_m: {uniform: [0.002, 0.02]}}\n");
    const Finished flown = bench.run({"campaign", "x.yaml"});
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    EXPECT_TRUE(flown.out.starts_with("x\n2 runs of hover")) << flown.out;
    EXPECT_THAT(flown.out, HasSubstr("x\n2 of 2 runs of hover"));
}

TEST(CellsPage, SaysHowEachCellOfTwoGridsEndedAndWhichRunItWas) {
    const Bench bench;
    (void)bench.write("cells.yaml",
                      "scenario: hover\nseed: 1\nrepeats: 1\n"
                      "overrides: [simulation.hover_s=3, \"faults={fault: none, at_s: 1}\"]\n"
                      "parameters:\n"
                      "  simulation.start_height_m: {grid: [1, 2]}\n"
                      "  faults.fault: {grid: [none, motor_lost]}\n");
    ASSERT_EQ(bench.run({"campaign", "cells.yaml", "--out", "flown"}).exit_code, 0);
    ASSERT_EQ(bench.run({"summary", "flown"}).exit_code, 0);
    const std::string page = text_of(bench.folder() / "flown/cells.html");
    EXPECT_THAT(page, HasSubstr("<button class=\"released\" data-run=\"0\""));
    EXPECT_THAT(page, HasSubstr("<button class=\"crashed\" data-run=\"1\" "
                                "title=\"run 1, crashed: hit the ground; in truth fallen\""));
    EXPECT_THAT(page, HasSubstr("<button class=\"crashed\" data-run=\"3\""));
    EXPECT_THAT(page, HasSubstr("released: 2"));
}

TEST_F(Flown, ResultsAreNeverOverwritten) {
    expect_refused({"campaign", "x.yaml", "--out", "."}, "--resume");
    (void)bench_.write("x.yaml", short_hovers(7));
    expect_refused({"campaign", "x.yaml", "--out", ".", "--resume"}, "file has changed");
}

TEST_F(Flown, AnotherSchemaIsRefused) {
    tamper("PRAGMA user_version = 7");
    expect_no_reader("schema 7");
}

TEST_F(Flown, ADatabaseThatSomebodyElseChangedIsRefused) {
    const std::string whole = text_of(file());
    const std::pair<std::string, std::string> changes[] = {
        {"DELETE FROM scenarios", "are not those that it was begun with"},
        {"UPDATE campaign SET yaml = yaml || ' '", "are not those that it was begun with"},
        {"DROP TABLE campaign", "there is no table campaign"},
        {"DELETE FROM campaign", "table campaign does not have one row"},
        {"UPDATE runs SET \"sensors.lidar_noise_m\" = NULL WHERE run = 0", "no run was given"},
        {"UPDATE runs SET \"sensors.lidar_noise_m\" = 9e999 WHERE run = 0", "no run was given"},
        {"UPDATE runs SET vehicle = 'a balloon' WHERE run = 0", "no run was given"},
        {"UPDATE runs SET vehicle = NULL WHERE run = 0", "no run was given"},
    };
    for (const auto& [sql, message] : changes) {
        (void)bench_.write("results.sqlite", whole);
        tamper(sql);
        expect_no_reader(message);
    }
}

TEST_F(Flown, ATruncatedDatabaseIsRefused) {
    const auto size = fs::file_size(file());
    for (const auto left : {size / 2, size - 1, std::uintmax_t{50}, std::uintmax_t{0}}) {
        fs::resize_file(file(), left);
        expect_no_reader("results.sqlite: is ");
    }
}

TEST_F(Flown, WhatIsNoDatabaseOfOursIsRefused) {
    (void)bench_.write("results.sqlite", std::string(5000, 'x'));
    expect_no_reader("not a database of results");
    fs::remove(file());
    { open_database(file(), Access::create).exec("CREATE TABLE runs (run INTEGER)"); }
    expect_no_reader("not a database of results");
    expect_refused({"summary", "nowhere.sqlite"}, "no such file");
}

/// Hovers that are cut off at a time that is drawn; rarely a late one.
constexpr const char* kDrawnHovers =
    "scenario: hover\nruns: 5\nseed: 3\nparameters:\n"
    "  simulation.time_limit_s: {normal: {mean: 0.3, sigma: 0.04, from: 0.1, to: 0.6}}\n";

TEST(RareProgram, SaysHowProbableAndFliesTheLikeliestAgain) {
    const Bench bench;
    (void)bench.write("x.yaml", kDrawnHovers);
    const Finished flown =
        bench.run({"campaign", "x.yaml", "--rare", "simulated_s > 0.4", "--level-runs", "100"});
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    EXPECT_THAT(flown.out, HasSubstr("rare event simulated_s>0.4 of hover, 100 runs a level"));
    EXPECT_THAT(flown.out, HasSubstr("limpet fly out/x_rare/likeliest.yaml"));
    const auto json = nlohmann::json::parse(bench.run({"summary", "out/x_rare", "--json"}).out);
    EXPECT_LT(json["low"], 0.0062);  // Phi(-2.5)
    EXPECT_GT(json["high"], 0.0062);
    EXPECT_EQ(json["ending"], "estimated");
    EXPECT_GT(json["brute_force_runs"], json["flown"]);
    const std::string hash = json["likeliest"]["state_hash"];
    const Finished again = bench.run({"fly", "out/x_rare/likeliest.yaml", "--no-record", "--json"});
    EXPECT_EQ(nlohmann::json::parse(again.out)["state_hash"], hash) << again.err;
    EXPECT_THAT(bench.run({"replay", "out/x_rare", "150"}).out,
                HasSubstr("the same to the last bit"));
    const Finished text = bench.run({"summary", "out/x_rare"});
    EXPECT_THAT(text.out, HasSubstr("most likely simulated_s>0.4: run "));
    EXPECT_THAT(bench.files(), testing::Contains("out/x_rare/rare.svg"));
    const Finished plain = bench.run({"campaign", "x.yaml", "--out", "out/x_rare", "--resume"});
    EXPECT_EQ(plain.exit_code, 2);
    EXPECT_TRUE(plain.one_line_of_error()) << plain.err;
    const Finished none = bench.run({"campaign", "x.yaml", "--rare", "perched", "--rising",
                                     "pressure_min_Pa", "--level-runs", "100", "--out", "none"});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.out, HasSubstr("no estimate"));
}

TEST(RareProgram, KilledOrInterruptedItGoesOn) {
    const Bench bench;
    (void)bench.write("x.yaml", kDrawnHovers);
    const std::vector<std::string> rare = {"campaign",     "x.yaml", "--rare", "simulated_s>0.4",
                                           "--level-runs", "100",    "--jobs", "2"};
    const auto with = [&rare](std::vector<std::string> more) {
        more.insert(more.begin(), rare.begin(), rare.end());
        return more;
    };
    const fs::path file = bench.folder() / "cut/results.sqlite";
    for (const int signal : {SIGKILL, SIGINT}) {
        const std::uint32_t there = finished_in(file);
        Running running(bench.folder(), with({"--out", "cut", "--resume"}));
        EXPECT_TRUE(eventually([&] { return finished_in(file) >= there + 20; }));
        running.signal(signal);
        EXPECT_EQ(running.wait(), signal == SIGKILL ? -SIGKILL : 130);
    }
    EXPECT_THAT(text_of(bench.folder() / "log"),
                HasSubstr("limpet campaign x.yaml --rare 'simulated_s>0.4' --level-runs 100 --out "
                          "cut --resume"));
    EXPECT_EQ(bench.run(with({"--out", "cut", "--resume", "-q"})).exit_code, 0);
    EXPECT_EQ(bench.run(with({"--out", "whole", "-q"})).exit_code, 0);
    EXPECT_EQ(table_of(file), table_of(bench.folder() / "whole/results.sqlite"));
}

TEST(RareProgram, RefusesInOneLineAndLeavesNothing) {
    const Bench bench;
    (void)bench.write("x.yaml", kDrawnHovers);
    (void)bench.write("grid.yaml", short_hovers(4));
    const std::pair<std::vector<std::string>, std::string> bad[] = {
        {{"x.yaml", "--rare", "crash"}, "did you mean crashed?"},
        {{"x.yaml", "--rare", "crashed"}, "--falling or --rising"},
        {{"x.yaml", "--rare", "simulated_s>late"}, "is not a number"},
        {{"x.yaml", "--rare", "simulated_s>1", "--falling", "attempts"}, "are for outcomes"},
        {{"x.yaml", "--rare", "crashed", "--falling", "attempts", "--rising", "attempts"},
         "--falling"},
        {{"x.yaml", "--level-runs", "200"}, "--rare"},
        {{"x.yaml", "--rare", "attempts>1", "--level-runs", "5"}, "--level-runs"},
        {{"grid.yaml", "--rare", "attempts>1"}, "a grid has no probabilities"},
    };
    const auto files = bench.files();
    for (const auto& [words, message] : bad) {
        std::vector<std::string> arguments = {"campaign"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const Finished finished = bench.run(arguments);
        EXPECT_EQ(finished.exit_code, 2) << message;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(message));
        EXPECT_EQ(bench.files(), files);
    }
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) {
        all += text;
    }
    return all;
}

TEST(CampaignProgram, RefusesWhatItCannotFly) {
    const Bench bench;
    const std::string head = "scenario: hover\nruns: 2\nparameters:\n";
    const std::pair<std::string, std::string> bad[] = {
        {head + "  simulation.hovers_s: {uniform: [1, 2]}\n",
         "x.yaml:4: parameters.simulation.hovers_s: unknown key"},
        {head + "  simulation.hover_s: {uniform: [1, 4000]}\n",
         "x.yaml:4: parameters.simulation.hover_s: 4000 is out of range"},
        {head + "  simulation.hover_s: {normal: {mean: 1, sigma: 30}}\n", "is out of range"},
        {head + "  simulation.hover_s: {uniform: [-5, 10000]}\n",  // not what is between them
         "x.yaml:4: parameters.simulation.hover_s: -5 is out of range"},
        {head + "  wall.surface: {uniform: [0, 1]}\n",
         "x.yaml:4: parameters.wall.surface: \"0\": no such surface; there are porous_concrete"},
        {head + "  vehicle: {grid: [1, 2]}\n",
         "x.yaml:4: parameters.vehicle: \"1\": no such vehicle; there are iris"},
        {"scenario: hover\nruns: 2\noverrides: [simulation.hover_s=2]\nparameters:\n"
         "  simulation.hover_s: {uniform: [1, 2]}\n",
         "x.yaml:3: overrides: simulation.hover_s=2 sets what varies, parameters.simulation"},
        {head + "  simulation.hover_s: {normal: {mean: 1, sigma: -1}}\n", "sigma"},
        {head + "  simulation.hover_s: {normal: {mean: 1, sigma: 1, from: 90}}\n", "hardly ever"},
        {head + "  simulation.hover_s: {uniform: [2, 1]}\n", "x.yaml:4"},
        {head + "  simulation.hover_s: {grid: []}\n", "list of values"},
        {head + "  simulation.hover_s: {grid: [1, 1.0]}\n", "twice"},
        {head + "  simulation.hover_s: {grid: [1], choice: [2]}\n", "exactly one of"},
        {head + "  simulation.hover_s: {range: {from: 1, to: 2, count: 0}}\n", "1..1000000"},
        {head + "  simulation.hover_s: {gauss: [1, 2]}\n", "unknown key"},
        {head + "  vehicle: {grid: [perching_uav, perching_uva]}\n", "perching_uva"},
        {head + "  seed: {grid: [1, 2]}\n", "cannot vary"},
        {"scenario: hover\nruns: 1\noverrides: [" + repeated("a=1, ", 1001) + "a=1]\n",
         "a list of at most 1000"},
        {"scenario: hover\nruns: 1\noverrides: [" + repeated("a.", 200) + "a=1]\n",
         "a key of 401 characters, allowed 1..200"},
        {"scenario: hover\nruns: 0\n", "x.yaml:2: runs: 0 is out of range"},
        {"scenario: hover\nrepeats: 0\nparameters:\n  simulation.hover_s: {grid: [1, 2]}\n",
         "repeats: 0"},
        {"scenario: hover\nruns: 2\noverrides: [seed=4]\n",
         "x.yaml:3: overrides: seed=4 is the campaign's own, seed: 4"},
        {"scenario: hover\nruns: -3\n", "runs: must be a whole number 1..1000000000, is"},
        {"scenario: hover\n", "runs: is missing"},
        {"scenario: hover\nruns: 1\nrepeats: 1\n", "one of them"},
        {"runs: 3\n", "scenario: is missing"},
        {"scenario: hovre\nruns: 1\n", "x.yaml:1: scenario: \"hovre\""},
        {"scenario: hover\nruns: 1\nname: ../x\n", "name"},
        {"scenario: hover\nruns: 1\nsuccess: [landed]\n", "landed"},
        {"scenario: hover\nruns: 1\noverrides: [simulation.hover_s=-1]\n",
         "x.yaml:3: overrides: simulation.hover_s=-1"},
        {"scenario: hover\nruns: 1\noverides: []\n", "did you mean overrides"},
        {"", "empty"},
    };
    for (const auto& [text, message] : bad) {
        (void)bench.write("x.yaml", text);
        const Finished finished = bench.run({"campaign", "x.yaml"});
        EXPECT_EQ(finished.exit_code, 2) << text;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(message));
        EXPECT_EQ(bench.files(), std::vector<std::string>{"x.yaml"}) << "something was written";
    }
}

TEST(CampaignProgram, RefusesJobsThatAreNone) {
    const Bench bench;
    for (const char* jobs : {"0", "-1", "two", "100000"}) {
        const Finished finished = bench.run({"campaign", "smoke", "--jobs", jobs});
        EXPECT_EQ(finished.exit_code, 2);
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr("--jobs"));
    }
    EXPECT_TRUE(bench.files().empty());
}

/// An unset variable of a job array's script is not no shard.
TEST(CampaignProgram, RefusesOptionsThatSayNothing) {
    const Bench bench;
    (void)bench.write("x.yaml", short_hovers(6));
    for (const char* option : {"--shard", "--out", "--rare"}) {
        const Finished finished = bench.run({"campaign", "x.yaml", option, ""});
        EXPECT_EQ(finished.exit_code, 2) << option;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(std::string(option) + ": must not be empty"));
    }
    EXPECT_EQ(bench.files(), std::vector<std::string>{"x.yaml"});
}

/// What it says to type goes into a shell as it stands.
TEST(CampaignProgram, NamesWithBlanksStayOneWord) {
    const Bench bench;
    (void)bench.write("my hovers.yaml", short_hovers(2));
    const Finished flown = bench.run({"campaign", "my hovers.yaml", "--out", "file:a b"});
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    EXPECT_THAT(flown.out, HasSubstr("limpet summary 'file:a b/results.sqlite' "));
    EXPECT_EQ(bench.run({"summary", "file:a b"}).exit_code, 0);
    EXPECT_EQ(bench.run({"merge", "file:a b", "--out", "file:c"}).exit_code, 0);
}

TEST(StudyProgram, ASayingOfTheCommandLineIsAnsweredInItsTerms) {
    const Bench bench;
    const auto study = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"study", "./p q.yaml", "--of", "crashed", "--samples", "16",
                                   "--out", "study"});
        return bench.run(more);
    };
    (void)bench.write("p q.yaml",
                      text_of(LIMPET_SOURCE_DIR "/data/scenarios/pendulum_concrete.yaml"));
    const std::string speed = "pendulum.impact_speed_m_s=0.9..1.2";
    const std::pair<std::vector<std::string>, std::string> bad[] = {
        {{"--vary", speed, "--vary", speed},
         "--vary: parameters.pendulum.impact_speed_m_s: is given twice, first at --vary"},
        {{"--vary", "pendulum.impact_speed_m_s={grid: [0.9, 1]}"},
         "--vary: parameters.pendulum.impact_speed_m_s: a grid has no probabilities"},
        {{"--vary", speed, "--set", "pendulum.impact_speed_m_s=1"},
         "--vary: overrides: pendulum.impact_speed_m_s=1 sets what varies"},
    };
    for (const auto& [arguments, message] : bad) {
        const Finished finished = study(arguments);
        EXPECT_EQ(finished.exit_code, 2);
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr("limpet: " + message));
        EXPECT_EQ(bench.files(), std::vector<std::string>{"p q.yaml"});
    }
    const Finished flown = study({"--vary", speed, "--set", "description=a \"quoted\" \\ thing"});
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    EXPECT_THAT(flown.out, HasSubstr("p q: 64 flights, 16 samples by 1 input and noise"));
    EXPECT_THAT(flown.out, HasSubstr("--rare 'crashed' --falling METRIC"));
}

/// Rows may have been written by anybody.
TEST(CampaignProgram, ARowThatIsNotUtf8IsSummarised) {
    const Bench bench;
    (void)bench.write("x.yaml", short_hovers(2));
    ASSERT_EQ(bench.run({"campaign", "x.yaml", "--out", "o", "--quiet"}).exit_code, 0);
    {
        Results results(bench.folder() / "o/results.sqlite", Access::write);
        results.database().exec(
            "UPDATE runs SET outcome = CAST(x'66ff' AS TEXT), reason = CAST(x'fe' AS TEXT)");
    }
    const Finished told = bench.run({"summary", "o", "--json"});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_TRUE(nlohmann::json::accept(told.out));
    EXPECT_THAT(told.out, HasSubstr("f\xEF\xBF\xBD"));
}

TEST(CampaignProgram, ShippedCampaignsLoad) {
    for (const auto& file :
         fs::directory_iterator(fs::path(LIMPET_SOURCE_DIR "/data") / "campaigns")) {
        if (file.path().extension() == ".yaml") {
            EXPECT_NO_THROW((void)load_campaign(file.path().string(), LIMPET_SOURCE_DIR "/data"))
                << file.path();
        }
    }
}

}  // namespace
}  // namespace limpet::campaign
