// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "limpet/core/errors.hpp"

namespace limpet::ros2 {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        const char* const before = std::getenv(name);
        before_ = before != nullptr ? before : "";
        setenv(name, value, 1);
    }
    ~Environment() { setenv(name_, before_.c_str(), 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::string before_;
};

TEST(Ros2Settings, NamesAreThoseOfRos) {
    const NodeSettings settings = read_settings("perching_node", {});
    EXPECT_EQ(settings.resolve("mavros/state"), "/mavros/state");
    EXPECT_EQ(settings.resolve("~/status"), "/perching_node/status");
    EXPECT_EQ(settings.resolve("~status"), "/perching_node/status");
    EXPECT_EQ(settings.resolve("/tf"), "/tf");
}

TEST(Ros2Settings, NodeNamespaceAndTopicsAreRemapped) {
    const NodeSettings settings =
        read_settings("perching_node", {"--ros-args", "-r", "__ns:=/uav1", "-r", "__node:=guide",
                                        "--remap", "mavros/state:=/px4/state"});
    EXPECT_EQ(settings.full_name(), "/uav1/guide");
    EXPECT_EQ(settings.resolve("mavros/state"), "/px4/state");
    EXPECT_EQ(settings.resolve("mavros/battery"), "/uav1/mavros/battery");
    EXPECT_EQ(settings.resolve("~/status"), "/uav1/guide/status");
}

TEST(Ros2Settings, ALaterParameterCounts) {
    const NodeSettings settings =
        read_settings("vehicle_node",
                      {"--ros-args", "-p", "speed:=2", "-p", "speed:=3.5", "-p", "set:=a=1; b=2"});
    ASSERT_EQ(settings.parameters.children.size(), 2U);
    EXPECT_EQ(settings.parameters.find("speed")->text, "3.5");
    EXPECT_EQ(settings.parameters.find("set")->text, "a=1; b=2");
}

TEST(Ros2Settings, WhatIsWrongIsSaidInALine) {
    const auto of = [](std::vector<std::string> arguments) {
        return [arguments] { static_cast<void>(read_settings("node", arguments)); };
    };
    EXPECT_THAT(of({"_speed:=2"}),
                ThrowsMessage<InputError>(HasSubstr("_speed:=2: must be --ros-args")));
    EXPECT_THAT(of({"--ros-args", "-p", "speed=2"}),
                ThrowsMessage<InputError>(HasSubstr("-p speed=2: must be NAME:=VALUE")));
    EXPECT_THAT(of({"--ros-args", "--params-file", "/nowhere.yaml"}),
                ThrowsMessage<InputError>(HasSubstr("/nowhere.yaml")));
    {
        const Environment domain("ROS_DOMAIN_ID", "233");
        EXPECT_THAT(of({}),
                    ThrowsMessage<InputError>(HasSubstr("ROS_DOMAIN_ID=233: must be 0..232")));
    }
    const Environment range("ROS_AUTOMATIC_DISCOVERY_RANGE", "LAN");
    EXPECT_THAT(of({}), ThrowsMessage<InputError>(HasSubstr("must be LOCALHOST, SUBNET, OFF")));
}

TEST(Ros2Settings, OfItselfANodeStaysOnThisMachine) {
    const Environment range("ROS_AUTOMATIC_DISCOVERY_RANGE", "");
    EXPECT_EQ(read_settings("node", {}).range, Range::localhost);
    const Environment wide("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET");
    EXPECT_EQ(read_settings("node", {}).range, Range::subnet);
}

TEST(Ros2Settings, HumblesIdentifiersAreLonger) {
    EXPECT_EQ(read_settings("node", {}).gid_bytes, 16U);
    const Environment distribution("ROS_DISTRO", "humble");
    EXPECT_EQ(read_settings("node", {}).gid_bytes, 24U);
}

}  // namespace
}  // namespace limpet::ros2
