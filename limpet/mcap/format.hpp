// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The MCAP container, version 0: what writer and reader share. Source: https://mcap.dev/spec.
///
///   magic | header | metadata, attachments, schemas, channels, (chunk, message indexes)... | data
///   end
///         | summary: schemas, channels, statistics, chunk, attachment and metadata indexes
///         | summary offsets | footer | magic
///
/// Everything but the magic is a record: opcode (1 byte), length of its content (8), content.
/// Integers are little-endian; a string is its length (4) and its bytes; an array or map is its
/// length in bytes (4) and its elements.
namespace limpet::mcap {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;
using StringMap = std::map<std::string, std::string>;

inline constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
/// Opcode and length, ahead of every record's content.
inline constexpr std::size_t kRecordHeader_bytes = 9;
/// Channel, sequence, log time and publish time, ahead of a message's data.
inline constexpr std::size_t kMessageHeader_bytes = 22;

enum class OpCode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    attachment = 0x09,
    attachment_index = 0x0A,
    statistics = 0x0B,
    metadata = 0x0C,
    metadata_index = 0x0D,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

struct Schema {
    std::uint16_t id = 0;  ///< 0 is no schema
    std::string name;      ///< "sensor_msgs/msg/Imu"
    std::string encoding;  ///< "ros2msg"
    std::string text;
};

struct Channel {
    std::uint16_t id = 0;
    std::uint16_t schema_id = 0;
    std::string topic;
    std::string message_encoding;  ///< "cdr"
    StringMap metadata;
};

struct Attachment {
    std::string name;  ///< "scenario.yaml"
    std::string media_type;
    std::string text;
    std::uint64_t log_time_ns = 0;
};

struct Metadata {
    std::string name;
    StringMap values;
};

struct Message {
    std::uint16_t channel_id = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_time_ns = 0;
    std::uint64_t publish_time_ns = 0;
    ByteView data;  ///< somebody else's
};

/// @param bytes  what it covers
/// @param crc    of the bytes before these, to go on; 0 to begin
/// @return CRC-32 (IEEE 802.3) as MCAP and zlib have it
[[nodiscard]] std::uint32_t crc32(ByteView bytes, std::uint32_t crc = 0);

// Appending. A buffer with the capacity it needs is not reallocated.

template <std::unsigned_integral Unsigned>
void put(Bytes& out, Unsigned value) {
    std::array<std::uint8_t, sizeof(Unsigned)> raw;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        raw[i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    out.insert(out.end(), raw.begin(), raw.end());
}

inline void put_bytes(Bytes& out, ByteView bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

inline void put_string(Bytes& out, std::string_view text) {
    put(out, static_cast<std::uint32_t>(text.size()));
    out.insert(out.end(), text.begin(), text.end());
}

/// Writes what `content()` appends behind its own length, as a `Length`.
template <class Length, class Content>
void put_sized(Bytes& out, Content&& content) {
    const std::size_t start = out.size();
    put(out, Length{0});
    content();
    const auto length = static_cast<Length>(out.size() - start - sizeof(Length));
    for (std::size_t i = 0; i < sizeof(Length); ++i) {
        out[start + i] = static_cast<std::uint8_t>(length >> (8 * i));
    }
}

template <class Content>
void put_record(Bytes& out, OpCode opcode, Content&& content) {
    put(out, static_cast<std::uint8_t>(opcode));
    put_sized<std::uint64_t>(out, std::forward<Content>(content));
}

inline void put_map(Bytes& out, const StringMap& map) {
    put_sized<std::uint32_t>(out, [&] {
        for (const auto& [key, value] : map) {
            put_string(out, key);
            put_string(out, value);
        }
    });
}

/// A record says more than it holds: the reader turns it into a line of the damage report.
struct Malformed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Takes values off the front of a view; never reads past it.
class Cursor {
public:
    explicit Cursor(ByteView bytes) : bytes_(bytes) {}

    [[nodiscard]] std::size_t left() const { return bytes_.size(); }
    [[nodiscard]] ByteView rest() const { return bytes_; }

    /// @throws Malformed when fewer than `count` bytes are left
    ByteView take(std::uint64_t count) {
        if (count > bytes_.size()) {
            throw Malformed("record that is shorter than it says");
        }
        const ByteView taken = bytes_.first(static_cast<std::size_t>(count));
        bytes_ = bytes_.subspan(taken.size());
        return taken;
    }

    template <std::unsigned_integral Unsigned>
    Unsigned get() {
        const ByteView raw = take(sizeof(Unsigned));
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
            value |= static_cast<std::uint64_t>(raw[i]) << (8 * i);
        }
        return static_cast<Unsigned>(value);
    }

    std::string string() { return text(take(get<std::uint32_t>())); }

    StringMap map() {
        Cursor entries(take(get<std::uint32_t>()));
        StringMap result;
        while (entries.left() > 0) {
            std::string key = entries.string();
            result[std::move(key)] = entries.string();
        }
        return result;
    }

    [[nodiscard]] static std::string text(ByteView bytes) {
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }

private:
    ByteView bytes_;
};

}  // namespace limpet::mcap
