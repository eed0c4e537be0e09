// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Whole frames that were not made here, in hex: system 1, sequence 7. Source: the
/// reference's mavlink_vectors.txt
namespace limpet::mavlink {

struct Vector {
    std::string_view message;
    std::string_view hex;
};

inline constexpr std::array<Vector, 11> kVectors = {{
    {"HEARTBEAT", "fd0900000701bf000000000000001208000403ed74"},
    {"HIL_SENSOR",
     "fd3e00000701c86b000040420f0000000000cdcccc3dcdcc4cbecdcc1cc10ad7233c0ad7a33c8fc2f5bc"
     "3d0a573e0ad7233cf628dc3e00c06e44000000000000f443cdcc3c41ff1b5814"},
    {"HIL_GPS",
     "fd2400000701c871000040420f00000000004c52401c44f41705407207001e00280064003c005000fbff"
     "c114030c7066"},
    {"HIL_ACTUATOR_CONTROLS",
     "fd5100000701015d000040420f000000000001000000000000000000003f0000803e0000403f0000803f"
     "000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
     "000000000000814a4f"},
    {"COMMAND_LONG",
     "fd2000000701bf4c0000000000000098a546000000000000000000000000000000000000000090010101"
     "3d09"},
    {"COMMAND_LONG",
     "fd2000000701bf4c00000000803f0000c0400000000000000000000000000000000000000000b0000101"
     "db43"},
    {"SET_POSITION_TARGET_LOCAL_NED",
     "fd3500000701bf540000d20400000000803f00000040000040c000000000000000000000000000000000"
     "00000000000000000000003f00000000f809010101956b"},
    {"SET_ATTITUDE_TARGET",
     "fd2700000701bf520000d2040000f304353f00000000f304353f00000000000000000000000000000000"
     "9a99993e010107d188"},
    {"VISION_POSITION_ESTIMATE",
     "fd2000000701c566000040420f00000000000000803f00000040000040c0cdcccc3dcdcc4c3e9a99993e"
     "4aa1"},
    {"ODOMETRY",
     "fde900000701c54b010040420f00000000000000803f00000040000040c00000803f0000000000000000"
     "00000000cdcccc3dcdcc4c3e9a99993e0000000000000000000000000000000000000000000000000000"
     "000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
     "000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
     "000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
     "00000000000000000000000000000000000000000000000000000000010c000264cd4b"},
    {"PARAM_SET", "fd1700000701bf17000000000000010146445f4641494c5f5000000000000000062cc2"},
}};

[[nodiscard]] inline std::vector<std::uint8_t> from_hex(std::string_view hex) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        bytes.push_back(
            static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    }
    return bytes;
}

[[nodiscard]] inline std::string to_hex(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    for (const std::uint8_t byte : bytes) {
        hex += kDigits[byte >> 4U];
        hex += kDigits[byte & 15U];
    }
    return hex;
}

}  // namespace limpet::mavlink
