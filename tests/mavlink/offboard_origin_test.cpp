// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "offboard_peer.hpp"

namespace limpet::mavlink {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// PX4 takes each as another: it must not be said over and over.
TEST(Offboard, GivesAnOriginOnceWhereThereIsNone) {
    Peer had;
    had.run(0.1);
    ASSERT_THAT(had.requests(GpsGlobalOrigin::kId), SizeIs(1)) << "it is asked first";
    had.wire.say(GpsGlobalOrigin{.latitude = 1});
    had.run(10.0);
    EXPECT_EQ(had.origins(), 0U);

    Peer peer;
    peer.run(0.1);
    EXPECT_EQ(peer.origins(), 0U);
    peer.wire.say(CommandAck{.command = MavCmd::request_message, .result = MavResult::denied});
    peer.run(0.1);
    EXPECT_EQ(peer.origins(), 1U) << "it said that it has none";
    peer.wire.say(GpsGlobalOrigin{});
    peer.run(20.0);
    EXPECT_EQ(peer.origins(), 1U);
    EXPECT_THAT(peer.requests(GpsGlobalOrigin::kId), SizeIs(1));
}

TEST(Offboard, GivesAnOriginAgainWhenNothingIsToldOfIt) {
    Peer peer;
    peer.tells_origin = false;
    peer.run(0.9);
    EXPECT_EQ(peer.origins(), 0U) << "an answer may be on its way";
    peer.run(0.3);
    EXPECT_EQ(peer.origins(), 1U);
    peer.run(1.2);
    EXPECT_EQ(peer.origins(), 1U);
    peer.run(0.3);
    EXPECT_EQ(peer.origins(), 2U) << "its estimator may not have run yet";
    peer.run(20.0);
    EXPECT_EQ(peer.origins(), 4U) << "poses go by then, and an origin must not come after them";
}

/// An origin that comes after the poses moves what they gave: by 5,227 km on PX4's main since
/// 2026-06-29.
TEST(Offboard, PosesWaitForTheOriginAndNoOriginComesAfterThem) {
    Peer told;
    told.tells_origin = false;
    EXPECT_TRUE(told.offboard.awaits_origin(0.0)) << "nobody has been heard yet";
    told.run(1.3);
    EXPECT_EQ(told.origins(), 1U);
    EXPECT_TRUE(told.offboard.awaits_origin(told.time_s));
    told.wire.say(GpsGlobalOrigin{});
    told.run(0.1);
    EXPECT_FALSE(told.offboard.awaits_origin(told.time_s));

    Peer mute;
    mute.tells_origin = false;
    mute.run(6.0);
    EXPECT_TRUE(mute.offboard.awaits_origin(mute.time_s));
    mute.run(0.5);
    EXPECT_FALSE(mute.offboard.awaits_origin(mute.time_s)) << "it may have it all the same";

    Peer flies;
    flies.armed = true;
    flies.run(0.1);
    EXPECT_FALSE(flies.offboard.awaits_origin(flies.time_s)) << "who starts in the air gives none";
    EXPECT_EQ(flies.origins(), 0U);

    OffboardOptions by_gps;
    by_gps.sets_origin = false;
    EXPECT_FALSE(Peer(by_gps).offboard.awaits_origin(0.0));
}

/// On the wall, disarmed between two flights, another origin would move the world under it.
TEST(Offboard, GivesNoOriginOnceItHasBeenArmed) {
    Peer peer;
    peer.tells_origin = false;
    peer.run(3.0);
    peer.armed = true;
    peer.run(1.5);
    const std::size_t given = peer.origins();
    peer.armed = false;
    peer.run(12.0);
    EXPECT_EQ(peer.origins(), given);
}

TEST(Offboard, ArmsNothingThatWouldGetNoOriginAnyMore) {
    Peer peer;
    peer.tells_origin = false;
    peer.mode = kMainModeOffboard;
    peer.run(0.9);
    EXPECT_EQ(peer.offboard.state(peer.time_s), OffboardState::engaged);
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), IsEmpty());
    peer.run(0.3);
    EXPECT_EQ(peer.origins(), 1U);
    EXPECT_THAT(peer.commands(MavCmd::component_arm_disarm), IsEmpty());
    peer.wire.say(GpsGlobalOrigin{});
    peer.run(0.5);
    EXPECT_FALSE(peer.commands(MavCmd::component_arm_disarm).empty());

    OffboardOptions by_gps;
    by_gps.sets_origin = false;
    Peer other(by_gps);
    other.mode = kMainModeOffboard;
    other.run(0.9);
    EXPECT_FALSE(other.commands(MavCmd::component_arm_disarm).empty());
    EXPECT_EQ(other.origins(), 0U);
}

}  // namespace
}  // namespace limpet::mavlink
