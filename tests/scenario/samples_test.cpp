// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "limpet/scenario/catalogue.hpp"
#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

/// Data of its own, and a working folder beside it.
class Samples : public testing::Test {
protected:
    Samples() {
        data_.write("samples/log.csv", "# a log\n# of ours\nt_s,pressure_Pa\n");
        data_.write("samples/propeller.txt", "RPM CT CP\n");
        data_.write("samples/README.md", "no sample");
        data_.write("elsewhere/samples/own.csv", "mine");
        data_.write("elsewhere/log", "mine");
        data_.write("elsewhere/plain", "mine");
        ::setenv("LIMPET_DATA", data_.root().c_str(), 1);
        fs::current_path(data_.root() / "elsewhere");
    }
    ~Samples() override {
        fs::current_path(was_);
        ::unsetenv("LIMPET_DATA");
    }
    [[nodiscard]] fs::path shipped(const char* name) const {
        return data_.root() / "samples" / name;
    }

    const fs::path was_ = fs::current_path();
    const TestData data_;
};

TEST_F(Samples, AreListedWithTheirFirstLine) {
    const auto all = list_samples(data_.root());
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "log");
    EXPECT_EQ(all[0].description, "a log");
    EXPECT_EQ(list_samples(data_.root(), ".txt").size(), 1U);
    EXPECT_TRUE(list_samples("/no/such/folder").empty());
}

TEST_F(Samples, AreFoundByNameAndAsPagesPrintThem) {
    EXPECT_EQ(find_sample("log", ".csv"), shipped("log.csv")) << "as a scenario's name is";
    EXPECT_EQ(find_sample("samples/log.csv", ".csv"), shipped("log.csv"));
    EXPECT_EQ(find_sample("propeller", {}), shipped("propeller.txt"));
}

TEST_F(Samples, HideNoFileThatThereIs) {
    EXPECT_EQ(find_sample("samples/own.csv", ".csv"), "samples/own.csv");
    EXPECT_EQ(find_sample("plain", ".csv"), "plain");
    EXPECT_EQ(find_sample("/nowhere/log.csv", ".csv"), "/nowhere/log.csv");
    EXPECT_EQ(find_sample("log.csv", ".csv"), "log.csv") << "a file that is not there is told so";
    EXPECT_EQ(find_sample("samples/../log.csv", ".csv"), "samples/../log.csv");
    EXPECT_EQ(error_of([] { return find_sample("lug", ".csv"); }),
              "\"lug\": no such file or sample (did you mean log?); there is log");
    EXPECT_THAT(error_of([] { return find_sample("", ".csv"); }), testing::HasSubstr("no such"));
}

}  // namespace
}  // namespace limpet::scenario
