// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

const std::string kFile =
    "near:\n  what: thrust\n  source: somebody\n  x: z/R [-]\n  unit: \"-\"\n  law: ground\n"
    "  scatter: 0.002\n  scatter_of: repeats\n  note: too much\n  series:\n"
    "    - {x: [1, 2], y: [1.2, 1.1]}\n"
    "far:\n  what: thrust\n  source: somebody\n  x: z/R [-]\n  unit: \"-\"\n  law: ground\n"
    "  scatter_of: none\n  series:\n    - {x: [1, 2], y: [1.0667, 1.0159]}\n"
    "looked_at:\n  - {what: w, where: h, why: y}\n";

std::string line_of(const std::string& text, const std::string& begin) {
    const std::size_t at = text.find(begin);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(ValidateVerb, PrintsARowAndTheVerdictOfEachMeasurementOfAFolder) {
    const Bench bench;
    (void)bench.write("air.yaml", kFile);
    const Finished run = bench.run({"validate", "."});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("\nair\n"));
    // by hand: 1.2 - 16/15 = 0.1333, 1.1 - 64/63 = 0.0841
    EXPECT_THAT(line_of(run.out, "  near"),
                MatchesRegex(" +near +2 +0.111 +0.133 +0.002 +0 +differs +-"));
    EXPECT_THAT(line_of(run.out, "  far"),
                MatchesRegex(" +far +2 +[0-9.e-]+ +[0-9.e-]+ +- +- +open +-"));
    EXPECT_THAT(run.out, HasSubstr("0 rows hold, 1 differ, 1 open; 1 sources were looked at"));
    const Finished notes = bench.run({"validate", ".", "--notes"});
    EXPECT_THAT(notes.out, HasSubstr("thrust [-]\n      somebody\n      scatter 0.002: repeats\n"
                                     "      too much\n"));
    EXPECT_THAT(notes.out, HasSubstr("  w\n      h\n      y\n"));
}

TEST(ValidateVerb, JsonHasEveryPointOfTheShippedTable) {
    const Bench bench;
    const Finished run = bench.run({"validate", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    const Finished text = bench.run({"validate"});
    std::map<std::string, int> count;
    for (const auto& row : json["rows"]) {
        const auto id = row["id"].get<std::string>();
        SCOPED_TRACE(id);
        ++count[row["verdict"]];
        for (const auto& series : row["series"]) {
            EXPECT_EQ(series["x"].size(), series["said"].size());
            EXPECT_EQ(series["measured"].size(), series["said"].size());
        }
        EXPECT_EQ(row["fits"].is_null(), row["fitted"].is_null());
        EXPECT_EQ(row["scatter"].is_null(), row["p"].is_null());
        EXPECT_THAT(line_of(text.out, "  " + id + " "),
                    HasSubstr(" " + row["verdict"].get<std::string>() + " "));
    }
    EXPECT_THAT(text.out, HasSubstr(std::to_string(count["holds"]) + " rows hold, " +
                                    std::to_string(count["differs"]) + " differ, " +
                                    std::to_string(count["open"]) + " open; " +
                                    std::to_string(json["looked_at"].size()) + " sources"));
    EXPECT_GT(count["holds"], 0);
    EXPECT_GT(count["differs"], 0);
    EXPECT_GT(count["open"], 0);
}

TEST(ValidateVerb, RefusesABadFileInOneLineWithItsPlace) {
    const Bench bench;
    const auto refused = [&](const std::string& from, const std::string& to,
                             const std::vector<std::string>& texts) {
        std::string text = kFile;
        text.replace(text.find(from), from.size(), to);
        (void)bench.write("air.yaml", text);
        expect_refused(bench.run({"validate", "."}), texts);
    };
    refused("law: ground", "law: grund", {"air.yaml:6: near.law"});
    refused("scatter: 0.002", "scatter: -1", {"air.yaml:7: near.scatter", "above 0"});
    refused("y: [1.2, 1.1]", "y: [1.2]", {"air.yaml:11: near.series[0].y", "2 numbers"});
    refused("source: somebody", "sauce: somebody", {"air.yaml:3: near.sauce"});
    expect_refused(bench.run({"validate", "nowhere"}), {"nowhere", "no such folder", "*.yaml"});
    expect_refused(bench.run({"validate", "--jason"}), {"--jason"});
}

}  // namespace
}  // namespace limpet
