// SPDX-License-Identifier: Apache-2.0
// The same of the plugin with ROS at its boundary (adapters/ros/README.md). Nothing here needs a
// master: errors come before one is looked for.
#include <gtest/gtest.h>

#include "served.hpp"

namespace limpet::gazebo11 {

INSTANTIATE_TEST_SUITE_P(
    ByTheRosVehicle, WhatCannotBeUsed,
    ::testing::Values(
        vehicle("UnknownElement", "<cup_by_nod>true</cup_by_nod>",
                "cup_by_nod: unknown key, did you mean cup_by_node?\n", kRosVehicle),
        vehicle("NoFlag", "<cup_by_node>perhaps</cup_by_node>", "cup_by_node: ", kRosVehicle),
        vehicle("OutOfRange", "<offboard_loss_s>0</offboard_loss_s>",
                "offboard_loss_s: 0 is out of range, allowed 0.02..60 s\n", kRosVehicle),
        vehicle("AnotherAutopilot", "<autopilot>px4</autopilot>",
                "autopilot: flies with autopilot builtin only: a PX4 has its MAVROS\n",
                kRosVehicle)),
    WhatCannotBeUsed::name);

}  // namespace limpet::gazebo11
