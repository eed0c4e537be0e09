// SPDX-License-Identifier: Apache-2.0
//
// Campaigns under Open MPI's own mpirun, three ranks on this machine, over shared memory and
// loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>

#include "../campaign/campaigns.hpp"
#include "../campaign/running.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::ranks {
using namespace campaign;
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kRankRuns = 400;
constexpr int kManyRankRuns = 10'000;  ///< where mpirun takes its time to pass a signal on
/// Runs that a rank of one thread may hold, in the air and ahead, and some.
constexpr int kHeldRuns = 40;

std::vector<std::string> mpirun(int ranks) {
    std::vector<std::string> words = {"mpirun",
                                      "--allow-run-as-root",
                                      "--oversubscribe",
                                      "--mca",
                                      "btl",
                                      "self,vader,tcp",
                                      "--mca",
                                      "btl_tcp_if_include",
                                      "lo",
                                      "--mca",
                                      "btl_vader_single_copy_mechanism",
                                      "none"};
    // Open MPI 5 takes no loopback for its daemons, nor does it need an interface for those of one
    // machine.
    static const bool before_5 =
        std::system("mpirun --version | grep -q '(Open MPI) [1-4][.]'") == 0;
    if (before_5) {
        words.insert(words.end(), {"--mca", "oob_tcp_if_include", "lo"});
    }
    words.insert(words.end(), {"-n", std::to_string(ranks)});
    return words;
}

/// The process of a rank in a folder; 0: there is none.
pid_t process_of(int rank, const fs::path& folder) {
    const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::error_code ignored;
        if (fs::read_symlink(entry.path() / "cwd", ignored) != folder ||
            fs::read_symlink(entry.path() / "exe", ignored) != fs::canonical(LIMPET_PROGRAM)) {
            continue;
        }
        std::istringstream variables(text_of(entry.path() / "environ"));
        for (std::string variable; std::getline(variables, variable, '\0');) {
            if (variable == wanted) {
                return std::stoi(entry.path().filename());
            }
        }
    }
    return 0;
}

class Mpi : public testing::Test {
protected:
    void SetUp() override {
        if (std::system("command -v mpirun >/dev/null") != 0 ||
            !fs::exists(LIMPET_MPI_FOLDER "/limpet_mpi.so")) {
            GTEST_SKIP() << "needs openmpi-bin and libopenmpi-dev";
        }
    }
    [[nodiscard]] fs::path file(const std::string& folder) const {
        return bench_.folder() / folder / "results.sqlite";
    }
    [[nodiscard]] std::string log() const { return text_of(bench_.folder() / "log"); }
    /// Three ranks of a thread each.
    [[nodiscard]] int run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"-j", "1"});
        return Running(bench_.folder(), arguments, mpirun(3)).wait();
    }
    [[nodiscard]] std::uint32_t finished(const std::string& folder) const {
        try {
            return fs::exists(file(folder)) ? Results(file(folder), Access::read).finished() : 0;
        } catch (const InputError&) {
            return 0;  // between two states of its log
        }
    }
    [[nodiscard]] std::vector<std::vector<std::string>> rows_alone() const {
        EXPECT_EQ(bench_.run({"campaign", "x.yaml", "-j", "1", "--out", "alone", "-q"}).exit_code,
                  0);
        return table_of(file("alone"));
    }
    /// What the end of the log says of each rank.
    [[nodiscard]] std::vector<int> flown_by_rank() const {
        std::smatch found;
        const std::string text = log();
        EXPECT_TRUE(std::regex_search(text, found, std::regex("by rank 0 and on: ([0-9 ]+)")))
            << text;
        std::istringstream numbers(found.str(1));
        return {std::istream_iterator<int>(numbers), {}};
    }

    Bench bench_;
};

/// What comes of a signal in mid-campaign to one rank, or to mpirun; then it is resumed.
struct CutRanks {
    int ended = 0;
    std::uint32_t kept = 0;
    std::string log;
};

class CutMpi : public Mpi {
protected:
    /// @param rank  none: mpirun itself
    [[nodiscard]] CutRanks cut_and_resume(int signal, std::optional<int> rank,
                                          int runs = kRankRuns) const {
        (void)bench_.write("x.yaml", short_hovers(runs));
        CutRanks cut;
        {
            Running running(bench_.folder(), {"campaign", "x.yaml", "-j", "1", "--out", "cut"},
                            mpirun(3));
            EXPECT_TRUE(eventually([&] { return finished("cut") >= 10; })) << log();
            if (!rank) {
                running.signal(signal);
            } else if (const pid_t process = process_of(*rank, bench_.folder()); process != 0) {
                kill(process, signal);
            } else {
                ADD_FAILURE() << "no rank " << *rank;
            }
            cut.ended = running.wait();
        }
        cut.log = log();
        cut.kept = finished("cut");
        EXPECT_GE(cut.kept, 10U);
        EXPECT_LT(cut.kept, static_cast<std::uint32_t>(runs)) << "too late to prove anything";
        EXPECT_EQ(run({"campaign", "x.yaml", "--out", "cut", "--resume"}), 0) << log();
        EXPECT_THAT(log(), HasSubstr(std::to_string(static_cast<std::uint32_t>(runs) - cut.kept) +
                                     " runs flown in"));
        EXPECT_EQ(table_of(file("cut")), rows_alone());
        return cut;
    }
};

TEST_F(Mpi, RanksBringTheRowsOfOneProcess) {
    (void)bench_.write("x.yaml", short_hovers(60));
    EXPECT_EQ(run({"campaign", "x.yaml", "--out", "ranks"}), 0) << log();
    EXPECT_THAT(log(), HasSubstr("60 runs of hover, seed 3, on 3 ranks, 1 thread on the first"));
    EXPECT_EQ(table_of(file("ranks")), rows_alone());
    EXPECT_EQ(flown_by_rank().size(), 3U);
    EXPECT_EQ(run({"campaign", "x.yaml", "--out", "ranks"}), 2);
    EXPECT_THAT(log(), HasSubstr("results.sqlite: is there already"));
}

TEST_F(Mpi, ARankThatIsHeldUpHoldsUpNobody) {
    (void)bench_.write("x.yaml", short_hovers(kRankRuns));
    Running running(bench_.folder(), {"campaign", "x.yaml", "-j", "1", "--out", "ranks"},
                    mpirun(3));
    ASSERT_TRUE(eventually([&] { return finished("ranks") >= 10; })) << log();
    const pid_t slow = process_of(1, bench_.folder());
    ASSERT_NE(slow, 0);
    kill(slow, SIGSTOP);
    const auto before = static_cast<int>(finished("ranks"));
    ASSERT_LT(before, kRankRuns - 2 * kHeldRuns) << "too late to prove anything";
    EXPECT_TRUE(eventually([&] { return finished("ranks") >= kRankRuns - kHeldRuns; })) << log();
    kill(slow, SIGCONT);
    EXPECT_EQ(running.wait(), 0) << log();
    const std::vector<int> flown = flown_by_rank();
    ASSERT_EQ(flown.size(), 3U);
    EXPECT_LE(flown[1], before + kHeldRuns);
    EXPECT_EQ(flown[0] + flown[1] + flown[2], kRankRuns);
    EXPECT_EQ(table_of(file("ranks")), rows_alone());
}

TEST_F(CutMpi, ARankIsKilledAndResumedNothingIsLostOrRepeated) {
    EXPECT_NE(cut_and_resume(SIGKILL, 2).ended, 0);
}

TEST_F(CutMpi, TheFirstRankIsKilledAndResumedNothingIsLostOrRepeated) {
    EXPECT_NE(cut_and_resume(SIGKILL, 0).ended, 0);
}

TEST_F(CutMpi, ARankThatIsInterruptedStopsAllCleanly) {
    const CutRanks cut = cut_and_resume(SIGINT, 1);
    EXPECT_EQ(cut.ended, 130);
    EXPECT_THAT(cut.log, HasSubstr("stopped after " + std::to_string(cut.kept)));
    EXPECT_THAT(cut.log, HasSubstr("limpet campaign x.yaml --out cut --resume"));
}

/// mpirun's own end: it passes the signal on, says 1, and no more of what ranks say.
TEST_F(CutMpi, MpirunIsInterruptedAndResumedNothingIsLostOrRepeated) {
    EXPECT_NE(cut_and_resume(SIGINT, std::nullopt, kManyRankRuns).ended, 0);
}

TEST_F(Mpi, RanksThatCannotFlyTheSameRefuseInOneLine) {
    (void)bench_.write("x.yaml", short_hovers(6));
    (void)bench_.write("y.yaml", short_hovers(7));
    // Open MPI 5.0.7's mpirun crashes on two programs with ':' between them.
    std::vector<std::string> launcher = mpirun(2);
    launcher.insert(launcher.end(), {"sh", "-c",
                                     "[ $OMPI_COMM_WORLD_RANK != 0 ] || set -- \"$1\" campaign "
                                     "x.yaml; exec \"$@\"",
                                     "sh"});
    EXPECT_EQ(Running(bench_.folder(), {"campaign", "y.yaml"}, launcher).wait(), 2);
    EXPECT_THAT(log(), HasSubstr("limpet: rank 1 on "));
    EXPECT_THAT(log(), HasSubstr("the campaign's file is not the same"));
    EXPECT_EQ(run({"campaign", "nowhere.yaml"}), 2);
    const std::string told = log();
    EXPECT_THAT(told, HasSubstr("limpet: nowhere.yaml"));
    EXPECT_EQ(told.find("limpet: ", told.find("limpet: ") + 1), std::string::npos) << told;
    EXPECT_FALSE(fs::exists(bench_.folder() / "out"));
}

TEST_F(Mpi, WhatRanksDoNotFlyTheFirstRefusesInOneLine) {
    (void)bench_.write("x.yaml", pendulums(80));
    const auto expect_told = [this](const std::vector<std::string>& arguments,
                                    const std::string& why) {
        EXPECT_EQ(Running(bench_.folder(), arguments, mpirun(3)).wait(), 2) << log();
        const std::string told = log();
        EXPECT_THAT(told, HasSubstr("limpet: "));
        EXPECT_THAT(told, HasSubstr(why));
        EXPECT_EQ(told.find("limpet: ", told.find("limpet: ") + 1), std::string::npos) << told;
    };
    expect_told({"campaign", "x.yaml", "--rare", "cup_press_max_N<80"},
                "--rare: a search flies in one process, start it without mpirun");
    expect_told({"campaign", "x.yaml", "--autopilot", "px4", "--px4", "/nowhere"},
                "--autopilot px4: flies in one process");
    EXPECT_FALSE(fs::exists(bench_.folder() / "out"));
    EXPECT_EQ(bench_
                  .run({"study", "x.yaml", "--of", "cup_press_max_N", "--samples", "16", "--out",
                        "study"})
                  .exit_code,
              0);
    expect_told({"campaign", "x.yaml", "--out", "study", "--resume"}, "holds a study of cup_press");
}

/// Where nothing ties them together, each would fly all of it.
TEST_F(Mpi, TasksWithoutMpiAreRefused) {
    (void)bench_.write("x.yaml", short_hovers(6));
    setenv("SLURM_STEP_NUM_TASKS", "4", 1);
    const Finished finished = bench_.run({"campaign", "x.yaml"});
    const Finished shard = bench_.run({"campaign", "x.yaml", "--shard", "1/4", "-q"});
    unsetenv("SLURM_STEP_NUM_TASKS");
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("srun started 4 of these, but Open MPI knows of one"));
    EXPECT_EQ(shard.exit_code, 0) << shard.err;
}

}  // namespace
}  // namespace limpet::ranks
