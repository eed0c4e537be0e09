// SPDX-License-Identifier: Apache-2.0
// What a plugin cannot use, through the real gzserver: one line, exit code 2, never inert.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "served.hpp"

namespace limpet::gazebo11 {

TEST_P(WhatCannotBeUsed, StopsTheServerWithOneLine) {
    const Ended ended = serve(GetParam().library, GetParam().inside);
    EXPECT_EQ(ended.code, 2) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
    EXPECT_THAT(ended.text, ::testing::HasSubstr("limpet: " + GetParam().line));
}

INSTANTIATE_TEST_SUITE_P(
    ByTheCup, WhatCannotBeUsed,
    ::testing::Values(
        Refused{"NoLink", kCup, "", "model body: LimpetSuctionCupPlugin: link: is missing, needed"},
        Refused{"UnknownLink", kCup, "<link>hul</link>",
                "model body: LimpetSuctionCupPlugin: link: \"hul\" is not a link of the model, did "
                "you mean hull?\n"},
        cup("UnknownElement", "<pumpe>true</pumpe>", "pumpe: unknown key, did you mean pump?\n"),
        cup("UnknownRow", "<suction><radius>1</radius></suction>",
            "suction.radius: unknown key, did you mean radius_m?\n"),
        cup("OutOfRange", "<suction><radius_m>-1</radius_m></suction>",
            "suction.radius_m: -1 is out of range, allowed 0.001..1 m\n"),
        cup("NoNumber", "<flatness_m>flat</flatness_m>",
            "flatness_m: must be a number, is \"flat\", allowed 0.0001..0.1 m\n"),
        cup("NoPose", "<lip_pose>0 0 1</lip_pose>",
            "lip_pose: \"0 0 1\" is not a pose, allowed x y z roll pitch yaw [m, rad]\n"),
        cup("UnknownSurface", "<surface>metall</surface>", "surface: "),
        cup("UnknownAttachment", "<attachment>glue</attachment>",
            "attachment: \"glue\" is none of compliant, fixed, universal\n"),
        cup("TargetOfNothing", "<target surface='metal'/>", "target[0]: needs one of model="),
        cup("NoValve", "<valve>true</valve>", "valve: open, but no valve is fitted"),
        cup("TwoLinks", "<link>hull</link>", "link: stands twice, allowed once\n")),
    WhatCannotBeUsed::name);

INSTANTIATE_TEST_SUITE_P(
    ByTheVehicle, WhatCannotBeUsed,
    ::testing::Values(
        Refused{"NoScenario", kVehicle, "",
                "model body: libLimpetVehiclePlugin.so: scenario is missing"},
        vehicle("UnknownElement", "<speeed>1</speeed>",
                "speeed: unknown key, did you mean speed?\n"),
        vehicle("UnknownAutopilot", "<autopilot>ardu</autopilot>",
                "autopilot: \"ardu\" is none of builtin, px4\n"),
        vehicle("TooSlow", "<speed>0.001</speed>", "speed: 0.001 is out of range"),
        vehicle("NoPort", "<live>65536</live>",
                "live: 65536, allowed a port, 0..65535 (0: any that is free)\n"),
        vehicle("BoardFasterThanItsClock",
                "<autopilot>px4</autopilot><hil>serial:/dev/null:921600</hil><speed>2</speed>",
                "speed: 2, allowed 1 with a px4 on a serial wire\n"),
        vehicle("SimulatorLinkOverUdp", "<autopilot>px4</autopilot><hil>udp:127.0.0.1:4560</hil>",
                "hil: \"udp:127.0.0.1:4560\", allowed tcp:HOST:PORT or serial:DEVICE:BAUD\n"),
        Refused{"AnotherBody", kVehicle, "<scenario>hover</scenario>",
                "model \"body\" has no link \"base\", which perching needs\n"}),
    WhatCannotBeUsed::name);

class OfAnotherEngine : public ::testing::TestWithParam<std::string> {};

TEST_P(OfAnotherEngine, ACupSaysInALineWhatToChange) {
    for (const std::string attachment : {"compliant", "fixed"}) {
        const Ended ended = serve(
            kCup, "<link>hull</link><attachment>" + attachment + "</attachment>", "20", GetParam());
        EXPECT_EQ(ended.code, 2) << ended.text;
        EXPECT_THAT(ended.text,
                    ::testing::HasSubstr("limpet: model body: LimpetSuctionCupPlugin: the world's "
                                         "physics is of " +
                                         GetParam() + ", allowed ode"));
    }
}

INSTANTIATE_TEST_SUITE_P(All, OfAnotherEngine, ::testing::Values("bullet", "dart", "simbody"),
                         [](const auto& one) { return one.param; });

TEST(Gzserver, LoadsTheCupAsALibraryAndRunsIt) {
    // It would serve on: the time limit ends it.
    const Ended ended = serve(kCup, "<link>hull</link><pump>true</pump>", "6");
    EXPECT_EQ(ended.text.find("limpet:"), std::string::npos) << ended.text;
    EXPECT_EQ(ended.code, 128 + SIGKILL) << "it came to an end by itself: " << ended.text;
}

}  // namespace limpet::gazebo11
