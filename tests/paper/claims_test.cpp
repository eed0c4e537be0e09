// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/paper/paper_tables.hpp"
#include "limpet/paper/reproduce.hpp"

namespace limpet::paper {
namespace {

PaperStatement number(double paper, draw::Range accepted) {
    return {.id = "x",
            .section = "I",
            .text = "x is so much",
            .paper = paper,
            .unit = "s",
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
    range.paper = draw::Range{1.0, 1.2};
    EXPECT_EQ(std::get<std::string>(judge(range, with(1.1)).difference), "inside");
    EXPECT_NEAR(std::get<double>(judge(range, with(1.5)).difference), 0.3, 1e-6);
    EXPECT_NEAR(std::get<double>(judge(range, with(0.9)).difference), -0.1, 1e-6);
}

std::vector<PaperStatement> statements() {
    return load_statements(std::filesystem::path(LIMPET_SOURCE_DIR) / "paper" / "statements.yaml",
                           measured_names());
}

TEST(Statements, AreCompleteAndAppearOnce) {
    std::set<std::string> ids;
    for (const PaperStatement& statement : statements()) {
        EXPECT_TRUE(ids.insert(statement.id).second) << statement.id;
        EXPECT_FALSE(statement.section.empty()) << statement.id;
        EXPECT_FALSE(statement.text.empty()) << statement.id;
        EXPECT_FALSE(report::to_text(statement.paper).empty()) << statement.id;
        EXPECT_LE(statement.accepted.low, statement.accepted.high) << statement.id;
        if (statement.evidence.empty()) {
            EXPECT_FALSE(statement.note.empty()) << statement.id << ": say why not";
        }
    }
}

/// A paper's own number outside of what is accepted as it would be a slip of ours.
TEST(Statements, AcceptThePapersOwnNumbers) {
    for (const PaperStatement& statement : statements()) {
        if (const double* paper = std::get_if<double>(&statement.paper)) {
            EXPECT_GE(*paper, statement.accepted.low) << statement.id;
            EXPECT_LE(*paper, statement.accepted.high) << statement.id;
        }
    }
}

/// The parts put the tables' numbers into pictures and tables of the page.
TEST(Statements, HoldBothTables) {
    std::map<std::string, PaperStatement> by_evidence;
    int rows = 0;
    for (const PaperStatement& statement : statements()) {
        by_evidence[statement.evidence] = statement;
        rows += statement.section == "II-D, Table II" || statement.section == "II-C, Table I";
    }
    EXPECT_EQ(rows, 18);
    const auto expect = [&](const std::string& evidence, double paper, double tolerance) {
        const PaperStatement& statement = by_evidence[evidence];
        ASSERT_TRUE(std::holds_alternative<double>(statement.paper)) << evidence;
        EXPECT_EQ(std::get<double>(statement.paper), paper) << evidence;
        EXPECT_NEAR(statement.accepted.low, paper - tolerance, 1e-9 * paper) << evidence;
        EXPECT_NEAR(statement.accepted.high, paper + tolerance, 1e-9 * paper) << evidence;
    };
    for (const TableOne& column : kTableOne) {
        const std::string key = std::string("rotor.") + column.vehicle;
        for (const auto& [name, paper] :
             {std::pair(".motor_constant_kg_m", column.motor_constant_kg_m),
              std::pair(".moment_constant_m", column.moment_constant_m),
              std::pair(".drag_constant_kg", column.drag_constant_kg)}) {
            expect(key + name, paper, 0.02 * paper);
        }
    }
    for (const TableTwo& column : kTableTwo) {
        const std::string key = column.scenario;
        expect(key + ".vacuum_hPa", column.vacuum_hPa, 10.0);
        expect(key + ".tau_1_s", column.tau_1_s, column.tau_1_tolerance_s);
        expect(key + ".tau_2_s", column.tau_2_s, column.tau_2_tolerance_s);
    }
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
    EXPECT_EQ(read[0].id, "a");
    EXPECT_EQ(std::get<double>(read[0].paper), 1.0);
    EXPECT_EQ(read[0].basis, "as set");
    EXPECT_EQ(read[0].accepted.low, 2.0);
    EXPECT_TRUE(std::isinf(read[0].accepted.high));
    EXPECT_EQ(std::get<draw::Range>(read[1].paper).high, 2.0);
    EXPECT_TRUE(read[1].evidence.empty());
}

TEST_F(StatementsFile, StopsAtOnceAtWhatIsNotRight) {
    const std::string rest = "  basis: measured\n  accepted: [0, 1]\n";
    EXPECT_EQ(error_of(good_ + "  evidence: x.frist_s\n" + rest),
              "5: a.evidence: \"x.frist_s\" is measured by no part, did you mean x.first_s?");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n" + rest), "");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  accepted: [0, 1]\n"),
              "1: a: has no basis");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  basis: measured\n"),
              "1: a: has no accepted");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  accepted: [2, 1]\n  basis: measured\n"),
              "6: a.accepted: must begin with its lower end");
    EXPECT_EQ(error_of(good_ + "  evidence: x.first_s\n  at_least: 1\n" + rest),
              "6: a.at_least: stands beside accepted, one of the two");
    EXPECT_EQ(error_of(good_ + "  accepted: [0, 1]\n  note: none\n"),
              "5: a.accepted: stands without evidence");
    EXPECT_EQ(error_of(good_), "1: a: has no note");
    EXPECT_EQ(error_of(good_ + "  notes: none\n"), "5: a.notes: unknown key, did you mean note?");
    EXPECT_THAT(error_of(good_ + "  note: none\n" + good_), testing::StartsWith("6: a: "));
}

}  // namespace
}  // namespace limpet::paper
