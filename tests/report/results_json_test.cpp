// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "../support/flights.hpp"
#include "limpet/report/page.hpp"
#include "program_output.hpp"
#include "sample_page.hpp"

namespace limpet::report {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

/// What the schema has against it; empty when it has nothing.
std::string faults(const Json& json) {
    const test::Folder folder;
    std::ofstream(folder.path() / "results.json") << json.dump();
    const std::string root = LIMPET_SOURCE_DIR;
    const test::Output output = test::output_of(
        root + "/tests/support/validate " + root + "/docs/schema/results.schema.json " +
        (folder.path() / "results.json").string() + " 2>&1");
    EXPECT_EQ(output.exit_code, output.text.empty() ? 0 : 1) << output.text;
    return output.text;
}

Json sample() {
    return Json::parse(results_json(test::sample_page()));
}

TEST(ResultsJson, is_what_its_schema_says) {
    EXPECT_THAT(faults(sample()), IsEmpty());
}

TEST(ResultsJson, keeps_numbers_as_numbers) {
    const Json json = sample();
    EXPECT_EQ(json["claims"].size(), 24u);
    const Json& claim = json["claims"][0];
    EXPECT_EQ(claim["paper"], Json({{"low", 0.8}, {"high", 1.4}}));
    EXPECT_EQ(claim["simulated"], 1.26);
    EXPECT_EQ(claim["difference"], "within");
    EXPECT_EQ(claim["verdict"], "reproduced");
    EXPECT_EQ(claim["figure"], "fig-success");
    EXPECT_EQ(claim["recording"], "flights/a b#1.mcap");
    EXPECT_EQ(json["claims"][1]["figure"], nullptr);
    EXPECT_EQ(json["claims"][4]["unit"], nullptr);
    EXPECT_EQ(json["tables"][0]["rows"][0][1], 0.21);
    EXPECT_EQ(json["figures"].size(), 13u);
    EXPECT_EQ(json["environment"]["mode"], "quick");
    EXPECT_EQ(json["environment"]["seed"], 7);
}

TEST(ResultsJson, says_in_words_what_is_no_number) {
    Page page = test::sample_page();
    page.claims[0].simulated = std::numeric_limits<double>::quiet_NaN();
    page.claims[1].paper = draw::Range{0.0, std::numeric_limits<double>::infinity()};
    const Json json = Json::parse(results_json(page));
    EXPECT_EQ(json["claims"][0]["simulated"], "not a number");
    EXPECT_EQ(json["claims"][1]["paper"], "0 … not a number");
    EXPECT_THAT(faults(json), IsEmpty());
}

TEST(ResultsJson, survives_bytes_that_are_no_text) {
    Page page = test::sample_page();
    page.claims[0].note = "half a letter: \xC3";
    EXPECT_THAT(faults(Json::parse(results_json(page))), IsEmpty());
}

struct Spoilt {
    const char* how;
    void (*change)(Json&);
    const char* fault;  ///< what the validator says
};

class ResultsSchema : public testing::TestWithParam<Spoilt> {};

TEST_P(ResultsSchema, refuses) {
    Json json = sample();
    GetParam().change(json);
    EXPECT_THAT(faults(json), HasSubstr(GetParam().fault));
}

INSTANTIATE_TEST_SUITE_P(
    all, ResultsSchema,
    testing::Values(
        Spoilt{"a_missing_part", [](Json& j) { j.erase("tables"); }, "'tables' is a required"},
        Spoilt{"an_unknown_part", [](Json& j) { j["more"] = 1; }, "'more' was unexpected"},
        Spoilt{"a_claim_without_a_verdict", [](Json& j) { j["claims"][0].erase("verdict"); },
               "'verdict' is a required"},
        Spoilt{"a_verdict_of_another_kind", [](Json& j) { j["claims"][0]["verdict"] = "good"; },
               "claims/0/verdict"},
        Spoilt{"a_blank_value", [](Json& j) { j["claims"][3]["simulated"] = ""; },
               "claims/3/simulated"},
        Spoilt{"a_value_of_spaces", [](Json& j) { j["claims"][3]["paper"] = "  "; },
               "claims/3/paper"},
        Spoilt{"no_value", [](Json& j) { j["claims"][3]["paper"] = nullptr; }, "claims/3/paper"},
        Spoilt{"half_a_range",
               [](Json& j) {
                   j["claims"][3]["paper"] = {{"low", 1}};
               },
               "claims/3/paper"},
        Spoilt{"an_unknown_key_of_a_claim", [](Json& j) { j["claims"][0]["colour"] = "red"; },
               "'colour' was unexpected"},
        Spoilt{"a_path_from_the_root", [](Json& j) { j["claims"][0]["recording"] = "/etc/x"; },
               "claims/0/recording"},
        Spoilt{"an_id_with_a_space", [](Json& j) { j["figures"][0]["id"] = "a b"; },
               "figures/0/id"},
        Spoilt{"an_empty_cell", [](Json& j) { j["tables"][0]["rows"][0][1] = ""; },
               "tables/0/rows/0/1"},
        Spoilt{"a_mode_of_another_kind", [](Json& j) { j["environment"]["mode"] = "slow"; },
               "environment/mode"},
        Spoilt{"an_environment_without_a_seed", [](Json& j) { j["environment"].erase("seed"); },
               "'seed' is a required"}),
    [](const auto& spoilt) { return spoilt.param.how; });

}  // namespace
}  // namespace limpet::report
