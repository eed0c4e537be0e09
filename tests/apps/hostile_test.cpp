// SPDX-License-Identifier: Apache-2.0
// Files that are made to do harm: one line, exit code 2, at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "../support/png.hpp"
#include "mcap_bytes.hpp"
#include "program.hpp"

namespace limpet {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;
using std::chrono::seconds;

std::string with_attachment(const std::string& name) {
    return mcap_bytes::recording(mcap_bytes::attachment(name, "mine now\n"));
}

/// @param bodies  of its messages
std::string with_message_type(const std::string& type,
                              const std::vector<std::string>& bodies = {""}) {
    std::string messages;
    for (const std::string& body : bodies) {
        messages += mcap_bytes::message(0, std::string("\0\1\0\0", 4) + body);
    }
    return mcap_bytes::recording(mcap_bytes::channel("/t", "a/msg/B", type) + messages);
}

/// A shell's limits ("-v 300000") on a run, whose words go to `out` and `err`.
int exit_code_under(const Bench& bench, const std::string& limits, const std::string& arguments) {
    const std::string command = "cd '" + bench.folder().string() + "' && ulimit -c 0 && " + limits +
                                " && exec '" + std::string(LIMPET_PROGRAM) + "' " + arguments +
                                " >out 2>err";
    const int status = std::system(("exec sh -c \"" + command + "\"").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Hostile, NoAttachmentLeadsOutOfTheFolder) {
    const Bench bench;
    fs::create_directories(bench.folder() / "in/deep");
    (void)bench.write("in/deep/good.mcap", with_attachment("F"));
    EXPECT_EQ(bench.run({"csv", "in/deep/good.mcap"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(bench.folder() / "in/deep/csv/F"));
    fs::remove_all(bench.folder() / "in/deep/csv");
    const std::string absolute = (bench.folder() / "F").string();
    for (const std::string& name : {std::string("../../F"), absolute}) {
        (void)bench.write("in/deep/bad.mcap", with_attachment(name));
        const auto before = bench.files();
        expect_refused(bench.run({"csv", "in/deep/bad.mcap"}), {"bad.mcap: attachment "});
        EXPECT_EQ(bench.files(), before);
    }
}

TEST(Hostile, NoMessageTypeKeepsAReaderBusy) {
    const Bench bench;
    const std::string separator = std::string(80, '=') + "\nMSG: a/";
    (void)bench.write("loop.mcap", with_message_type("E[4294967295] x\n" + separator +
                                                     "E\nF[4294967295] y\n" + separator + "F\n"));
    (void)bench.write("itself.mcap", with_message_type("B b\nB c\n"));
    for (const char* verb : {"csv", "plot", "film", "check"}) {
        expect_refused(bench.run({verb, "loop.mcap"}), {"more than 10000 fields"});
        expect_refused(bench.run({verb, "itself.mcap"}), {"message within itself"});
    }
    expect_refused(bench.run({"compare", "loop.mcap", "loop.mcap"}), {"more than 10000 fields"});
}

/// 20^16 fields in 3 kB, and 1,000 lists of 64 columns each, which every later row would have.
TEST(Hostile, ATypesDefinitionBoundsWhatItCosts) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer reserves more than all";
#endif
    const std::string separator = std::string(80, '=') + "\nMSG: a/";
    std::string tree;
    for (int depth = 0; depth <= 15; ++depth) {
        tree += depth > 0 ? separator + "T" + std::to_string(depth) + "\n" : "";
        for (int i = 0; i < 20; ++i) {
            tree += depth < 15 ? "T" + std::to_string(depth + 1) : std::string("float64");
            tree += " f" + std::to_string(i) + "\n";
        }
    }
    std::string type, full, empty;
    for (int i = 0; i < 1000; ++i) {
        type += "uint8[] c" + std::to_string(i) + "\n";
        full += mcap_bytes::number(64, 4) + std::string(64, '\0');
        empty += mcap_bytes::number(0, 4);
    }
    const Bench bench;
    (void)bench.write("tree.mcap", with_message_type(tree));
    (void)bench.write("wide.mcap", with_message_type(type, {full, empty, empty, empty}));
    for (const std::string name : {"tree", "wide"}) {
        const std::string line =
            name + ".mcap: topic /t is not read: a/msg/B: more than 10000 fields\n";
        for (const std::string verb : {"csv", "check", "plot", "compare"}) {
            SCOPED_TRACE(verb + " " + name);
            const std::string file = name + ".mcap";
            EXPECT_EQ(exit_code_under(bench, "ulimit -t 20 && ulimit -v 500000",
                                      verb + " " + file + (verb == "compare" ? " " + file : "")),
                      2);
            const std::string err = text_of(bench.folder() / "err");
            EXPECT_THAT(err, testing::AllOf(testing::StartsWith("limpet: "), EndsWith(line)));
            EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        }
        EXPECT_EQ(
            exit_code_under(bench, "ulimit -t 20 && ulimit -v 500000", "view " + name + ".mcap"),
            2);
        EXPECT_THAT(text_of(bench.folder() / "err"), testing::StartsWith("limpet: " + name));
    }
}

TEST(Hostile, WhatNeverEndsIsReadUpToItsBound) {
    const Bench bench;
    expect_refused(bench.run({"rotor", "/dev/zero", "--diameter", "12in"}),
                   {"/dev/zero: is larger than 1 MB, which no propeller file is"});
    expect_refused(bench.run({"identify", "/dev/zero"}), {"larger than 50 MB"});
    expect_refused(bench.run({"fly", "/dev/zero"}), {"larger than 1 MB"});
    expect_refused(bench.run({"check", "/dev/zero"}), {"larger than 1 MB"});
    expect_refused(bench.run({"campaign", "/dev/zero"}), {"larger than 1 MB"});
    expect_refused(bench.run({"companion", "/dev/zero", "--check"}), {"larger than 1 MB"});
    expect_refused(bench.run({"plot", "/dev/zero"}), {"not a regular file"});
    expect_refused(bench.run({"summary", "/dev/zero"}), {"/dev/zero"});
}

TEST(Hostile, NamesMustBeUtf8) {
    const Bench bench;
    const std::string name = "caf\xE9";
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"fly", "hover", "--out", name},
          std::vector<std::string>{"fly", name + ".yaml"},
          std::vector<std::string>{"fly", "hover", "--set", "vehicle=" + name}}) {
        expect_refused(bench.run(words), {"is not UTF-8"});
    }
    (void)bench.write("x.yaml", "mission: hover\nvehicle: perching_uav\ndescription: " + name);
    expect_refused(bench.run({"fly", "x.yaml"}), {"x.yaml: is not UTF-8 text"});
    EXPECT_THAT(bench.files(), testing::ElementsAre("x.yaml"));
}

/// By a shell, which closes and fills what a program writes to.
int exit_code_in_shell(const Bench& bench, const std::string& arguments) {
    const std::string command = "cd '" + bench.folder().string() + "' && '" +
                                std::string(LIMPET_PROGRAM) + "' " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Without enough memory or threads a run ends in a line; with enough it succeeds.
TEST(Hostile, NoMemoryEndsInALine) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer reserves more than all";
#endif
    const Bench bench;
    int short_of = 0, enough = 0;
    for (const char* kB :
         {"25000", "60000", "90000", "110000", "130000", "160000", "200000", "300000", "4000000"}) {
        for (const std::string& verb :
             {std::string("campaign smoke --jobs 8 --out c --quiet"),
              std::string("fly hover --set simulation.hover_s=0.1 --no-figures --out o"),
              std::string("check perch_concrete")}) {
            fs::remove_all(bench.folder() / "c");
            const int code = exit_code_under(bench, "ulimit -v " + std::string(kB), verb);
            const std::string err = text_of(bench.folder() / "err");
            EXPECT_TRUE(code == 0 || code == 2 || code == 127)
                << kB << " " << verb << ": " << code << " " << err;
            if (code == 2) {
                EXPECT_THAT(err, HasSubstr("limpet: ")) << kB << " " << verb;
                EXPECT_THAT(err, Not(HasSubstr("terminate"))) << kB << " " << verb;
                EXPECT_THAT(err, Not(HasSubstr("a fault of ours"))) << kB << " " << verb;
            }
            short_of += code == 2 ? 1 : 0;
            enough += code == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(short_of, 0);
    EXPECT_GT(enough, 2);
}

TEST(Hostile, AClosedOrFullStandardErrorChangesNoExitCode) {
    const Bench bench;
    for (const char* error : {" 2>&-", " 2>/dev/full"}) {
        EXPECT_EQ(exit_code_in_shell(bench, std::string("fly nowhere.yaml") + error), 2);
        EXPECT_EQ(exit_code_in_shell(bench, std::string("fly hover --set simulation.hover_s=0.1 "
                                                        "--quiet --expect crashed --out o") +
                                                error),
                  1);
        EXPECT_EQ(exit_code_in_shell(bench, std::string("fly hover --set simulation.hover_s=0.1 "
                                                        "--json --out o >/dev/null") +
                                                error),
                  0);
    }
    EXPECT_THAT(text_of(bench.folder() / "o/flight.mcap"), EndsWith("\x89MCAP0\r\n"));
}

TEST(Hostile, AFullStandardOutputIsReportedAndNoFaultOfOurs) {
    const Bench bench;
    for (const std::string& verb :
         {std::string("list scenarios"), std::string("--help"),
          std::string("fly hover --set simulation.hover_s=0.1 --no-figures --out o"),
          std::string("fly hover --set simulation.hover_s=0.1 --json --out o")}) {
        EXPECT_EQ(exit_code_in_shell(bench, verb + " >/dev/full 2>err"), 2) << verb;
        EXPECT_THAT(text_of(bench.folder() / "err"),
                    EndsWith("limpet: standard output cannot be written\n"))
            << verb;
    }
    EXPECT_TRUE(fs::exists(bench.folder() / "o/flight.mcap"));
    EXPECT_FALSE(fs::exists(bench.folder() / "o/flight.mcap.part"));
}

TEST(Hostile, ForcesThatFeedOnTheMotionEndTheFlight) {
    const Bench bench;
    const Finished end =
        bench.run({"fly", "slow_motors_concrete", "--set", "vehicle.rotor.rolling_constant_kg_m=1",
                   "--no-figures", "--expect", "crashed"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.out, HasSubstr("turned faster than 200 rad/s"));
}

TEST(Hostile, CtrlCEndsAHoverWithALine) {
    const Bench bench;
    Started hover(bench.folder(), "hover",
                  {"fly", "hover", "--set", "simulation.hover_s=60", "--speed", "1", "--no-figures",
                   "--out", "o"});
    ASSERT_TRUE(hover.prints("time s", seconds(30)));
    hover.signal(SIGINT);
    const Finished end = hover.wait(seconds(30));
    expect_line_of_error(end, 130, {"interrupted; the recording is whole up to here"});
    EXPECT_THAT(end.out, Not(HasSubstr("timed_out")));
    EXPECT_TRUE(fs::exists(bench.folder() / "o/flight.mcap"));
}

TEST(Hostile, CtrlCEndsTheWaitForALog) {
    const Bench bench;
    const fs::path pipe = bench.folder() / "log.csv";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    Started identify(bench.folder(), "identify", {"identify", "log.csv"});
    std::ofstream writer(pipe);  // opens when the reader does
    writer << "t_s,pressure_Pa\n0,101325\n" << std::flush;
    identify.signal(SIGINT);
    writer.close();  // in case the signal came between two reads
    const Finished end = identify.wait(seconds(30));
    expect_line_of_error(end, 130, {"interrupted"});
    EXPECT_FALSE(fs::exists(bench.folder() / "out"));
}

TEST(Hostile, CtrlCEndsAFilmWithALineAndNothingWritten) {
    const Bench bench;
    ASSERT_EQ(bench.run({"fly", "hover", "--no-figures", "--out", "o"}).exit_code, 0);
    // It is at work once its scratch folder is there.
    const fs::path scratch = bench.folder() / "scratch";
    fs::create_directory(scratch);
    const test::Environment temporary("TMPDIR", scratch.string());
    Started film(bench.folder(), "film", {"film", "o/flight.mcap", "--out", "f"});
    for (int i = 0; i < 3000 && fs::is_empty(scratch); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    film.signal(SIGINT);
    expect_line_of_error(film.wait(seconds(60)), 130, {"interrupted"});
    EXPECT_TRUE(fs::is_empty(bench.folder() / "f"));
    EXPECT_TRUE(fs::is_empty(scratch));
}

TEST(Hostile, CtrlCInTheLastPartOfThePaperWritesNoPage) {
    const Bench bench;
    Started paper(bench.folder(), "paper", {"reproduce", "--only", "trials", "--out", "o"});
    ASSERT_TRUE(paper.prints("pendulum trials", seconds(30)));
    paper.signal(SIGINT);
    expect_line_of_error(paper.wait(seconds(60)), 130, {"stopped; no page was written"});
    EXPECT_FALSE(fs::exists(bench.folder() / "o/index.html"));
}

TEST(Hostile, TwoFlightsDoNotShareAFolder) {
    const Bench bench;
    Started first(bench.folder(), "first",
                  {"fly", "hover", "--set", "simulation.hover_s=60", "--speed", "1", "--no-figures",
                   "--out", "o"});
    ASSERT_TRUE(first.prints("time s", seconds(30)));
    expect_refused(bench.run({"fly", "hover", "--out", "o"}),
                   {"o: another flight or campaign is at work in this folder"});
    first.signal(SIGINT);
    EXPECT_EQ(first.wait(seconds(30)).exit_code, 130);
    EXPECT_THAT(text_of(bench.folder() / "o/flight.mcap"), EndsWith("\x89MCAP0\r\n"));
}

}  // namespace
}  // namespace limpet
