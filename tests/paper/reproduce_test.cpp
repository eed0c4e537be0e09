// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../apps/program.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

int shell(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void expect_no_blanks(const Json& claims, const fs::path& page) {
    int reproduced = 0, hanging = 0;
    for (const Json& claim : claims) {
        for (const char* key :
             {"id", "section", "statement", "paper", "simulated", "difference", "verdict"}) {
            ASSERT_TRUE(claim.contains(key)) << claim;
            EXPECT_FALSE(claim[key].is_null() || claim[key] == "") << claim;
        }
        EXPECT_NE(claim["simulated"], "did not come to pass") << claim;
        reproduced += claim["verdict"] == "reproduced" ? 1 : 0;
        hanging += claim["verdict"] == "hangs on assumptions" ? 1 : 0;
        EXPECT_TRUE(claim["recording"].is_null() || fs::exists(page / claim["recording"])) << claim;
    }
    EXPECT_GT(claims.size(), 100U);
    EXPECT_GT(reproduced + hanging, 80);
    EXPECT_GT(reproduced, 60);
}

std::vector<std::string> with_verdict(const Json& claims, const char* verdict) {
    std::vector<std::string> ids;
    for (const Json& claim : claims) {
        if (claim["verdict"] == verdict) {
            ids.push_back(claim["id"]);
        }
    }
    return ids;
}

void expect_figures(const Json& figures, const fs::path& page) {
    EXPECT_GT(figures.size(), 15U);
    for (const Json& figure : figures) {
        EXPECT_TRUE(fs::exists(page / figure["png"])) << figure;
        const std::string id = figure["id"];
        if (id != "fig9" && id != "fig10") {  // photographs
            EXPECT_TRUE(fs::exists(page / figure["svg"])) << figure;
        }
    }
}

/// The whole page, once: it takes three minutes of two cores.
TEST(Reproduce, QuickWritesAWholePage) {
    const Bench bench;
    const Finished done = bench.run({"reproduce", "--quick", "--out", "page"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const fs::path page = bench.folder() / "page";
    const Json json = Json::parse(text_of(page / "results.json"));
    expect_no_blanks(json["claims"], page);
    expect_figures(json["figures"], page);
    // What is known to differ; one more is news, one less too.
    EXPECT_EQ(with_verdict(json["claims"], "differs"),
              (std::vector<std::string>{"spike-later", "metal-ripple", "aerodynamic"}));
    // With a shorter arm a propeller meets the wall, a smaller cup peels off under the vehicle;
    // how far it swings hangs on arm and motors, on concrete on the wall's air as well: 0.46 deg
    // more in the median of 200 missions, 0.5 is accepted.
    EXPECT_THAT(with_verdict(json["claims"], "hangs on assumptions"),
                testing::IsSupersetOf({"legs", "cad", "whole", "stays-level", "real-swings",
                                       "five-degrees", "grow-larger", "tuning"}));

    const std::string source = LIMPET_SOURCE_DIR;
    EXPECT_EQ(shell(source + "/tests/support/validate " + source +
                    "/docs/schema/results.schema.json " + (page / "results.json").string()),
              0);
    const int browser = shell(source + "/tests/support/browser " + (page / "index.html").string());
    constexpr int kNoChromium = 3;
    EXPECT_TRUE(browser == 0 || browser == kNoChromium) << browser;
}

TEST(ReproduceOnly, APartAloneJudgesWhatItBearsOn) {
    const Bench bench;
    const Finished done = bench.run({"reproduce", "--only", "rotors", "--out", "page"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Json json = Json::parse(text_of(bench.folder() / "page" / "results.json"));
    EXPECT_EQ(json["claims"].size(), 6U);
}

double number_in(const Json& row, std::size_t column) {
    return row[column].is_number() ? row[column].get<double>() : -1.0;
}

/// Data of the run, not typed: what Fig. 3's fit leaves open by sampling is far less than by what
/// is assumed.
TEST(ReproduceOnly, TheTrialsSayWhatSamplingAndAssumptionsLeaveOpen) {
    const Bench bench;
    const Finished done = bench.run({"reproduce", "--quick", "--only", "trials", "--out", "page"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("note       Fig. 3 is fitted: half attach at "), std::string::npos)
        << done.out;
    const Json json = Json::parse(text_of(bench.folder() / "page" / "results.json"));
    Json rows;
    for (const Json& table : json["tables"]) {
        if (table["id"] == "fig3-assumptions") {
            rows = table["rows"];
        }
    }
    ASSERT_EQ(rows.size(), 7U);
    EXPECT_EQ(rows[0][0], "as assumed");
    EXPECT_EQ(rows[0].back(), "yes");
    const double half_m_s = number_in(rows[0], 1);
    const double sampling_m_s = rows[0][2]["high"].get<double>() - rows[0][2]["low"].get<double>();
    double least_m_s = half_m_s, most_m_s = half_m_s, never = 0.0;
    for (const Json& row : rows) {
        const double moved_m_s = number_in(row, 1);
        never += moved_m_s < 0.0 ? 1.0 : 0.0;
        least_m_s = moved_m_s < 0.0 ? least_m_s : std::min(least_m_s, moved_m_s);
        most_m_s = std::max(most_m_s, moved_m_s);
        EXPECT_LE(number_in(row, 5), 0.05) << row;  // what the paper pins down
    }
    EXPECT_GT(most_m_s - least_m_s, 1.5 * sampling_m_s);
    EXPECT_GE(never, 1.0);
    // The moved trials can be flown by themselves.
    const Finished again = bench.run({"check", "page/campaigns/fig3_damping_low/campaign.yaml"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
}

/// Held against a flight that is set up by hand; and a second run takes all of it from the folder.
TEST(ReproduceOnly, AVerdictHangsOnFlightsWithTheValueTurned) {
    const Bench bench;
    const std::vector<std::string> run = {"reproduce", "--quick", "--only",
                                          "flights",   "--out",   "page"};
    const Finished done = bench.run(run);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("flights, assumed values turned: 0 of "), std::string::npos);
    const fs::path page = bench.folder() / "page";
    const Json turned = Json::parse(text_of(page / "assumptions" / "flights_turned.json"));
    const std::string key = "vehicle.slider.damping_N_s_m";
    const double as_it_is = scenario::load_scenario("perch_concrete").airframe.slider.damping_N_s_m;
    int compared = 0;
    for (const Json& one : turned["turned"]) {
        if (one["key"] != key) {
            continue;
        }
        const double to = as_it_is * (one["more"].get<bool>() ? 1.2 : 0.8);
        const PaperFlight flight = fly_recorded({.name = "perch_concrete",
                                                 .scenario = "perch_concrete",
                                                 .overrides = {key + "=" + std::to_string(to)}},
                                                bench.folder());
        Evidence evidence;
        measure(flight, evidence);
        for (const char* name : {"perch_concrete.spike_N", "perch_concrete.is_released"}) {
            EXPECT_EQ(one["evidence"][name].get<double>(), evidence.get(name)) << name << to;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 4);
    const Json claims = Json::parse(text_of(page / "results.json"))["claims"];
    for (const Json& claim : claims) {
        EXPECT_EQ(claim["verdict"] == "hangs on assumptions", !claim["hangs_on"].empty()) << claim;
        EXPECT_TRUE(claim["basis"] != "measured" || claim["assumes"].empty() ||
                    claim["turned"].get<int>() > 0)
            << claim;
    }
    const Finished again = bench.run(run);
    EXPECT_EQ(again.out.find("assumed values turned"), std::string::npos) << again.out;
    EXPECT_EQ(Json::parse(text_of(page / "results.json"))["claims"], claims);
}

TEST(ReproduceOnly, FlightsThatWereRecordedElsewhere) {
    const Bench bench;
    const Finished done = bench.run({"reproduce", "--only", "recorded", "--out", "page"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Json json = Json::parse(text_of(bench.folder() / "page" / "results.json"));
    ASSERT_EQ(json["claims"].size(), 3U);
    for (const Json& claim : json["claims"]) {
        EXPECT_EQ(claim["verdict"], "reproduced") << claim;
    }
    const fs::path source = LIMPET_SOURCE_DIR "/data";
    for (const char* name : {"px4", "companion"}) {
        const Json kept =
            Json::parse(text_of(source / "paper/recorded" / (std::string(name) + ".json")));
        EXPECT_EQ(kept["peer"].get<std::string>().substr(0, 5), "PX4 1") << "no stand-in";
        EXPECT_NEAR(kept["metrics"]["perched_pitch_deg"].get<double>(), 66.8, 1.0);
    }
}

/// Data of one's own, but for one file.
TEST(ReproduceBadInput, ARecordedFlightThatIsNoneIsNamed) {
    const Bench bench;
    const fs::path source = LIMPET_SOURCE_DIR "/data", data = bench.folder() / "data";
    fs::create_directories(data / "paper/recorded");
    for (const char* name : {"scenarios", "vehicles", "campaigns", "surfaces.yaml",
                             "paper/page.yaml", "paper/statements.yaml"}) {
        fs::create_symlink(source / name, data / name);
    }
    for (const char* text : {"{", "{}", R"({"outcome": 1})"}) {
        std::ofstream(data / "paper/recorded/px4.json") << text;
        ::setenv("LIMPET_DATA", data.c_str(), 1);
        const Finished done = bench.run({"reproduce", "--only", "recorded", "--out", "page"});
        ::unsetenv("LIMPET_DATA");
        EXPECT_EQ(done.exit_code, 2) << done.err;
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
        EXPECT_NE(done.err.find("paper/recorded/px4.json: "), std::string::npos) << done.err;
    }
}

TEST(ReproduceBadInput, IsOneLineAndTouchesNothing) {
    const Bench bench;
    (void)bench.write("file", "");
    (void)bench.write("index.html", "mine");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"reproduce", "--only", "tables"},
          {"reproduce", "--jobs", "0"},
          {"reproduce", "--out", "file"},
          {"reproduce", "--out", "."},
          {"reproduce", "--quickly"}}) {
        const Finished done = bench.run(arguments);
        EXPECT_EQ(done.exit_code, 2) << done.err;
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
        EXPECT_EQ(bench.files(), (std::vector<std::string>{"file", "index.html"}));
    }
}

}  // namespace
}  // namespace limpet::paper
