// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limpet/px4/autopilot.hpp"
#include "tests/mavlink/scripted_wire.hpp"

namespace limpet::px4 {
namespace {

using testing::HasSubstr;

/// Its checksum is CRC-16/MCRF4XX over all but the first byte, then 50, the extra of HEARTBEAT.
std::vector<std::byte> heartbeat_of_version_1() {
    constexpr std::array<std::uint8_t, 17> kFrame = {0xFE, 9,  0, 1, 1, 0, 0,    0,   0,
                                                     0,    18, 8, 0, 4, 3, 0x8C, 0x11};
    const auto bytes = std::as_bytes(std::span(kFrame));
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
