// SPDX-License-Identifier: Apache-2.0
//
// Shards and their merging, through the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "campaigns.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Shard, PartsAreAllRunsOnce) {
    for (const std::uint32_t runs : {1U, 7U, 253U, 1'000'000'000U}) {
        for (const std::uint32_t parts : {1U, 2U, 8U, 1000U}) {
            std::uint32_t next = 0;
            for (std::uint32_t part = 1; part <= parts; ++part) {
                const Shard shard{.part = part, .parts = parts};
                EXPECT_EQ(shard.begin(runs), next);
                next = shard.end(runs);
                EXPECT_LE(next - shard.begin(runs), runs / parts + 1);
            }
            EXPECT_EQ(next, runs);
        }
    }
    EXPECT_EQ(parse_shard("2/8"), (Shard{.part = 2, .parts = 8}));
}

class Sharded : public testing::Test {
protected:
    Sharded() {
        (void)bench_.write("x.yaml", short_hovers(20));
        for (const char* shard : {"1/3", "2/3", "3/3"}) {
            fly("x.yaml", shard, std::string(1, shard[0]));
        }
    }
    void fly(const std::string& file, const std::string& shard, const std::string& out) const {
        const Finished flown =
            bench_.run({"campaign", file, "-j", "1", "--shard", shard, "--out", out});
        EXPECT_EQ(flown.exit_code, 0) << flown.err;
    }
    [[nodiscard]] fs::path file(const std::string& folder) const {
        return bench_.folder() / folder / "results.sqlite";
    }
    /// One line, exit code 2, nothing written.
    void expect_refused(const std::vector<std::string>& arguments, const std::string& text) const {
        const auto files = bench_.files();
        const Finished finished = bench_.run(arguments);
        EXPECT_EQ(finished.exit_code, 2) << finished.err;
        EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
        EXPECT_THAT(finished.err, HasSubstr(text));
        EXPECT_EQ(finished.out, "");
        EXPECT_EQ(bench_.files(), files);
    }

    Bench bench_;
};

TEST_F(Sharded, MergeToTheRowsOfOneCampaign) {
    EXPECT_EQ(bench_.run({"campaign", "x.yaml", "-q", "--out", "whole"}).exit_code, 0);
    const Finished merged = bench_.run({"merge", "3", "1", "2/results.sqlite", "--out", "merged"});
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_THAT(merged.out, HasSubstr("20 runs of 3 files"));
    EXPECT_EQ(table_of(file("merged")), table_of(file("whole")));
    EXPECT_THAT(bench_.files(), testing::Not(testing::Contains(HasSubstr("merging"))));
    // A file of results like any other.
    EXPECT_THAT(bench_.run({"summary", "merged"}).out, HasSubstr("20 of 20 runs"));
    EXPECT_EQ(bench_.run({"replay", "merged", "13", "--out", "again"}).exit_code, 0);
    EXPECT_EQ(bench_.run({"campaign", "x.yaml", "--out", "merged", "--resume"}).exit_code, 0);
    expect_refused({"merge", "1", "2", "3", "--out", "merged"}, "is there already");
}

TEST_F(Sharded, MissingOverlappingAndUnfinishedAreNamed) {
    expect_refused({"merge", "1", "3", "--out", "merged"},
                   "7 of 20 runs are missing: runs 6 to 12; not given: shard 2/3");
    expect_refused({"merge", "1", "2", "3", "2", "--out", "merged"},
                   "2/results.sqlite and 2/results.sqlite overlap: both hold runs 6 to 12");
    fly("x.yaml", "1/2", "half");
    expect_refused({"merge", "1", "2", "half", "--out", "merged"}, "overlap");
    open_database(file("2"), Access::write).exec("DELETE FROM runs WHERE run = 9");
    expect_refused({"merge", "1", "2", "3", "--out", "merged"},
                   "2/results.sqlite: 1 of the 7 runs of shard 2/3 are missing; --resume");
    const Finished resumed =
        bench_.run({"campaign", "x.yaml", "--shard", "2/3", "--out", "2", "--resume"});
    EXPECT_THAT(resumed.out, HasSubstr("1 runs flown"));
    EXPECT_EQ(bench_.run({"merge", "1", "2", "3", "--out", "merged"}).exit_code, 0);
}

TEST_F(Sharded, ForeignOnesAreRefused) {
    (void)bench_.write("y.yaml", short_hovers(21));
    fly("y.yaml", "2/3", "other");
    expect_refused({"merge", "1", "other", "3", "--out", "merged"},
                   "other/results.sqlite: is of another campaign than 1/results.sqlite: the "
                   "campaign's file differs");
    // Another seed is another file's text, too.
    std::string text = short_hovers(20);
    text.replace(text.find("seed: 3"), 7, "seed: 4");
    (void)bench_.write("z.yaml", text);
    fly("z.yaml", "2/3", "seed");
    expect_refused({"merge", "1", "seed", "3", "--out", "merged"}, "is of another campaign");
    open_database(file("2"), Access::write).exec("UPDATE campaign SET limpet = '0.0.1'");
    expect_refused({"merge", "1", "2", "3", "--out", "merged"}, "Limpet itself differs");
    open_database(file("2"), Access::write)
        .exec("UPDATE campaign SET limpet = '" + std::string(kVersion) + "'");
    open_database(file("2"), Access::write).exec("UPDATE runs SET run = 19 WHERE run = 9");
    expect_refused({"merge", "1", "2", "3", "--out", "merged"}, "runs that its campaign does not");
    expect_refused({"merge", "1", "nowhere", "--out", "merged"}, "nowhere: there is no such file");
}

/// As many runs as the campaign says, by chance, are not its runs.
TEST_F(Sharded, SearchesAndStudiesHaveNoParts) {
    (void)bench_.write("p.yaml", pendulums(80));
    EXPECT_EQ(bench_
                  .run({"study", "p.yaml", "--of", "cup_press_max_N", "--samples", "20", "--out",
                        "study"})
                  .exit_code,
              0);
    expect_refused({"merge", "study", "--out", "merged"},
                   "study/results.sqlite: holds a study, which has no parts to be merged");
    expect_refused({"replay", "study", "80"}, "there is no run 80; 80 are finished");
    (void)bench_.run({"campaign", "p.yaml", "--rare", "cup_press_max_N<80", "--level-runs", "100",
                      "--out", "search", "-q"});
    expect_refused({"merge", "search", "--out", "merged"}, "holds a search for a rare event");
    // A study that was killed before its first flight.
    open_database(file("study"), Access::write).exec("DELETE FROM runs");
    expect_refused(
        {"campaign", "p.yaml", "--rare", "cup_press_max_N<80", "--out", "study", "--resume"},
        "holds a study, not a search");
}

TEST_F(Sharded, ADamagedPartIsNamed) {
    open_database(file("2"), Access::write).exec("UPDATE shard SET part = 9");
    expect_refused({"merge", "1", "2", "3", "--out", "merged"},
                   "2/results.sqlite: is damaged: table shard: --shard '9/3'");
    open_database(file("2"), Access::write).exec("UPDATE shard SET part = 2");
    open_database(file("2"), Access::write).exec("UPDATE campaign SET yaml = 'a: ['");
    expect_refused({"merge", "1", "2", "3", "--out", "merged"},
                   "2/results.sqlite: is damaged: table campaign: ");
}

TEST_F(Sharded, AShardIsResumedAsThatShardAlone) {
    expect_refused({"campaign", "x.yaml", "--out", "2", "--resume"},
                   "shard 2/3 was begun here: go on with --shard 2/3");
    expect_refused({"campaign", "x.yaml", "--shard", "2/4", "--out", "2", "--resume"},
                   "shard 2/3 was begun here");
    for (const char* bad : {"0/3", "4/3", "2", "2/", "/3", "a/b", "2/3x", "-1/3", "1/9999999"}) {
        expect_refused({"campaign", "x.yaml", "--shard", bad, "--out", "bad"}, "must be I/N");
    }
}

}  // namespace
}  // namespace limpet::campaign
