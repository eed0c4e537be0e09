// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/lab.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/view.hpp"

namespace limpet::lab {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LabOf : public testing::Test {
protected:
    void SetUp() override {
        if (!report::has_view_page()) {
            GTEST_SKIP() << "built without Node";
        }
        lab_.emplace("hover");
    }
    [[nodiscard]] record::Recording flown(const std::string& request) {
        const std::filesystem::path file = folder_ / "a.mcap";
        std::ofstream(file, std::ios::binary) << lab_->fly(request);
        return record::read_recording(file);
    }
    [[nodiscard]] std::string refusal(const std::string& request) {
        try {
            (void)lab_->fly(request);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    TestFolder folder_;
    std::optional<Lab> lab_;
};

TEST_F(LabOf, KnowsWhatThereIs) {
    const json known = json::parse(lab_->catalogue());
    EXPECT_EQ(known["scenario"], "hover");
    EXPECT_GT(known["scenarios"].size(), 10U);
    EXPECT_EQ(known["surfaces"][0].size(), 2U);
}

TEST_F(LabOf, EveryParameterHasItsRangeAndSource) {
    const json schema = json::parse(lab_->schema(R"({"scenario": "perch_metal"})"));
    EXPECT_EQ(schema["surface"], "metal");
    std::size_t rows = 0;
    for (const json& section : schema["sections"]) {
        for (const json& row : section["rows"]) {
            EXPECT_LE(row["minimum"], row["maximum"]) << row["key"];
            EXPECT_FALSE(row["what"].get<std::string>().empty()) << row["key"];
            EXPECT_FALSE(row["source"].get<std::string>().empty()) << row["key"];
            ++rows;
        }
    }
    EXPECT_GT(rows, 200U);
}

TEST_F(LabOf, FliesWhatIsAskedFor) {
    const record::Recording whole = flown(R"({"set": ["simulation.time_limit_s=2"]})");
    const record::Recording brief =
        flown(R"({"set": ["simulation.time_limit_s=2"], "brief": true})");
    EXPECT_GT(whole.table("/truth/vehicle").time_s.size(), 190U);
    EXPECT_THAT(brief.table("/truth/vehicle").time_s.size(),
                testing::AllOf(testing::Ge(99U), testing::Le(102U)));
    // Where both have a sample it is the same flight's.
    const auto pitch = [](const record::Recording& r, double time_s) {
        const auto series = r.series("/truth/vehicle", "pitch_rad");
        for (std::size_t i = 0; i < series.time_s.size(); ++i) {
            if (std::abs(series.time_s[i] - time_s) < 1e-6) {
                return series.values[i];
            }
        }
        return kNaN;
    };
    EXPECT_EQ(pitch(brief, 1.0), pitch(whole, 1.0));
}

TEST_F(LabOf, WhatCannotBeIsALine) {
    EXPECT_THAT(refusal(R"({"set": ["guidance.rest_s=-1"]})"), HasSubstr("allowed 0..86400 s"));
    EXPECT_THAT(refusal(R"({"scenario": "hovver"})"), HasSubstr("did you mean hover"));
    EXPECT_THAT(refusal(R"({"scenario": "../hover.yaml"})"), HasSubstr("not a path"));
    EXPECT_THAT(refusal("[1]"), HasSubstr("JSON object"));
    EXPECT_THAT(refusal(R"({"set": [1]})"), HasSubstr("list of texts"));
    EXPECT_THROW(Lab("hovver"), InputError);
}

TEST_F(LabOf, SavesAScenarioThatFliesTheSame) {
    const std::string text = lab_->yaml(R"({"set": ["simulation.time_limit_s=3"]})");
    EXPECT_THAT(text, HasSubstr("time_limit_s: 3"));
}

}  // namespace
}  // namespace limpet::lab
