// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/paper/reproduce.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::paper {
namespace {

PaperStatement number(double paper, draw::Range accepted) {
    return {.claim = {.id = "x",
                      .section = "I",
                      .statement = "x is so much",
                      .paper = paper,
                      .unit = "s"},
            .evidence = "x_s",
            .accepted = accepted};
}

Evidence with(double value) {
    Evidence evidence;
    evidence.set("x_s", value);
    return evidence;
}

TEST(Judge, TheEvidenceDecidesTheVerdict) {
    const PaperStatement statement = number(1.0, {0.8, 1.4});
    for (const double inside : {0.8, 1.0, 1.4}) {
        EXPECT_EQ(judge(statement, with(inside)).verdict, report::Verdict::reproduced) << inside;
    }
    for (const double outside : {0.79, 1.41, -1.0, 1e300}) {
        EXPECT_EQ(judge(statement, with(outside)).verdict, report::Verdict::differs) << outside;
    }
}

TEST(Judge, WhatDidNotComeToPassDiffers) {
    for (const Evidence& evidence : {with(std::nan("")), Evidence{}}) {
        const report::Claim claim = judge(number(1.0, {0.8, 1.4}), evidence);
        EXPECT_EQ(claim.verdict, report::Verdict::differs);
        EXPECT_EQ(report::to_text(claim.simulated), "did not come to pass");
        EXPECT_FALSE(report::to_text(claim.difference).empty());
    }
}

TEST(Judge, AVerdictThatATurnedValueChangesHangsOnIt) {
    const PaperStatement statement = number(1.0, {0.8, 1.4});
    report::Claim claim = judge(statement, with(1.0), {{"`a` 20 % less", 0.8}, {"`b`", 1.4}});
    EXPECT_EQ(claim.verdict, report::Verdict::reproduced);
    EXPECT_EQ(claim.turned, 2);
    EXPECT_TRUE(claim.hangs_on.empty());
    claim = judge(statement, with(1.0), {{"`a` 20 % less", 0.7}, {"`b`", 1.4}, {"`c`", kNaN}});
    EXPECT_EQ(claim.verdict, report::Verdict::hangs_on_assumptions);
    EXPECT_EQ(claim.hangs_on,
              (std::vector<std::string>{"`a` 20 % less: 0.7", "`c`: did not come to pass"}));
    claim = judge(statement, with(2.0), {{"`a` 20 % less", 2.1}, {"`b`", 1.2}});
    EXPECT_EQ(claim.hangs_on, std::vector<std::string>{"`b`: 1.2"}) << "a differing one as well";
    EXPECT_EQ(judge(statement, with(2.0), {{"`a`", 2.1}}).verdict, report::Verdict::differs);
}

TEST(Judge, WithoutEvidenceToLookForItIsNotModelled) {
    PaperStatement statement = number(1.0, {});
    statement.evidence.clear();
    EXPECT_EQ(judge(statement, with(1.0)).verdict, report::Verdict::not_modelled);
}

TEST(Judge, DifferencesAreSimulatedLessPaper) {
    EXPECT_DOUBLE_EQ(std::get<double>(judge(number(1.0, {0, 2}), with(1.25)).difference), 0.25);
    EXPECT_EQ(std::get<double>(judge(number(12.0, {0, 20}), with(12.0 + 2e-15)).difference), 0.0)
        << "noise of the last digit";
    PaperStatement range = number(0.0, {1.0, 1.2});
    range.claim.paper = draw::Range{1.0, 1.2};
    EXPECT_EQ(std::get<std::string>(judge(range, with(1.1)).difference), "inside");
    EXPECT_NEAR(std::get<double>(judge(range, with(1.5)).difference), 0.3, 1e-6);
    EXPECT_NEAR(std::get<double>(judge(range, with(0.9)).difference), -0.1, 1e-6);
}

std::vector<PaperStatement> statements() {
    return load_statements(
        std::filesystem::path(LIMPET_SOURCE_DIR "/data") / "paper" / "statements.yaml",
        measured_names());
}

TEST(Statements, AreCompleteAndAppearOnce) {
    std::set<std::string> ids;
    for (const auto& [claim, evidence, accepted, yes_no] : statements()) {
        EXPECT_TRUE(ids.insert(claim.id).second) << claim.id;
        EXPECT_FALSE(claim.section.empty()) << claim.id;
        EXPECT_FALSE(claim.statement.empty()) << claim.id;
        EXPECT_FALSE(report::to_text(claim.paper).empty()) << claim.id;
        EXPECT_LE(accepted.low, accepted.high) << claim.id;
        if (evidence.empty()) {
            EXPECT_FALSE(claim.note.empty()) << claim.id << ": say why not";
        }
    }
}

/// A paper's own number outside of what is accepted as it would be a slip of ours.
TEST(Statements, AcceptThePapersOwnNumbers) {
    for (const PaperStatement& statement : statements()) {
        if (const double* paper = std::get_if<double>(&statement.claim.paper)) {
            EXPECT_GE(*paper, statement.accepted.low) << statement.claim.id;
            EXPECT_LE(*paper, statement.accepted.high) << statement.claim.id;
        }
    }
}

/// The parts put the tables' numbers into pictures and tables of the page.
TEST(Statements, HoldBothTables) {
    Study study;
    study.statements = statements();
    const auto rows = std::count_if(
        study.statements.begin(), study.statements.end(), [](const PaperStatement& statement) {
            const std::string& section = statement.claim.section;
            return section == "II-D, Table II" || section == "II-C, Table I";
        });
    EXPECT_EQ(rows, 18);
    // As the paper prints them: the value and its tolerance; Table I has none, nor have
    // pressures: 2 % and 10 hPa are ours.
    const std::map<std::string, std::pair<double, double>> printed = {
        {"rotor.perching_uav.motor_constant_kg_m", {2.50e-5, 0.05e-5}},
        {"rotor.perching_uav.moment_constant_m", {1.90e-2, 0.038e-2}},
        {"rotor.perching_uav.drag_constant_kg", {8.00e-4, 0.16e-4}},
        {"rotor.iris.motor_constant_kg_m", {5.84e-6, 0.1168e-6}},
        {"rotor.iris.moment_constant_m", {6.00e-2, 0.12e-2}},
        {"rotor.iris.drag_constant_kg", {1.75e-4, 0.035e-4}},
        {"press_concrete.vacuum_hPa", {650.0, 10.0}},
        {"press_concrete.tau_1_s", {0.33, 0.03}},
        {"press_concrete.tau_2_s", {0.4, 0.03}},
        {"press_cinder_block.vacuum_hPa", {275.0, 10.0}},
        {"press_cinder_block.tau_1_s", {0.35, 0.03}},
        {"press_cinder_block.tau_2_s", {7.5, 0.5}},
        {"press_turbine_blade.vacuum_hPa", {265.0, 10.0}},
        {"press_turbine_blade.tau_1_s", {0.25, 0.03}},
        {"press_turbine_blade.tau_2_s", {8.0, 0.5}},
        {"press_metal.vacuum_hPa", {275.0, 10.0}},
        {"press_metal.tau_1_s", {0.25, 0.03}},
        {"press_metal.tau_2_s", {16.0, 1.0}},
    };
    ASSERT_EQ(printed.size(), 18U);
    for (const auto& [name, value] : printed) {
        const auto [paper, tolerance] = study.stated(name);
        EXPECT_EQ(paper, value.first) << name;
        EXPECT_NEAR(tolerance, value.second, 1e-9 * paper) << name;
        const auto* of = find_by(study.statements, &PaperStatement::evidence, name);
        EXPECT_NEAR(paper - of->accepted.low, value.second, 1e-9 * paper) << name;
    }
    EXPECT_THROW((void)study.stated("press_metal.tau_3_s"), InputError);
}

class StatementsFile : public testing::Test {
protected:
    /// @return the error of a file with this text, without its path; empty for none
    std::string error_of(const std::string& text) const {
        std::ofstream(file_) << text;
        try {
            (void)load_statements(file_, {"x.first_s", "x.second_s"});
        } catch (const InputError& error) {
            const std::string what = error.what();
            return what.substr(what.find(".yaml:") + 6);
        }
        return "";
    }
    void TearDown() override { std::filesystem::remove(file_); }

    const std::string good_ = "a:\n  section: I\n  says: so\n  paper: 1\n";
    const std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
};

TEST_F(StatementsFile, IsReadAsItStands) {
    std::ofstream(file_) << good_ + "  evidence: x.first_s\n  basis: as set\n  at_least: 2\n" +
                                "b:\n  section: II\n  says: words\n  paper: [1, 2]\n  note: no\n";
    const auto read = load_statements(file_, {"x.first_s"});
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].claim.id, "a");
    EXPECT_EQ(std::get<double>(read[0].claim.paper), 1.0);
    EXPECT_EQ(read[0].claim.basis, "as set");
    EXPECT_EQ(read[0].accepted.low, 2.0);
    EXPECT_TRUE(std::isinf(read[0].accepted.high));
    EXPECT_EQ(std::get<draw::Range>(read[1].claim.paper).high, 2.0);
    EXPECT_TRUE(read[1].evidence.empty());
}

TEST_F(StatementsFile, StopsAtOnceAtWhatIsNotRight) {
    const std::string rest = "  basis: measured\n  assumes: []\n  accepted: [0, 1]\n";
    EXPECT_EQ(error_of(good_ + "  evidence: x.frist_s\n" + rest),
              "5: a.evidence: \"x.frist_s\" is measured by no part, did you mean x.first_s?");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n" + rest), "");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  accepted: [0, 1]\n"),
              "1: a: basis: is missing");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  basis: by the method\n  at_least: 1\n"),
              "6: a.basis: \"by the method\" is no basis; there are as set, recovered, fitted, by "
              "construction, measured");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  basis: measured\n  at_least: 1\n"),
              "1: a: assumes: is missing");
    EXPECT_EQ(
        error_of(good_ + "  evidence: x.first_s\n  basis: as set\n  assumes: []\n  at_least: 1\n"),
        "7: a.assumes: stands with what is neither fitted nor measured");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  basis: measured\n  assumes: []\n"),
              "1: a: accepted: is missing");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  accepted: [2, 1]\n  basis: as set\n"),
              "6: a.accepted: must begin with its lower end");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  at_least: 1\n" + rest),
              "6: a.at_least: excludes accepted: give one of the two");
    EXPECT_EQ(error_of(good_ + "  accepted: [0, 1]\n  note: none\n"),
              "5: a.accepted: stands without evidence");
    EXPECT_EQ(error_of(good_), "1: a: note: is missing");
    EXPECT_EQ(error_of(good_ + "  notes: none\n"), "5: a.notes: unknown key, did you mean note?");
    EXPECT_THAT(error_of(good_ + "  note: none\n" + good_), testing::StartsWith("6: a: "));
}

TEST_F(StatementsFile, OneEvidenceBearsOutOneStatement) {
    const std::string with = "  evidence: x.first_s\n  basis: as set\n  at_least: 1\n",
                      again = "b:\n  section: I\n  says: so too\n  paper: 1\n";
    EXPECT_EQ(error_of(good_ + with + again + with),
              "8: b: has the evidence of a: same_as is missing");
    EXPECT_EQ(error_of(good_ + with + again + with + "  same_as: a\n"), "");
    EXPECT_EQ(error_of(good_ + with + "  same_as: c\n"), "8: a.same_as: names no statement");
}

/// The file's own rule: what a verdict rests on is said. Each key is one that can be set, and no
/// source gives its value; a range that is not the paper's own is explained.
TEST(Statements, NoteWhatTheyAssume) {
    scenario::Scenario scenario = scenario::load_scenario("perch_concrete");
    std::map<std::string, std::string> sources;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            sources[section.name + "." + std::string(row.name)] = row.source;
        }
    }
    for (const auto& [claim, evidence, accepted, yes_no] : statements()) {
        for (const std::string& key : claim.assumes) {
            ASSERT_TRUE(sources.count(key)) << claim.id << ": " << key;
            EXPECT_FALSE(sources[key].rfind("paper", 0) == 0) << claim.id << ": " << key;
        }
        const draw::Range* range = std::get_if<draw::Range>(&claim.paper);
        const bool its_own =
            yes_no || (range && range->low == accepted.low && range->high == accepted.high);
        if (claim.basis == "measured" && !its_own) {
            EXPECT_THAT(claim.note,
                        testing::AnyOf(testing::HasSubstr("assumed"),
                                       testing::HasSubstr("facts.md"), testing::HasSubstr("95 %")))
                << claim.id << ": where do its bounds come from?";
        }
    }
}

TEST(Counts, HeadlinesAreOfWhatWasMeasuredAlone) {
    using report::Verdict;
    const auto claim = [](const char* basis, Verdict verdict, const char* same_as = "") {
        return report::Claim{.verdict = verdict, .basis = basis, .same_as = same_as};
    };
    const Evidence counts = counted(
        {claim("measured", Verdict::reproduced), claim("measured", Verdict::reproduced, "other"),
         claim("measured", Verdict::differs), claim("by construction", Verdict::reproduced),
         claim("measured", Verdict::hangs_on_assumptions),
         claim("fitted", Verdict::hangs_on_assumptions), claim("fitted", Verdict::differs),
         claim("", Verdict::not_modelled)});
    EXPECT_EQ(counts.get("statements.measured"), 1.0);
    EXPECT_EQ(counts.get("statements.measured_differs"), 1.0);
    EXPECT_EQ(counts.get("statements.by_construction"), 1.0);
    EXPECT_EQ(counts.get("statements.fitted"), 0.0);
    EXPECT_EQ(counts.get("statements.others_differ"), 1.0);
    EXPECT_EQ(counts.get("statements.hang_on_assumptions"), 2.0);
    EXPECT_EQ(counts.get("statements.said_twice"), 1.0);
    EXPECT_EQ(counts.get("statements.not_modelled"), 1.0);
}

TEST(Hanging, NamesTheStatementsOfEachTurn) {
    const auto claim = [](const char* id, std::vector<std::string> hangs_on) {
        return report::Claim{.id = id, .hangs_on = std::move(hangs_on)};
    };
    const auto all =
        hanging({claim("a", {"`x` 20 % less: 1"}),
                 claim("b", {"`y` 20 % more: no", "`x` 20 % less: 2"}), claim("c", {})});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].first, "`x` 20 % less");
    EXPECT_EQ(all[0].second, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(all[1].second, std::vector<std::string>{"b"});
}

TEST(PageText, IsThatOfTheParts) {
    const PageText text = load_page_text(page_text_file(), parts());
    EXPECT_EQ(text.blocks.size(), parts().size());
    EXPECT_EQ(text.summary.size(), 3U);
}

TEST(PageText, PutsNumbersInTheirPlaces) {
    const auto number = [](const std::string& name) { return name == "x.first_s" ? 1.25 : 3.0; };
    EXPECT_EQ(filled("a {x.first_s:.1f} b {y:.0f}, c", number), "a 1.2 b 3, c");
    EXPECT_EQ(filled("nothing", number), "nothing");
    EXPECT_THROW((void)filled("a {y:.0f} b {y", number), std::exception);
}

/// Of a part that measures x.first_s and shows the table t and the figure f.
class PageTextFile : public testing::Test {
protected:
    std::string error_of(const std::string& blocks) const {
        std::ofstream(file_) << "title: a\nsubtitle: b\nsummary: [c]\npart:\n" + blocks;
        try {
            (void)load_page_text(file_, {{"part", "Part", nullptr, {"x.first_s"}, {"t", "f"}}});
        } catch (const InputError& error) {
            const std::string what = error.what();
            return what.substr(what.find(".yaml:") + 6);
        }
        return "";
    }
    void TearDown() override { std::filesystem::remove(file_); }

    const std::string good_ =
        "  t: {title: table, columns: [a, b]}\n  f: {title: figure, alt: what it shows}\n";
    const std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
};

TEST_F(PageTextFile, StopsAtOnceAtWhatIsNotRight) {
    EXPECT_EQ(error_of(good_ + "  p: so many {x.first_s:.1f}\n"), "");
    EXPECT_EQ(error_of(good_ + "  p: so many {x.frist_s:.1f}\n"),
              "7: part.p: \"x.frist_s\" is measured by no part, did you mean x.first_s?");
    EXPECT_THAT(error_of(good_ + "  p: so many {x.first_s:.1q}\n"),
                testing::StartsWith("7: part.p: has a format that is none: "));
    EXPECT_THAT(error_of(good_ + "  p: so many {x.first_s:.1f\n"),
                testing::StartsWith("7: part.p: has a format that is none: "));
    EXPECT_THAT(error_of("  t: {title: a, columns: [b], caption: '{x.frist_s:.1f}'}\n"
                         "  f: {title: figure, alt: what it shows}\n"),
                testing::StartsWith("5: part.t.caption: \"x.frist_s\" is measured by no part"));
    EXPECT_EQ(error_of("  t: {title: table, columns: [a, b]}\n"), "4: part: f: is missing");
    EXPECT_THAT(error_of(good_ + "  g: {title: figure, alt: what}\n"),
                testing::StartsWith("7: part.g: \"g\" is shown by no part"));
    EXPECT_EQ(error_of("  t: {title: table, columns: a}\n  f: {title: f, alt: a}\n"),
              "5: part.t.columns: must be a list of texts");
    EXPECT_EQ(error_of("  t: {title: table, columns: [a]}\n  f: {title: f}\n"),
              "6: part.f: alt: is missing");
}

}  // namespace
}  // namespace limpet::paper
