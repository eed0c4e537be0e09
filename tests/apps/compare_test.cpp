// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Flies into NAME/flight.mcap.
void fly(const Bench& bench, const std::string& scenario, const std::string& name,
         std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"fly", scenario, "--json", "--out", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished flown = bench.run(arguments);
    ASSERT_EQ(flown.exit_code, 0) << flown.err;
}

void expect_refused(const Bench& bench, const std::vector<std::string>& arguments,
                    const std::string& text) {
    const auto before = bench.files();
    const Finished finished = bench.run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << finished.err;
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr(text));
    EXPECT_EQ(bench.files(), before);
}

TEST(CompareVerb, TheSameFlightTwiceIsWithinALimitOfZero) {
    const Bench bench;
    fly(bench, "perch_concrete", "a");
    fly(bench, "perch_concrete", "b");
    const Finished same =
        bench.run({"compare", "a/flight.mcap", "b/flight.mcap", "--limit", "event=0", "--limit",
                   "pitch_deg=0", "--limit", "outcome=0", "--limit", "impact_force_N=0"});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_EQ(same.err, "");
    EXPECT_THAT(same.out, HasSubstr("rest_hanging_load_N"));
}

TEST(CompareVerb, AnotherSeedIsBeyondATightLimitAndTheWorstIsNamed) {
    const Bench bench;
    fly(bench, "perch_concrete", "a");
    fly(bench, "perch_concrete", "b", {"--seed", "2"});
    const Finished tight =
        bench.run({"compare", "a/flight.mcap", "b/flight.mcap", "--limit", "slider_force_N=0.01"});
    EXPECT_EQ(tight.exit_code, 1);
    EXPECT_THAT(tight.err, HasSubstr("slider_force_N"));
    EXPECT_THAT(tight.err, HasSubstr("EXCEEDED"));
    const Finished wide =
        bench.run({"compare", "a/flight.mcap", "b/flight.mcap", "--limit", "slider_force_N=1000"});
    EXPECT_EQ(wide.exit_code, 0) << wide.err;
}

TEST(CompareVerb, TheVehicleHangsWithItsWeightAndTheJsonSaysSo) {
    const Bench bench;
    fly(bench, "perch_concrete", "fine", {"--set", "simulation.step_s=2.5e-4"});
    fly(bench, "perch_concrete", "coarse", {"--set", "simulation.longest_step_s=0.001"});
    const Finished compared = bench.run({"compare", "fine/flight.mcap", "coarse/flight.mcap",
                                         "--json", "--limit", "rest_hanging_load_off_weight=1e-4"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    const auto printed = nlohmann::json::parse(compared.out);
    EXPECT_EQ(printed["reference"]["label"], "fine");
    const auto& other = printed["others"][0];
    EXPECT_EQ(other["flight"]["outcome"], "released");
    EXPECT_EQ(other["contacts"].size(), 2u);
    for (const auto& contact : other["contacts"]) {
        EXPECT_LT(contact["largest_hPa"].get<double>(), 1.0);
    }
    EXPECT_EQ(printed["limits"][0]["exceeded"], false);
}

TEST(CompareVerb, LeavesFiguresAndJsonInTheFolder) {
    const Bench bench;
    fly(bench, "perch_concrete", "a");
    fly(bench, "perch_concrete", "b", {"--seed", "2"});
    const Finished drawn = bench.run({"compare", "a/flight.mcap", "b/flight.mcap", "--out", "c",
                                      "--label", "one", "--label", "two"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(drawn.out, HasSubstr("c/index.html"));
    EXPECT_THAT(text_of(bench.folder() / "c/index.html"), HasSubstr("one against two"));
    EXPECT_GT(fs::file_size(bench.folder() / "c/figures/compare_attitude.png"), 20000u);
    EXPECT_EQ(
        nlohmann::json::parse(text_of(bench.folder() / "c/compare.json"))["reference"]["label"],
        "one");
    const Finished table = bench.run({"compare", "a/flight.mcap", "b/flight.mcap", "--markdown"});
    EXPECT_THAT(table.out, HasSubstr("| outcome | released | released |"));
}

TEST(CompareVerb, DamagedMissingAndForeignFilesAreRefusedInOneLine) {
    const Bench bench;
    fly(bench, "perch_concrete", "a");
    expect_refused(bench, {"compare", "a/flight.mcap", "nowhere.mcap"}, "nowhere.mcap");
    (void)bench.write("text.mcap", "no recording");
    expect_refused(bench, {"compare", "text.mcap", "a/flight.mcap"}, "text.mcap");
    fs::copy_file(bench.folder() / "a/flight.mcap", bench.folder() / "cut.mcap");
    fs::resize_file(bench.folder() / "cut.mcap", fs::file_size(bench.folder() / "cut.mcap") / 2);
    expect_refused(bench, {"compare", "a/flight.mcap", "cut.mcap"}, "cut.mcap");
}

TEST(CompareVerb, WhatCannotBeComparedIsRefusedInOneLine) {
    const Bench bench;
    fly(bench, "perch_concrete", "a");
    fly(bench, "hover", "b");
    const std::vector<std::string> both = {"compare", "a/flight.mcap", "b/flight.mcap"};
    const auto with = [&both](std::vector<std::string> more) {
        more.insert(more.begin(), both.begin(), both.end());
        return more;
    };
    expect_refused(bench, both, "no common event");
    expect_refused(bench, with({"--align", "landed"}), "landed");
    expect_refused(bench, with({"--align", "start", "--label", "one"}), "--label");
    expect_refused(bench, with({"--align", "start", "--limit", "speed"}), "NAME=VALUE");
    expect_refused(bench, with({"--align", "start", "--limit", "speed=1"}), "pitch_deg");
    expect_refused(bench, with({"--align", "start", "--json", "--markdown"}), "--json");
    EXPECT_EQ(bench.run(with({"--align", "start"})).exit_code, 0);
}

}  // namespace
}  // namespace limpet
