// SPDX-License-Identifier: Apache-2.0
#include "ros/src/setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::ros {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(NodeSetup, SettingsAreCutAtSemicolons) {
    EXPECT_THAT(split_settings(" a=1; b=x y ;;c=3;"), ElementsAre("a=1", "b=x y", "c=3"));
    EXPECT_THAT(split_settings(" ; "), IsEmpty());
}

TEST(NodeSetup, GuidanceIsThatOfTheScenario) {
    const NodeSetup setup = load_setup({.scenario = "perch_metal_valve",
                                        .vehicle = "",
                                        .surface = "",
                                        .mission = "",
                                        .set = {"guidance.hold_s=0.7", "limits.late_limit_s=0.8"},
                                        .seed = {}});
    const scenario::Scenario scenario = scenario::load_scenario("perch_metal_valve");
    EXPECT_EQ(setup.scenario.guidance.hover_thrust, scenario.guidance.hover_thrust);
    EXPECT_EQ(setup.scenario.guidance.valve_fitted, true);
    EXPECT_EQ(setup.scenario.guidance.hold_s, 0.7);
    EXPECT_EQ(setup.limits.late_limit_s, 0.8);
    EXPECT_EQ(setup.scenario.wall.surface.name, scenario.wall.surface.name);
}

TEST(NodeSetup, WithoutAScenarioVehicleAndSurfaceDo) {
    const NodeSetup setup = load_setup({.scenario = "",
                                        .vehicle = "perching_uav",
                                        .surface = "metal",
                                        .mission = "perch_and_take_off",
                                        .set = {},
                                        .seed = 7});
    EXPECT_EQ(setup.scenario.wall.surface.name, "metal");
    EXPECT_EQ(setup.scenario.mission, scenario::Mission::perch_and_take_off);
    EXPECT_EQ(setup.scenario.seed, 7U);
}

std::string complaint(const SetupArguments& arguments) {
    try {
        (void)load_setup(arguments);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(NodeSetup, WhatIsWrongIsNamed) {
    SetupArguments arguments;
    arguments.surface = "jelly";
    EXPECT_THAT(complaint(arguments), HasSubstr("jelly"));
    arguments = {};
    arguments.set = {"guidance.hold_seconds=1"};
    EXPECT_THAT(complaint(arguments), HasSubstr("hold_seconds"));
    arguments.set = {"limits.late_limit_s=-1"};
    EXPECT_THAT(complaint(arguments), HasSubstr("late_limit_s"));
    arguments.set = {"limits.nothing=1"};
    EXPECT_THAT(complaint(arguments), HasSubstr("nothing"));
}

}  // namespace
}  // namespace limpet::ros
