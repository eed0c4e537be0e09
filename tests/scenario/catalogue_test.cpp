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
    EXPECT_THAT(list_scenarios(data.root()),
                ElementsAre(entry("another", "one more"), entry("first", "the first")));
    EXPECT_THAT(list_vehicles(data.root()), ElementsAre(entry("small", "a small one")));
    EXPECT_THAT(list_surfaces(data.root()),
                ElementsAre(entry("stone", "grey"), entry("glass", "clear")));
}

TEST(Catalogue, ListsABrokenFileWithItsFault) {
    const TestData data;
    const std::string path = data.write("scenarios/broken.yaml", "");
    EXPECT_THAT(list_scenarios(data.root()),
                ElementsAre(entry("broken", path + ": is empty"), entry("first", "the first")));
}

TEST(Catalogue, RefusesSurfacesThatAreNone) {
    const TestData data;
    const std::string path = data.write("surfaces.yaml", "[stone, glass]\n");
    EXPECT_EQ(error_of([&] { return list_surfaces(data.root()); }),
              path + ": must be a section (key: value), is a list");
}

TEST(Catalogue, FindsNoFolderEmpty) {
    EXPECT_TRUE(list_scenarios("/no/such/folder").empty());
}

TEST(Catalogue, TakesSurfacesByName) {
    const TestData data;
    EXPECT_EQ(load_surface("glass", data.root()).pump_cycles, true);
    EXPECT_EQ(error_of([&] { return load_surface("glas", data.root()); }),
              "\"glas\": no such surface (did you mean glass?); there are stone, glass");
}

TEST(Catalogue, PrintsTheRowsOfARoom) {
    const auto vehicle = parameters_of("vehicle");
    const auto slider = parameters_of("vehicle.slider");
    EXPECT_GT(vehicle.size(), slider.size());
    ASSERT_FALSE(slider.empty());
    EXPECT_EQ(slider[0].name, "stiffness_N_m");
    EXPECT_EQ(slider[0].default_value, 500.0);
    EXPECT_EQ(parameters_of("guidance").size(), guidance::perching_table().size());
    EXPECT_EQ(error_of([] { return parameters_of("guidence"); }).substr(0, 50),
              "\"guidence\": no such room (did you mean guidance?);");
}

TEST(Catalogue, KnowsTheKeysThatTakeAName) {
    const auto all = choices_of("");
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].section + "." + all[0].key, "wall.shape");
    EXPECT_EQ(all[0].names.front().name, "plane");
    ASSERT_EQ(choices_of("autopilot").size(), 1U);
    EXPECT_EQ(choices_of("autopilot")[0].names.front().name, "cascade");
    ASSERT_EQ(choices_of("simulation").size(), 1U);
    EXPECT_EQ(choices_of("simulation")[0].names.front().name, "mujoco");
    EXPECT_TRUE(choices_of("guidance").empty());
}

TEST(DataRoot, IsWhereTheEnvironmentSays) {
    const TestData data;
    ::setenv("LIMPET_DATA", data.root().c_str(), 1);
    EXPECT_EQ(data_root(), data.root());
    ::setenv("LIMPET_DATA", "/no/such/folder", 1);
    EXPECT_EQ(error_of([] { return data_root(); }),
              "LIMPET_DATA=/no/such/folder: holds no surfaces.yaml");
    ::unsetenv("LIMPET_DATA");
    EXPECT_EQ(data_root(), std::filesystem::path(LIMPET_SOURCE_DIR));
}

}  // namespace
}  // namespace limpet::scenario
