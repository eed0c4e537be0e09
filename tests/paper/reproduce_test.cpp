// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../apps/program.hpp"

namespace limpet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

int shell(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// One whole quick reproduction, shared by the tests of it.
class Reproduce : public testing::Test {
protected:
    static void SetUpTestSuite() {
        bench_ = new Bench;
        finished_ = new Finished(bench_->run({"reproduce", "--quick", "--out", "page"}));
    }
    static void TearDownTestSuite() {
        delete finished_;
        delete bench_;
    }
    static fs::path page() { return bench_->folder() / "page"; }
    static Json results() { return Json::parse(text_of(page() / "results.json")); }

    static Bench* bench_;
    static Finished* finished_;
};
Bench* Reproduce::bench_ = nullptr;
Finished* Reproduce::finished_ = nullptr;

TEST_F(Reproduce, EveryClaimIsThereAndNoneIsBlank) {
    ASSERT_EQ(finished_->exit_code, 0) << finished_->err;
    const Json json = results();
    EXPECT_GT(json["claims"].size(), 90U);
    int reproduced = 0;
    for (const Json& claim : json["claims"]) {
        for (const char* key : {"id", "section", "statement", "paper", "simulated", "difference",
                                "verdict"}) {
            ASSERT_TRUE(claim.contains(key)) << claim;
            EXPECT_FALSE(claim[key].is_null() || claim[key] == "") << claim;
        }
        EXPECT_NE(claim["simulated"], "did not come to pass") << claim;
        reproduced += claim["verdict"] == "reproduced" ? 1 : 0;
        if (!claim["recording"].is_null()) {
            EXPECT_TRUE(fs::exists(page() / claim["recording"])) << claim;
        }
    }
    EXPECT_GT(reproduced, 80);
}

/// What is known to differ; one more is news, one less too.
TEST_F(Reproduce, DiffersWhereThePaperDoes) {
    std::vector<std::string> differs;
    for (const Json& claim : results()["claims"]) {
        if (claim["verdict"] == "differs") {
            differs.push_back(claim["id"]);
        }
    }
    EXPECT_EQ(differs, (std::vector<std::string>{"metal-ripple", "aerodynamics"}));
}

TEST_F(Reproduce, ResultsFollowTheirSchema) {
    const std::string source = LIMPET_SOURCE_DIR;
    EXPECT_EQ(shell(source + "/tests/support/validate " + source +
                    "/docs/schema/results.schema.json " + (page() / "results.json").string()),
              0);
}

TEST_F(Reproduce, ABrowserFindsNothingWrong) {
    const std::string browser = std::string(LIMPET_SOURCE_DIR) + "/tests/support/browser ";
    const int code = shell(browser + (page() / "index.html").string());
    if (code == 3) {
        GTEST_SKIP() << "no Chromium here";
    }
    EXPECT_EQ(code, 0);
}

TEST_F(Reproduce, FiguresComeAsPngAndSvg) {
    const Json figures = results()["figures"];
    EXPECT_GT(figures.size(), 15U);
    for (const Json& figure : figures) {
        EXPECT_TRUE(fs::exists(page() / figure["png"])) << figure;
        const std::string id = figure["id"];
        if (id != "fig9" && id != "fig10") {  // photographs
            EXPECT_TRUE(fs::exists(page() / figure["svg"])) << figure;
        }
    }
}

TEST(ReproduceOnly, APartAloneJudgesWhatItBearsOn) {
    const Bench bench;
    const Finished done = bench.run({"reproduce", "--only", "rotors", "--out", "page"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Json json = Json::parse(text_of(bench.folder() / "page" / "results.json"));
    EXPECT_EQ(json["claims"].size(), 6U);
}

TEST(ReproduceBadInput, IsOneLineAndTouchesNothing) {
    const Bench bench;
    (void)bench.write("file", "");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"reproduce", "--only", "tables"},
          {"reproduce", "--jobs", "0"},
          {"reproduce", "--out", "file"},
          {"reproduce", "--quickly"}}) {
        const Finished done = bench.run(arguments);
        EXPECT_EQ(done.exit_code, 2) << done.err;
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
        EXPECT_EQ(bench.files(), std::vector<std::string>{"file"});
    }
}

}  // namespace
}  // namespace limpet
