// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace limpet::mavlink {

inline constexpr std::uint16_t kChecksumSeed = 0xFFFF;

/// CRC-16/MCRF4XX (polynomial 0x1021 reflected, no final XOR), a byte further.
/// Source: MAVLink serialization guide, "Checksum"
[[nodiscard]] constexpr std::uint16_t checksum(std::uint16_t crc, std::uint8_t byte) {
    auto mixed = static_cast<std::uint8_t>(byte ^ (crc & 0xFFU));
    mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4U));
    return static_cast<std::uint16_t>((crc >> 8U) ^ (mixed << 8U) ^ (mixed << 3U) ^ (mixed >> 4U));
}

[[nodiscard]] constexpr std::uint16_t checksum(std::uint16_t crc,
                                               std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
        crc = checksum(crc, byte);
    }
    return crc;
}

[[nodiscard]] constexpr std::uint16_t checksum(std::uint16_t crc, std::string_view text) {
    for (const char letter : text) {
        crc = checksum(crc, static_cast<std::uint8_t>(letter));
    }
    return crc;
}

}  // namespace limpet::mavlink
