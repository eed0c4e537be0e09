// SPDX-License-Identifier: Apache-2.0
// Bytes of an MCAP file by hand, for what no writer would write. Little-endian.
#pragma once

#include <cstdint>
#include <string>

namespace limpet::mcap_bytes {

inline std::string number(std::uint64_t value, int bytes) {
    std::string raw;
    for (int i = 0; i < bytes; ++i) {
        raw += static_cast<char>(value >> (8 * i));
    }
    return raw;
}

inline std::string text(const std::string& content) {
    return number(content.size(), 4) + content;
}

inline std::string record(int opcode, const std::string& content) {
    return number(static_cast<std::uint64_t>(opcode), 1) + number(content.size(), 8) + content;
}

/// Schema and channel 1, in ROS 2's form.
inline std::string channel(const std::string& topic, const std::string& type_name,
                           const std::string& definition) {
    return record(3, number(1, 2) + text(type_name) + text("ros2msg") + text(definition)) +
           record(4, number(1, 2) + number(1, 2) + text(topic) + text("cdr") + number(0, 4));
}

/// On channel 1.
inline std::string message(std::uint64_t time_ns, const std::string& cdr) {
    return record(5, number(1, 2) + number(0, 4) + number(time_ns, 8) + number(time_ns, 8) + cdr);
}

inline std::string attachment(const std::string& name, const std::string& content) {
    return record(9, number(0, 8) + number(0, 8) + text(name) + text("text/plain") +
                         number(content.size(), 8) + content + number(0, 4));
}

/// A whole recording of such records.
inline std::string recording(const std::string& records) {
    const std::string magic = "\x89MCAP0\r\n";
    return magic + record(1, text("ros2") + text("x")) + records + record(0x0F, number(0, 4)) +
           record(2, number(0, 8) + number(0, 8) + number(0, 4)) + magic;
}

}  // namespace limpet::mcap_bytes
