// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/claims.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace limpet {
namespace {

PaperStatement number(double paper, Range accepted) {
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
        EXPECT_EQ(judge(statement, with(inside)).verdict, Verdict::reproduced) << inside;
    }
    for (const double outside : {0.79, 1.41, -1.0, 1e300}) {
        EXPECT_EQ(judge(statement, with(outside)).verdict, Verdict::differs) << outside;
    }
}

TEST(Judge, WhatDidNotComeToPassDiffers) {
    for (const Evidence& evidence : {with(std::nan("")), Evidence{}}) {
        const Claim claim = judge(number(1.0, {0.8, 1.4}), evidence);
        EXPECT_EQ(claim.verdict, Verdict::differs);
        EXPECT_EQ(to_text(claim.simulated), "did not come to pass");
        EXPECT_FALSE(to_text(claim.difference).empty());
    }
}

TEST(Judge, WithoutEvidenceToLookForItIsNotModelled) {
    PaperStatement statement = number(1.0, {});
    statement.evidence.clear();
    EXPECT_EQ(judge(statement, with(1.0)).verdict, Verdict::not_modelled);
}

TEST(Judge, DifferencesAreSimulatedLessPaper) {
    EXPECT_DOUBLE_EQ(std::get<double>(judge(number(1.0, {0, 2}), with(1.25)).difference), 0.25);
    EXPECT_EQ(std::get<double>(judge(number(12.0, {0, 20}), with(12.0 + 2e-15)).difference), 0.0)
        << "noise of the last digit";
    PaperStatement range = number(0.0, {1.0, 1.2});
    range.paper = Range{1.0, 1.2};
    EXPECT_EQ(std::get<std::string>(judge(range, with(1.1)).difference), "inside");
    EXPECT_NEAR(std::get<double>(judge(range, with(1.5)).difference), 0.3, 1e-6);
    EXPECT_NEAR(std::get<double>(judge(range, with(0.9)).difference), -0.1, 1e-6);
}

TEST(Statements, AreCompleteAndAppearOnce) {
    std::set<std::string> ids;
    for (const PaperStatement& statement : statements()) {
        EXPECT_TRUE(ids.insert(statement.id).second) << statement.id;
        EXPECT_FALSE(statement.section.empty()) << statement.id;
        EXPECT_FALSE(statement.text.empty()) << statement.id;
        EXPECT_FALSE(to_text(statement.paper).empty()) << statement.id;
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

TEST(Statements, HoldTableTwo) {
    int rows = 0;
    for (const PaperStatement& statement : statements()) {
        rows += statement.section == "II-D, Table II" ? 1 : 0;
    }
    EXPECT_EQ(rows, 12);
}

}  // namespace
}  // namespace limpet
