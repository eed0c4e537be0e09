// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;

int shell(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Words of a help text that are options: "--out".
std::vector<std::string> options_in(const std::string& help) {
    std::vector<std::string> found;
    std::istringstream words(help);
    for (std::string word; words >> word;) {
        if (word.rfind("--", 0) == 0 && word.size() > 3) {
            const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-");
            found.push_back(word.substr(0, end));
        }
    }
    return found;
}

/// As troff writes it.
std::string typeset(std::string text) {
    for (std::size_t at = 0; (at = text.find('-', at)) != text.npos; at += 2) {
        text.replace(at, 1, "\\-");
    }
    return text;
}

const std::vector<std::string>& verbs() {
    static const std::vector<std::string> all = {
        "fly",       "sim-io",   "campaign", "merge",     "companion", "replay",     "summary",
        "reproduce", "identify", "check",    "list",      "params",    "px4-params", "plot",
        "film",      "csv",      "ulog",     "view",      "lab",       "compare",    "export",
        "rotor",     "stand-in", "study",    "calibrate", "dossier",   "validate"};
    return all;
}

TEST(Manual, HoldsEveryVerbAndOption) {
    const Bench bench;
    const std::string page = bench.run({"help", "--man"}).out;
    const std::string help = bench.run({"--help"}).out;
    for (const std::string& verb : verbs()) {
        EXPECT_THAT(help, HasSubstr("\n  " + verb + " ")) << "another verb: name it here";
        EXPECT_THAT(page, HasSubstr(".SS \\fBlimpet\\fR \\fB" + typeset(verb) + "\\fR"));
        const std::string of_verb = bench.run({verb, "--help"}).out;
        const std::size_t from = of_verb.find("Options:");
        std::istringstream lines(from == of_verb.npos ? "" : of_verb.substr(from));
        for (std::string line; std::getline(lines, line);) {
            if (line.rfind("  -", 0) == 0) {  // the line of an option, not its description
                for (const std::string& option : options_in(line.substr(0, line.find("  ", 2)))) {
                    if (option != "--help") {
                        EXPECT_THAT(page, HasSubstr("\\fB" + typeset(option) + "\\fR")) << verb;
                    }
                }
            }
        }
    }
}

TEST(Manual, IsTypesetWithoutAWarning) {
    const Bench bench;
    const std::string file = bench.write("limpet.1", bench.run({"help", "--man"}).out);
    if (shell("command -v groff >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "no groff here";
    }
    EXPECT_EQ(shell("test -z \"$(groff -man -ww -z " + file + " 2>&1)\""), 0);
}

class Completion : public testing::Test {
protected:
    /// What bash offers for the last of these words.
    std::string offered(const std::string& words) const {
        const std::string script = bench_.write("limpet.bash", script_);
        const std::string out = (bench_.folder() / "offered").string();
        // compopt is of use only while the shell completes
        EXPECT_EQ(
            shell("bash -c 'compopt() { :; }; . " + script + "; COMP_WORDS=(" LIMPET_PROGRAM " " +
                  words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _limpet; " +
                  "echo \"${COMPREPLY[*]}\" >" + out + "'"),
            0);
        return text_of(out);
    }

private:
    const Bench bench_;
    const std::string script_ = bench_.run({"help", "--completion", "bash"}).out;
};

TEST_F(Completion, OffersVerbsOptionsNamesAndKeys) {
    EXPECT_EQ(offered("camp"), "campaign\n");
    EXPECT_EQ(offered("fly perch_me"), "perch_metal perch_metal_valve\n");
    EXPECT_EQ(offered("fly perch_metal --exp"), "--expect\n");
    EXPECT_EQ(offered("fly perch_metal --set guidance.dock_sp"), "guidance.dock_speed_m_s=\n");
    EXPECT_EQ(offered("fly perch_metal --autopilot p"), "px4\n");
    EXPECT_EQ(offered("list surf"), "surfaces\n");
    EXPECT_EQ(offered("sim-io perch_concrete optitrack"), "optitrack_px4\n");
    EXPECT_EQ(offered("campaign fig3_w"), "fig3_without_spread\n");
    EXPECT_EQ(offered("check iri"), "iris\n");
    EXPECT_EQ(offered("identify pressure"), "pressure_log\n");
    EXPECT_EQ(offered("list sam"), "samples\n");
}

TEST(CompletionOptions, AreCheckedLikeAnyOther) {
    const Bench bench;
    const Finished done = bench.run({"help", "--completion", "fish"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_TRUE(done.one_line_of_error()) << done.err;
    EXPECT_THAT(bench.run({"help", "--completion", "zsh"}).out, HasSubstr("#compdef limpet"));
}

}  // namespace
}  // namespace limpet
