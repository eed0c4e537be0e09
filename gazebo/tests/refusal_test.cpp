// SPDX-License-Identifier: Apache-2.0
// What a plugin cannot use, through the real gzserver: one line, exit code 2, never inert.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "press_bench.hpp"
#include "served.hpp"

namespace limpet::gazebo11 {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCup = "libLimpetSuctionCupPlugin.so";
constexpr const char* kVehicle = "libLimpetVehiclePlugin.so";

class WhatCannotBeUsed : public ::testing::TestWithParam<Refused> {};

TEST_P(WhatCannotBeUsed, StopsTheServerWithOneLine) {
    const Ended ended =
        serve(kCup, GetParam().inside, box_model("ball", "3 0 0 0 0 0", "0.1 0.1 0.1", false));
    EXPECT_EQ(ended.code, 2) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
    EXPECT_THAT(ended.text,
                HasSubstr("limpet: model body: LimpetSuctionCupPlugin: " + GetParam().line));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WhatCannotBeUsed,
    ::testing::Values(
        Refused{"NoLink", "", "link: is missing, needed"},
        Refused{"UnknownLink", "<link>hul</link>",
                "link: \"hul\" is not a link of the model, did you mean hull?\n"},
        Refused{"UnknownElement", "<link>hull</link><pumpe>true</pumpe>",
                "pumpe: unknown key, did you mean pump?\n"},
        Refused{"UnknownRow", "<link>hull</link><suction><radius>1</radius></suction>",
                "suction.radius: unknown key, did you mean radius_m?\n"},
        Refused{"OutOfRange", "<link>hull</link><suction><radius_m>-1</radius_m></suction>",
                "suction.radius_m: -1 is out of range, allowed 0.001..1 m\n"},
        Refused{"NoNumber", "<link>hull</link><flatness_m>flat</flatness_m>",
                "flatness_m: must be a number, is \"flat\", allowed 0.0001..0.1 m\n"},
        Refused{"NoPose", "<link>hull</link><lip_pose>0 0 1</lip_pose>",
                "lip_pose: \"0 0 1\" is not a pose, allowed x y z roll pitch yaw [m, rad]\n"},
        Refused{"UnknownSurface", "<link>hull</link><surface>metall</surface>", "surface: "},
        Refused{"UnknownAttachment", "<link>hull</link><attachment>glue</attachment>",
                "attachment: \"glue\" is not an attachment, allowed compliant, fixed, universal\n"},
        Refused{"AbsentTarget", "<link>hull</link><target model='moon'/>",
                "target: model \"moon\" is not in the world\n"},
        Refused{"MovableTarget", "<link>hull</link><target model='ball'/>",
                "target: model \"ball\" is not static, allowed static models\n"},
        Refused{"TargetOfNothing", "<link>hull</link><target surface='metal'/>",
                "target[0]: needs one of model="},
        Refused{"NoValve", "<link>hull</link><valve>true</valve>",
                "valve: open, but no valve is fitted"},
        Refused{"TwoLinks", "<link>hull</link><link>hull</link>",
                "link: stands twice, allowed once\n"}),
    [](const auto& row) { return row.param.name; });

class WhatNoVehicleCanUse : public ::testing::TestWithParam<Refused> {};

TEST_P(WhatNoVehicleCanUse, StopsTheServerWithOneLine) {
    const Ended ended = serve(kVehicle, GetParam().inside);
    EXPECT_EQ(ended.code, 2) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
    EXPECT_THAT(ended.text, HasSubstr("limpet: " + GetParam().line));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WhatNoVehicleCanUse,
    ::testing::Values(
        Refused{"NoScenario", "", "model body: libLimpetVehiclePlugin.so: scenario is missing"},
        Refused{
            "UnknownElement", "<scenario>hover</scenario><speeed>1</speeed>",
            "model body: libLimpetVehiclePlugin.so: speeed: unknown key, did you mean speed?\n"},
        Refused{"UnknownAutopilot", "<scenario>hover</scenario><autopilot>ardu</autopilot>",
                "model body: libLimpetVehiclePlugin.so: autopilot: \"ardu\", allowed builtin or "
                "px4\n"},
        Refused{"TooSlow", "<scenario>hover</scenario><speed>0.001</speed>",
                "model body: libLimpetVehiclePlugin.so: speed: 0.001 is out of range"},
        Refused{"BoardFasterThanItsClock",
                "<scenario>hover</scenario><autopilot>px4</autopilot>"
                "<hil>serial:/dev/null:921600</hil><speed>2</speed>",
                "model body: libLimpetVehiclePlugin.so: speed: 2, allowed 1 with a px4 on a serial "
                "wire\n"},
        Refused{"SimulatorLinkOverUdp",
                "<scenario>hover</scenario><autopilot>px4</autopilot>"
                "<hil>udp:127.0.0.1:4560</hil>",
                "model body: libLimpetVehiclePlugin.so: hil: \"udp:127.0.0.1:4560\", allowed "
                "tcp:HOST:PORT or serial:DEVICE:BAUD\n"},
        Refused{"AnotherBody", "<scenario>hover</scenario>",
                "model \"body\" has no link \"base\", which perching needs\n"}),
    [](const auto& row) { return row.param.name; });

TEST(Gzserver, LoadsTheCupAsALibraryAndRunsIt) {
    // It would serve on: the time limit ends it.
    const Ended ended = serve(kCup, "<link>hull</link><pump>true</pump>", "", "6");
    EXPECT_EQ(ended.text.find("limpet:"), std::string::npos) << ended.text;
    EXPECT_EQ(ended.code, 128 + SIGKILL) << "it came to an end by itself: " << ended.text;
}

}  // namespace
}  // namespace limpet::gazebo11
