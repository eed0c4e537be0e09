// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace limpet::mavlink {

/// An autopilot's in MAVLink 1. Its checksum is CRC-16/MCRF4XX over all but the first byte, then
/// 50, the extra of HEARTBEAT.
inline std::vector<std::byte> heartbeat_of_version_1() {
    constexpr std::array<std::uint8_t, 17> kFrame = {0xFE, 9,  0, 1, 1, 0, 0,    0,   0,
                                                     0,    18, 8, 0, 4, 3, 0x8C, 0x11};
    const auto bytes = std::as_bytes(std::span(kFrame));
    return {bytes.begin(), bytes.end()};
}

}  // namespace limpet::mavlink
