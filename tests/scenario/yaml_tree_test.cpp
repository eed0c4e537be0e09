// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/yaml_tree.hpp"

#include <gtest/gtest.h>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

std::string parse_error(const std::string& text) {
    return error_of([&] { return parse_yaml(text, "x.yaml"); });
}

TEST(YamlTree, KnowsPathAndPlaceOfEveryNode) {
    const YamlNode root = parse_yaml(
        "# a comment\n"
        "guidance:\n"
        "  hold_s: 0.5\n"
        "rotors:\n"
        "  - {x_m: 1}\n"
        "  - {x_m: 2,\n"
        "     y_m: '3'}\n",
        "x.yaml");
    const YamlNode* hold = root.find("guidance")->find("hold_s");
    ASSERT_NE(hold, nullptr);
    EXPECT_EQ(hold->path, "guidance.hold_s");
    EXPECT_EQ(hold->place, "x.yaml:3");
    EXPECT_EQ(hold->text, "0.5");
    EXPECT_FALSE(hold->quoted);
    const YamlNode& second = root.find("rotors")->children.at(1);
    EXPECT_EQ(second.path, "rotors[1]");
    EXPECT_EQ(second.place, "x.yaml:6");
    EXPECT_EQ(second.find("y_m")->path, "rotors[1].y_m");
    EXPECT_EQ(second.find("y_m")->place, "x.yaml:7");
    EXPECT_TRUE(second.find("y_m")->quoted);
    EXPECT_EQ(root.find("wind"), nullptr);
}

TEST(YamlTree, RefusesWhatMeansSomethingElseThanItSeems) {
    EXPECT_EQ(parse_error("a: 1\nb: {c: 1}\na: 2\n"),
              "x.yaml:3: a: is given twice, first at x.yaml:1");
    EXPECT_EQ(parse_error("b:\n  c: 1\n  c: 1\n"),
              "x.yaml:3: b.c: is given twice, first at x.yaml:2");
    EXPECT_EQ(parse_error("a: 1\n---\nb: 2\n"), "x.yaml:2: holds more than one document");
    EXPECT_EQ(parse_error("a: &one 1\n"), "x.yaml:1: anchors (&name) are not supported");
    EXPECT_EQ(parse_error("a: !!float 1\n"),
              "x.yaml:1: tags (tag:yaml.org,2002:float) are not supported");
    EXPECT_EQ(parse_error("? [1, 2]\n: 3\n"),
              "x.yaml:1: a key must be a plain word, not a list or a section");
    EXPECT_EQ(parse_error("'': 3\n"), "x.yaml:1: a key is empty");
}

TEST(YamlTree, NamesTheLineOfASyntaxError) {
    EXPECT_EQ(parse_error("a: 1\nb: [1, 2\nc: 3\n"),
              "x.yaml:3: is not valid YAML: did not find expected ',' or ']' (column 2)");
    EXPECT_EQ(
        parse_error("a: 1\n b: 2\n"),
        "x.yaml:2: is not valid YAML: mapping values are not allowed in this context (column 3)");
    EXPECT_EQ(parse_error("a: *one\n"), "x.yaml:1: aliases (*name) are not supported");
}

TEST(YamlTree, RefusesWhatHoldsNoYaml) {
    EXPECT_EQ(parse_error(""), "x.yaml: is empty");
    EXPECT_EQ(parse_error("# only a comment\n\n"), "x.yaml: is empty");
    EXPECT_EQ(parse_error(std::string("\x89PNG\x0d\x0a\x1a\x0a\0\0", 10)),
              "x.yaml: is not a text file");
}

TEST(YamlTree, SurvivesAbsurdNesting) {
    EXPECT_NE(parse_error(std::string(100000, '[')), "");
    EXPECT_NE(parse_error("a: " + std::string(5000, '{')), "");
}

TEST(YamlTree, BoundsValuesDepthAndKeys) {
    const auto keys = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) {
            text += "k" + std::to_string(i) + ": 1\n";
        }
        return text;
    };
    EXPECT_EQ(parse_error(keys(40'000)), "");  // a minute, when every key looked at all before it
    EXPECT_EQ(parse_error(keys(50'000)), "x.yaml:50000: more than 50000 values and sections");
    std::string deep;
    for (int i = 0; i < 33; ++i) {
        deep += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
    }
    EXPECT_EQ(parse_error(deep), "x.yaml:33: more than 32 sections and lists within each other");
    EXPECT_EQ(parse_error(std::string(101, 'k') + ": 1\n"),
              "x.yaml:1: a key of 101 characters, allowed 1..100: " + std::string(60, 'k') + "...");
    EXPECT_EQ(parse_error(std::string(1'000'001, ' ')),
              "x.yaml: is larger than 1 MB, which no YAML file of ours is");
}

TEST(YamlTree, RefusesFilesThatAreNone) {
    const TestData data;
    const auto file_error = [](const std::filesystem::path& path) {
        return error_of([&] { return parse_yaml_file(path); });
    };
    EXPECT_EQ(file_error("no_such.yaml"),
              "no_such.yaml: cannot be read: No such file or directory");
    const std::string root = data.root().string();
    EXPECT_EQ(file_error(root + "/vehicles"), root + "/vehicles: is a directory, not a file");
    EXPECT_EQ(file_error(root + "/surfaces.yaml/x.yaml"),
              root + "/surfaces.yaml/x.yaml: cannot be read: Not a directory");
    const std::string large = data.write("large.yaml", std::string(1'000'001, '#'));
    EXPECT_EQ(file_error(large), large + ": is larger than 1 MB, which no YAML file of ours is");
}

TEST(YamlTree, ShowsPathsFromTheWorkingDirectory) {
    const auto here = std::filesystem::current_path();
    EXPECT_EQ(shown_path(here / "scenarios" / "x.yaml"), "scenarios/x.yaml");
    EXPECT_EQ(shown_path("/somewhere/else.yaml"), "/somewhere/else.yaml");
    EXPECT_EQ(shown_path("two\nlines.yaml"), "two lines.yaml");
}

TEST(YamlTree, ShowsAUsersTextOnOneLine) {
    EXPECT_EQ(shown("a\nb\tc"), "a b c");
    EXPECT_EQ(shown(std::string(100, 'x')), std::string(60, 'x') + "...");
    EXPECT_EQ(shown(std::string(59, 'x') + "\xc3\xa4\xc3\xa4"), std::string(59, 'x') + "...");
}

}  // namespace
}  // namespace limpet::scenario
