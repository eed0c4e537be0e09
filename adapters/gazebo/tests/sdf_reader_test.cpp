// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/sdf_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "press_bench.hpp"

namespace limpet::gazebo11 {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const std::string& inside, const SdfReading& reading) {
    try {
        static_cast<void>(sdf_tree(plugin_element(inside), reading));
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(SdfReader, TextSectionsAndAttributesBecomeOneTree) {
    const scenario::YamlNode tree = sdf_tree(
        plugin_element("<scenario> hover </scenario><suction><radius_m>0.03</radius_m></suction>"
                       "<target model='wall' surface='metal'/><empty/>"),
        {.place = "m: P"});
    ASSERT_NE(tree.find("scenario"), nullptr);
    EXPECT_EQ(read_text(*tree.find("scenario")), "hover");
    ASSERT_NE(tree.find("suction"), nullptr);
    EXPECT_EQ(tree.find("suction")->find("radius_m")->path, "suction.radius_m");
    EXPECT_EQ(tree.find("suction")->find("radius_m")->text, "0.03");
    ASSERT_EQ(tree.find("target")->kind, scenario::YamlNode::Kind::map);
    EXPECT_EQ(tree.find("target")->find("surface")->text, "metal");
    EXPECT_EQ(tree.find("empty")->kind, scenario::YamlNode::Kind::null);
    EXPECT_EQ(tree.find("name"), nullptr) << "attributes of <plugin> are Gazebo's";
}

TEST(SdfReader, ListsGatherWhatStandsMoreThanOnce) {
    const SdfReading reading{.place = "m: P", .lists = {"set"}};
    EXPECT_EQ(sdf_tree(plugin_element("<set>a=1</set>"), reading).find("set")->children.size(), 1U);
    const scenario::YamlNode tree =
        sdf_tree(plugin_element("<set>a=1</set><speed>1</speed><set>b=2</set>"), reading);
    ASSERT_EQ(tree.find("set")->children.size(), 2U);
    EXPECT_EQ(tree.find("set")->children[1].text, "b=2");
    EXPECT_EQ(tree.find("set")->children[1].path, "set[1]");
    EXPECT_EQ(refusal_of("<speed>1</speed><speed>2</speed>", reading),
              "m: P: speed: stands twice, allowed once");
}

TEST(SdfReader, TextBesideElementsIsRefused) {
    EXPECT_THAT(refusal_of("<target model='wall'>metal</target>", {.place = "m: P"}),
                HasSubstr("m: P: target: has text \"metal\" with"));
}

TEST(SdfReader, TheEnvironmentOverridesWhatIsNamed) {
    ::setenv("LIMPET_SPEED", "0.5", 1);
    ::setenv("LIMPET_SET", "a=1; b=2;", 1);
    ::setenv("LIMPET_SEED", "", 1);
    const scenario::YamlNode tree =
        sdf_tree(plugin_element("<speed>1</speed><set>c=3</set><seed>4</seed><other/>"),
                 {.place = "m: P", .lists = {"set"}, .from_environment = {"speed", "set", "seed"}});
    EXPECT_EQ(tree.find("speed")->text, "0.5");
    EXPECT_EQ(tree.find("speed")->place, "LIMPET_SPEED");
    ASSERT_EQ(tree.find("set")->children.size(), 2U);
    EXPECT_EQ(tree.find("set")->children[1].text, "b=2");
    EXPECT_EQ(tree.find("seed")->text, "4");
    ::unsetenv("LIMPET_SPEED");
    ::unsetenv("LIMPET_SET");
    ::unsetenv("LIMPET_SEED");
}

TEST(SdfReader, ABrokenPluginEndsTheProcessWithALineAndItsCode) {
    EXPECT_EXIT(run_or_end([] { throw InputError("m: P: key: wrong"); }),
                ::testing::ExitedWithCode(2), "^limpet: m: P: key: wrong\n$");
    EXPECT_EXIT(run_or_end([] { require(false, "never"); }), ::testing::ExitedWithCode(70),
                "never");
}

}  // namespace
}  // namespace limpet::gazebo11
