// SPDX-License-Identifier: Apache-2.0
#include "ros/src/node_parameters.hpp"

#include <gtest/gtest.h>

namespace limpet::ros {
namespace {

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
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->scenario, "perch_metal");
    EXPECT_EQ(found->vehicle, "perching_uav");
    EXPECT_EQ(found->surface, "metal");
    EXPECT_EQ(found->mission, "perch");
    EXPECT_EQ(found->set, flight().set);
    EXPECT_EQ(found->seed, flight().seed) << "more than a ROS parameter's whole number holds";
}

TEST(WhatAVehicleFlies, NeedsNeitherSettingsNorSeed) {
    SetupArguments bare = flight();
    bare.set.clear();
    bare.seed.reset();
    const auto found = flight_from(flight_value(bare));
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->set.empty());
    EXPECT_FALSE(found->seed.has_value());
}

TEST(WhatAVehicleFlies, IsNotGuessedFromSomethingElse) {
    EXPECT_FALSE(flight_from(XmlRpc::XmlRpcValue(std::string()))) << "perch.launch: not told yet";
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
