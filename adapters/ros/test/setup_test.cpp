// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/overrides.hpp"

namespace limpet::ros {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(NodeSetup, SettingsAreCutAtSemicolons) {
    EXPECT_THAT(scenario::split_settings(" a=1; b=x y ;;c=3;"), ElementsAre("a=1", "b=x y", "c=3"));
    EXPECT_THAT(scenario::split_settings(" ; "), IsEmpty());
}

TEST(NodeSetup, GuidanceIsThatOfTheScenario) {
    const NodeSetup setup = load_setup({.scenario = "perch_metal_valve",
                                        .set = {"guidance.hold_s=0.7", "limits.late_limit_s=0.8"}});
    const scenario::Scenario scenario = scenario::load_scenario("perch_metal_valve");
    EXPECT_EQ(setup.scenario.guidance.hover_thrust, scenario.guidance.hover_thrust);
    EXPECT_EQ(setup.scenario.guidance.valve_fitted, true);
    EXPECT_EQ(setup.scenario.guidance.hold_s, 0.7);
    EXPECT_EQ(setup.limits.late_limit_s, 0.8);
    EXPECT_EQ(setup.scenario.wall.surface.name, scenario.wall.surface.name);
}

TEST(NodeSetup, WithoutAScenarioVehicleAndSurfaceDo) {
    const NodeSetup setup = load_setup({.vehicle = "perching_uav",
                                        .surface = "metal",
                                        .mission = "perch_and_take_off",
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
    EXPECT_THAT(complaint({.surface = "jelly"}), HasSubstr("jelly"));
    using Wrong = std::pair<const char*, const char*>;
    for (const auto& [setting, named] :
         {Wrong{"guidance.hold_seconds=1", "hold_seconds"},
          Wrong{"limits.late_limit_s=-1", "late_limit_s"}, Wrong{"limits.nothing=1", "nothing"}}) {
        EXPECT_THAT(complaint({.set = {setting}}), HasSubstr(named));
    }
}

SetupArguments flight() {
    return {.scenario = "perch_metal",
            .vehicle = "perching_uav",
            .surface = "metal",
            .mission = "perch",
            .set = {"guidance.hold_s=0.7", "suction.valve_fitted=1"},
            .seed = 18446744073709551615ULL};
}

TEST(WhatAVehicleFlies, IsReadAsItWasTold) {
    const auto found = flight_from(flight_value(flight()));
    EXPECT_EQ(found, flight()) << "its seed is more than a ROS parameter's whole number holds";
}

TEST(WhatAVehicleFlies, NeedsNeitherSettingsNorSeed) {
    SetupArguments bare = flight();
    bare.set.clear();
    bare.seed.reset();
    EXPECT_EQ(flight_from(flight_value(bare)), bare);
}

TEST(WhatAVehicleFlies, IsNotGuessedFromSomethingElse) {
    EXPECT_FALSE(flight_from(XmlRpc::XmlRpcValue(std::string())))
        << "perch.launch: not published yet";
    XmlRpc::XmlRpcValue value = flight_value(flight());
    value["seed"] = std::string("1x");
    EXPECT_FALSE(flight_from(value));
    value = flight_value(flight());
    value["set"][0] = 1.0;
    EXPECT_FALSE(flight_from(value));
    XmlRpc::XmlRpcValue empty;
    empty["scenario"] = std::string("perch_metal");
    EXPECT_FALSE(flight_from(empty));
}

}  // namespace
}  // namespace limpet::ros
