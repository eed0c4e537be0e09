// SPDX-License-Identifier: Apache-2.0
//
// A vehicle of somebody's own that is peeled off, asked why by the library and by the program.
#include "limpet/why/why.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/mcap/writer.hpp"
#include "program.hpp"

namespace limpet::why {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kDamping = "vehicle.slider.damping_N_s_m";
constexpr const char* kCentring = "vehicle.cup.centring_stiffness_N_m_rad";
const std::string kSteelFile = std::string(LIMPET_SOURCE_DIR) + "/tests/data/steel12/steel12.yaml";

scenario::ScenarioText text_of_steel() {
    return {to_yaml(scenario::load_scenario(kSteelFile)), "steel12"};
}

const Found& found() {
    static const Found kept = find_why(text_of_steel(), {.jobs = 2});
    return kept;
}

std::vector<std::string> keys_of(const std::vector<Change>& changes) {
    std::vector<std::string> keys;
    for (const Change& change : changes) {
        keys.push_back(change.key);
    }
    return keys;
}

TEST(Why, TwoSettingsTogetherMendIt) {
    EXPECT_EQ(found().base.result.outcome, Outcome::failed_to_seal);
    EXPECT_EQ(found().base.stage, Stage::attached);
    EXPECT_TRUE(found().mended);
    EXPECT_THAT(keys_of(found().remedy.changes),
                testing::UnorderedElementsAre(kDamping, kCentring));
    EXPECT_GE(found().remedy.stage, Stage::rested);
    EXPECT_EQ(found().remedy.result.true_end, TrueEnd::on_wall);
    for (const Change& change : found().remedy.changes) {
        EXPECT_EQ(change.to > change.from, change.key == kDamping) << change.to;
    }
}

TEST(Why, NeitherOfThemDoesAlone) {
    ASSERT_EQ(found().keys.size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
        const HelpfulKey& key = found().keys[i];
        EXPECT_TRUE(key.in_remedy);
        EXPECT_TRUE(key.alone.flown);
        EXPECT_LT(key.alone.stage, Stage::rested) << key.change.key;
    }
}

/// What is told was flown so: the same flight by --set.
TEST(Why, TheRemedyFliesAsItIsTold) {
    const Trial& remedy = found().remedy;
    std::vector<std::string> overrides;
    for (const Change& change : remedy.changes) {
        overrides.push_back(change.override_text());
    }
    const auto model =
        simulation::build_model(scenario::load_scenario(kSteelFile, {.overrides = overrides}));
    EXPECT_EQ(simulation::fly(model).state_hash, remedy.result.state_hash);
}

TEST(Why, TellsTheSameOnAnyNumberOfThreads) {
    const Found one = find_why(text_of_steel(), {.jobs = 1});
    auto apart = nlohmann::json::parse(why_json(one));
    auto together = nlohmann::json::parse(why_json(found()));
    apart.erase("wall_s");
    together.erase("wall_s");
    EXPECT_EQ(apart, together);
}

TEST(Why, ASuccessNeedsNothing) {
    const scenario::ScenarioText text(to_yaml(scenario::load_scenario("perch_concrete")),
                                      "perch_concrete");
    const Found good = find_why(text, {});
    EXPECT_EQ(good.base.stage, Stage::done);
    EXPECT_EQ(good.flights, 1U);
    EXPECT_THAT(why_text(good, "perch_concrete"), HasSubstr("a success: least margin 13"));
}

/// On metal the release takes too long, unless a valve lets air in.
TEST(Why, ARestThatDoesNotEndIsMendedByAValve) {
    const scenario::ScenarioText text(to_yaml(scenario::load_scenario("perch_metal")),
                                      "perch_metal");
    const Found metal = find_why(text, {.jobs = 2});
    EXPECT_EQ(metal.base.stage, Stage::rested);
    EXPECT_TRUE(metal.mended);
    std::vector<std::string> all = keys_of(metal.remedy.changes);
    for (const Trial& other : metal.others) {
        for (const std::string& key : keys_of(other.changes)) {
            all.push_back(key);
        }
    }
    EXPECT_THAT(all, Contains("suction.valve_fitted"));
    EXPECT_EQ(metal.remedy.stage, Stage::done);
}

TEST(Why, SettingsAreTurnedWithinTheirRanges) {
    const scenario::Scenario steel = scenario::load_scenario(kSteelFile);
    const std::vector<Change> settings = settings_turned(steel);
    EXPECT_THAT(keys_of(settings), Contains(kDamping));
    EXPECT_THAT(keys_of(settings), Contains(kCentring));
    EXPECT_THAT(keys_of(settings), Contains("suction.valve_fitted"));
    EXPECT_THAT(keys_of(settings),
                Not(Contains("guidance.hover_thrust")));  // follows from the mass
    EXPECT_THAT(keys_of(settings), Not(Contains("guidance.attempts")));
    EXPECT_THAT(keys_of(settings), Not(Contains("vehicle.mass_kg")));
    EXPECT_THAT(keys_of(parts_turned(steel)), Contains("vehicle.mass_kg"));
    for (const Change& change : settings) {
        EXPECT_NE(change.from, change.to) << change.key;
    }
}

TEST(WhyVerb, TellsAndDraws) {
    const Bench bench;
    const Finished why = bench.run({"why", kSteelFile, "--out", "o"});
    ASSERT_EQ(why.exit_code, 0) << why.err;
    EXPECT_THAT(why.out, HasSubstr("peeled off while holding"));
    EXPECT_THAT(why.out, HasSubstr("centring spring"));
    EXPECT_THAT(why.out, HasSubstr(kDamping));
    EXPECT_THAT(why.out, HasSubstr(kCentring));
    EXPECT_THAT(why.out, HasSubstr("\ntogether "));
    EXPECT_THAT(why.out, Not(HasSubstr("no seal")));
    EXPECT_THAT(why.out, HasSubstr("  limpet fly " + kSteelFile + " --set "));
    EXPECT_THAT(bench.files(), Contains("o/why.png"));
    EXPECT_THAT(bench.files(), Contains("o/why.svg"));
    const auto json = nlohmann::json::parse(text_of(bench.folder() / "o/why.json"));
    EXPECT_EQ(json["mended"], true);
    EXPECT_EQ(json["keys"].size(), 3U);
    EXPECT_EQ(json["flight"]["holds"][0]["let_go"], "peeled off");
}

TEST(WhyVerb, ARecordingIsFlownAgain) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", kSteelFile, "--out", "f", "--no-figures", "--quiet"}).exit_code, 0);
    const Finished why = bench.run({"why", "f/flight.mcap", "--json", "--no-figure"});
    ASSERT_EQ(why.exit_code, 0) << why.err;
    const auto json = nlohmann::json::parse(why.out);
    EXPECT_EQ(json["remedy"]["changes"].size(), 2U);
    EXPECT_THAT(why.err, Not(HasSubstr("another flight")));
    EXPECT_THAT(bench.files(), Contains("out/steel12_why/scenario.yaml"));
}

/// A recording with a scenario in it that is called so.
void write_recording(const std::filesystem::path& file, const std::string& scenario,
                     const std::string& name) {
    mcap::Writer writer(file);
    writer.add_metadata({"limpet", {{"scenario", name}, {"seed", "1"}}});
    writer.add_attachment(
        {.name = "scenario.yaml", .media_type = "application/yaml", .text = scenario});
    writer.close();
}

/// As every verb that reads one: what is whole of it is used, the rest is a line and exit code 2.
TEST(WhyVerb, ADamagedRecordingIsExplainedAndNamed) {
    const Bench bench;
    write_recording(bench.folder() / "x.mcap", "mission: hover\nvehicle: iris\n", "x");
    std::filesystem::resize_file(bench.folder() / "x.mcap",
                                 std::filesystem::file_size(bench.folder() / "x.mcap") - 20);
    const Finished why = bench.run({"why", "x.mcap", "--no-figure"});
    EXPECT_EQ(why.exit_code, 2);
    EXPECT_THAT(why.out, HasSubstr("a success\n"));
    EXPECT_THAT(why.err, HasSubstr("x.mcap: "));
}

/// The folder has the scenario's name, which a stranger may choose.
TEST(WhyVerb, AStrangersRecordingWritesIntoNoFolderOfItsChoice) {
    const Bench bench;
    for (const std::string& name : {std::string("../../../escaped"), std::string("/tmp/escaped"),
                                    std::string(".."), std::string(5000, 'x'), std::string()}) {
        write_recording(bench.folder() / "x.mcap", "mission: hover\nvehicle: iris\n", name);
        const Finished why = bench.run({"why", "x.mcap", "--no-figure"});
        EXPECT_EQ(why.exit_code, 0) << why.err;
        EXPECT_THAT(bench.files(), Contains("out/recording_why/why.json"));
        EXPECT_THAT(why.out, HasSubstr("a success\n"));  // no cup, no margin
        std::filesystem::remove_all(bench.folder() / "out");
    }
    write_recording(bench.folder() / "x.mcap", "mission: hover\nvehicle: iris\n",
                    "\x1b[31mred\n\xC2\x9B");
    const Finished why = bench.run({"why", "x.mcap", "--no-figure"});
    EXPECT_THAT(why.out + why.err, Not(HasSubstr("\x1b")));
    EXPECT_THAT(why.out + why.err, Not(HasSubstr("\xC2\x9B")));
    EXPECT_THAT(bench.files(), Contains("out/ [31mred   _why/why.json"));
}

TEST(WhyVerb, ARecordingsScenarioIsNamedWhereItIsWrong) {
    const Bench bench;
    write_recording(bench.folder() / "x.mcap", "mission: hover\nvehicle: gone\n", "a");
    EXPECT_THAT(bench.run({"why", "x.mcap"}).err, HasSubstr("x.mcap: scenario.yaml:2: vehicle"));
    const auto pipe = (bench.folder() / "pipe.yaml").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    write_recording(bench.folder() / "x.mcap", "mission: hover\nvehicle: " + pipe + "\n", "a");
    const Finished why = bench.run({"why", "x.mcap"});
    EXPECT_EQ(why.exit_code, 2);
    EXPECT_THAT(why.err, HasSubstr("is a pipe or a device, must be a file"));
}

TEST(WhyVerb, WhatIsNoFlightIsRefusedInALine) {
    const Bench bench;
    (void)bench.write("x.mcap", "no recording");
    for (const char* wanted : {"x.mcap", "gone.mcap", "no_such_scenario"}) {
        const Finished why = bench.run({"why", wanted});
        EXPECT_EQ(why.exit_code, 2) << wanted;
        EXPECT_TRUE(why.one_line_of_error()) << why.err;
    }
}

}  // namespace
}  // namespace limpet::why
