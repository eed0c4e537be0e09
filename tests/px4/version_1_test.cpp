// SPDX-License-Identifier: Apache-2.0
#include "tests/mavlink/version_1.hpp"

#include <gmock/gmock.h>

#include "limpet/px4/autopilot.hpp"
#include "tests/mavlink/scripted_wire.hpp"

namespace limpet::px4 {
namespace {

using testing::HasSubstr;

/// Its frames are whole and skipped: without a word it would seem silent.
TEST(MavlinkVersion1, OnTheSimulatorsLinkIsSaid) {
    mavlink::ScriptedLink wire;
    Px4Autopilot autopilot(wire.link, wire.link, {});
    autopilot.tell({}, {}, 0.0);
    (void)autopilot.command();
    EXPECT_THAT(autopilot.obstacle(), HasSubstr("has not answered HIL_SENSOR"));
    for (int k = 0; k < 3; ++k) {
        wire.ends->to_receive.push_back(mavlink::heartbeat_of_version_1());
    }
    autopilot.tell({}, {}, 0.004);
    (void)autopilot.command();
    EXPECT_THAT(autopilot.obstacle(), HasSubstr("speaks MAVLink 1, which is not read"));
    EXPECT_EQ(wire.link.count().refusals.version_1, 3U);
}

TEST(MavlinkVersion1, OnGuidancesLinkIsSaid) {
    mavlink::ScriptedLink hil, offboard;
    Px4Autopilot autopilot(hil.link, offboard.link, {});
    for (int k = 0; k < 10; ++k) {
        hil.say(mavlink::HilActuatorControls{.time_usec = 1});
        offboard.ends->to_receive.push_back(mavlink::heartbeat_of_version_1());
        autopilot.tell({}, {}, 0.004 * k);
        (void)autopilot.command();
        (void)autopilot.estimate(0.004 * k);
    }
    EXPECT_EQ(hil.link.count().refusals.version_1, 0U);
    EXPECT_EQ(autopilot.obstacle(),
              "the autopilot speaks MAVLink 1, which is not read: MAV_PROTO_VER 2 makes a PX4 "
              "speak MAVLink 2");
}

}  // namespace
}  // namespace limpet::px4
