// SPDX-License-Identifier: Apache-2.0
// The same of the plugin with ROS at its boundary (ros/README.md). Nothing here needs a master:
// what is wrong is said before one is looked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "served.hpp"

namespace limpet::gazebo11 {
namespace {

class WhatNoRosVehicleCanUse : public ::testing::TestWithParam<Refused> {};

TEST_P(WhatNoRosVehicleCanUse, StopsTheServerWithOneLine) {
    const Ended ended =
        serve("libLimpetRosVehiclePlugin.so", "<scenario>hover</scenario>" + GetParam().inside);
    EXPECT_EQ(ended.code, 2) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
    EXPECT_THAT(ended.text,
                ::testing::HasSubstr("limpet: model body: libLimpetRosVehiclePlugin.so: " +
                                     GetParam().line));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WhatNoRosVehicleCanUse,
    ::testing::Values(Refused{"UnknownElement", "<cup_by_nod>true</cup_by_nod>",
                              "cup_by_nod: unknown key, did you mean cup_by_node?\n"},
                      Refused{"NoFlag", "<cup_by_node>perhaps</cup_by_node>", "cup_by_node: "},
                      Refused{"OutOfRange", "<offboard_loss_s>0</offboard_loss_s>",
                              "offboard_loss_s: 0 is out of range, allowed 0.02..60 s\n"},
                      Refused{
                          "AnotherAutopilot", "<autopilot>px4</autopilot>",
                          "autopilot: flies with autopilot builtin only: a PX4 has its MAVROS\n"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace limpet::gazebo11
