// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

auto entry(const std::string& name, const std::string& description) {
    return ::testing::AllOf(Field(&CatalogueEntry::name, name),
                            Field(&CatalogueEntry::description, description));
}

TEST(Catalogue, ListsWhatThereIsInOrder) {
    const TestData data;
    data.write("scenarios/another.yaml", "description: one more\nmission: hover\n");
    data.write("scenarios/README.md", "not a scenario");
    EXPECT_THAT(list_files(data.root() / "scenarios"),
                ElementsAre(entry("another", "one more"), entry("first", "the first")));
    EXPECT_THAT(list_files(data.root() / "vehicles"), ElementsAre(entry("small", "a small one")));
    EXPECT_THAT(list_surfaces(data.root()),
                ElementsAre(entry("stone", "grey"), entry("glass", "clear")));
}

TEST(Catalogue, ListsABrokenFileWithItsFault) {
    const TestData data;
    const std::string path = data.write("scenarios/broken.yaml", "");
    EXPECT_THAT(list_files(data.root() / "scenarios"),
                ElementsAre(entry("broken", path + ": is empty"), entry("first", "the first")));
}

TEST(Catalogue, RefusesSurfacesThatAreNone) {
    const TestData data;
    const std::string path = data.write("surfaces.yaml", "[stone, glass]\n");
    EXPECT_EQ(error_of([&] { return list_surfaces(data.root()); }),
              path + ": must be a section (key: value), is a list");
}

TEST(Catalogue, FindsNoFolderEmpty) {
    EXPECT_TRUE(list_files("/no/such/folder").empty());
}

TEST(Catalogue, TakesSurfacesByName) {
    const TestData data;
    EXPECT_EQ(load_surface("glass", data.root()).pump_cycles, true);
    EXPECT_EQ(error_of([&] { return load_surface("glas", data.root()); }),
              "\"glas\": no such surface (did you mean glass?); there are stone, glass");
}

TEST(Catalogue, FindsTheSectionsOfAPart) {
    Scenario defaults;
    const auto all = scenario_sections(defaults);
    EXPECT_EQ(sections_of("", all).size(), all.size());
    EXPECT_EQ(sections_of("vehicle", all).size(), 10U);
    const auto slider = sections_of("vehicle.slider", all);
    ASSERT_EQ(slider.size(), 1U);
    EXPECT_EQ(slider[0].rows[0].name, "stiffness_N_m");
    EXPECT_EQ(slider[0].rows[0].value.get(), 500.0);
    ASSERT_EQ(sections_of("guidance", all).size(), 1U);
    EXPECT_EQ(sections_of("guidance", all)[0].rows.size(), guidance::perching_table().size());
    EXPECT_EQ(error_of([&] { return sections_of("guidence", all); }).substr(0, 53),
              "\"guidence\": no such section (did you mean guidance?);");
}

TEST(Catalogue, KnowsTheKeysThatTakeAName) {
    Scenario defaults;
    std::vector<std::string> choices;
    for (const Section& section : scenario_sections(defaults)) {
        for (const Choice& choice : section.choices) {
            EXPECT_EQ(choice.chosen, 0U);
            choices.push_back(section.name + "." + std::string(choice.key) + ": " +
                              choice.names.front().name);
        }
    }
    EXPECT_THAT(choices, ElementsAre("wall.shape: plane", "wall.condition: as_given",
                                     "autopilot.kind: cascade", "autopilot.aiding: motion_capture",
                                     "simulation.engine: reduced"));
}

TEST(DataRoot, IsWhereTheEnvironmentSays) {
    const TestData data;
    ::setenv("LIMPET_DATA", data.root().c_str(), 1);
    EXPECT_EQ(data_root(), data.root());
    ::setenv("LIMPET_DATA", std::filesystem::relative(data.root()).c_str(), 1);
    EXPECT_TRUE(std::filesystem::equivalent(data_root(), data.root()));
    EXPECT_TRUE(data_root().is_absolute());  // wherever what is made of it is looked for
    ::setenv("LIMPET_DATA", "/no/such/folder", 1);
    EXPECT_EQ(error_of([] { return data_root(); }),
              "LIMPET_DATA=/no/such/folder: holds no surfaces.yaml");
    ::unsetenv("LIMPET_DATA");
    EXPECT_EQ(data_root(), std::filesystem::path(LIMPET_SOURCE_DIR "/data"));
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(data.root());  // which holds data, and is not asked
    EXPECT_EQ(data_root(), std::filesystem::path(LIMPET_SOURCE_DIR "/data"));
    std::filesystem::current_path(before);
}

}  // namespace
}  // namespace limpet::scenario
