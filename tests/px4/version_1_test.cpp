// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "limpet/px4/autopilot.hpp"
#include "tests/mavlink/scripted_wire.hpp"

namespace limpet::px4 {
namespace {

using testing::HasSubstr;

std::vector<std::byte> heartbeat_of_version_1() {
    mavlink::Bytes frame = {mavlink::kStart1, 9, 0, 1, 1, 0, 0, 0, 0, 0, 18, 8, 0, 4, 3};
    const std::uint16_t crc = mavlink::frame_checksum(frame, 50);
    frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
    const auto bytes = std::as_bytes(std::span(frame));
    return {bytes.begin(), bytes.end()};
}

/// Its frames are whole and skipped: without a word it would seem silent.
TEST(MavlinkVersion1, OnTheSimulatorsLinkIsSaid) {
    mavlink::ScriptedLink wire;
    Px4Autopilot autopilot(wire.link, wire.link, {});
    (void)autopilot.control({}, {}, 0.0);
    EXPECT_THAT(autopilot.obstacle(), HasSubstr("has not answered HIL_SENSOR"));
    for (int k = 0; k < 3; ++k) {
        wire.ends->to_receive.push_back(heartbeat_of_version_1());
    }
    (void)autopilot.control({}, {}, 0.004);
    EXPECT_THAT(autopilot.obstacle(), HasSubstr("speaks MAVLink 1, which is not read"));
    EXPECT_EQ(wire.link.count().mavlink1, 3U);
}

}  // namespace
}  // namespace limpet::px4
