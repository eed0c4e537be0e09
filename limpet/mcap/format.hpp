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
#include <type_traits>
#include <utility>
#include <vector>

#include "limpet/core/members.hpp"

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

// A struct whose members stand as in its record is both written and read by them.

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

struct Attachment {
    std::string name;  ///< "scenario.yaml"
    std::string media_type;
    std::string text;
    std::uint64_t log_time_ns = 0;
};

/// What stands in an attachment's record ahead of its text; a checksum of both follows.
struct AttachmentHead {
    std::uint64_t log_time_ns = 0;
    std::uint64_t create_time_ns = 0;  ///< 0 is unknown: the wall clock stays out of recordings
    std::string_view name;
    std::string_view media_type;
    std::uint64_t size = 0;  ///< of the text
};

/// What stands in a chunk ahead of its records.
struct ChunkHeader {
    std::uint64_t first_time_ns = 0;
    std::uint64_t last_time_ns = 0;
    std::uint64_t size = 0;  ///< of the records, unpacked
    std::uint32_t crc = 0;   ///< of the records, unpacked; 0: none
    std::string_view compression;
    std::uint64_t stored_size = 0;  ///< of the records, as they follow
};

/// @param bytes  what it covers
/// @param crc    of the bytes before these, to go on; 0 to begin
/// @return CRC-32 (IEEE 802.3) as MCAP and zlib have it
[[nodiscard]] std::uint32_t crc32(ByteView bytes, std::uint32_t crc = 0);

// Appending. A buffer with the capacity it needs is not reallocated.

inline void put(Bytes& out, ByteView raw) {
    out.insert(out.end(), raw.begin(), raw.end());
}

template <std::unsigned_integral Unsigned>
void put(Bytes& out, Unsigned value) {
    std::array<std::uint8_t, sizeof(Unsigned)> raw;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        raw[i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    put(out, ByteView(raw));
}

/// What `content()` appends, behind its length as a `Length`.
template <class Length, class Content>
void put_sized(Bytes& out, const Content& content) {
    const std::size_t start = out.size();
    put(out, Length{0});
    content();
    const auto length = static_cast<Length>(out.size() - start - sizeof(Length));
    for (std::size_t i = 0; i < sizeof(Length); ++i) {
        out[start + i] = static_cast<std::uint8_t>(length >> (8 * i));
    }
}

inline void put(Bytes& out, std::string_view text) {
    put(out, static_cast<std::uint32_t>(text.size()));
    out.insert(out.end(), text.begin(), text.end());
}

inline void put(Bytes& out, const StringMap& map) {
    put_sized<std::uint32_t>(out, [&] {
        for (const auto& [key, value] : map) {
            put(out, key);
            put(out, value);
        }
    });
}

/// What appends by itself.
template <std::invocable Content>
void put(Bytes& /*out*/, const Content& content) {
    content();
}

/// A plain struct's members, in their order.
template <class Struct>
requires std::is_aggregate_v<Struct>
void put(Bytes& out, const Struct& members) {
    with_members(members, [&out](const auto&... member) { (put(out, member), ...); });
}

template <class... Fields>
void put_record(Bytes& out, OpCode opcode, const Fields&... fields) {
    put(out, static_cast<std::uint8_t>(opcode));
    put_sized<std::uint64_t>(out, [&] { (put(out, fields), ...); });
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

    /// The next value, as put() has it; a view of bytes is all that is left.
    template <class Value>
    Value get() {
        Value value{};
        if constexpr (std::unsigned_integral<Value>) {
            const ByteView raw = take(sizeof value);
            for (std::size_t i = 0; i < sizeof value; ++i) {
                value = static_cast<Value>(value | static_cast<std::uint64_t>(raw[i]) << (8 * i));
            }
        } else if constexpr (std::is_same_v<Value, ByteView>) {
            value = take(left());
        } else if constexpr (std::is_same_v<Value, StringMap>) {
            Cursor entries(take(get<std::uint32_t>()));
            while (entries.left() > 0) {
                std::string key = entries.get<std::string>();
                value[std::move(key)] = entries.get<std::string>();
            }
        } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
            value = text(take(get<std::uint32_t>()));
        } else {
            with_members(value, [this](auto&... member) {
                ((member = this->get<std::remove_reference_t<decltype(member)>>()), ...);
            });
        }
        return value;
    }

    [[nodiscard]] static std::string_view text(ByteView bytes) {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

private:
    ByteView bytes_;
};

}  // namespace limpet::mcap
