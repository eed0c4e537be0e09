// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

#include "limpet/mavlink/messages.hpp"

/// MAVLink 2 frames to and from bytes.
///
///   0xFD | length | incompatible flags | compatible flags | sequence | system | component
///        | id (3) | payload (length) | checksum (2) | signature (13, when flagged)
///
/// Integers are little-endian. The checksum covers all after 0xFD, and CRC_EXTRA. A payload's
/// trailing zeros are not sent, its first byte is. Nothing here allocates.
/// Source: MAVLink serialization guide, "MAVLink 2 Packet Format", "Payload Truncation"
namespace limpet::mavlink {

inline constexpr std::uint8_t kStart2 = 0xFD;
inline constexpr std::uint8_t kStart1 = 0xFE;
inline constexpr std::uint8_t kSignedFlag = 0x01;
inline constexpr std::size_t kHeader_bytes = 10;
inline constexpr std::size_t kChecksum_bytes = 2;
inline constexpr std::size_t kSignature_bytes = 13;
inline constexpr std::size_t kLargestFrame_bytes =
    kHeader_bytes + 255 + kChecksum_bytes + kSignature_bytes;

using ByteView = std::span<const std::uint8_t>;
using FrameBuffer = std::array<std::uint8_t, kLargestFrame_bytes>;

/// Who sends, and the number of the next frame.
struct Sender {
    std::uint8_t system = 0;
    std::uint8_t component = 0;
    std::uint8_t sequence = 0;
};

/// A frame that arrived whole. `payload` and `bytes` are the parser's, until it is asked again.
struct Frame {
    std::uint32_t id = 0;
    std::uint8_t system = 0;
    std::uint8_t component = 0;
    std::uint8_t sequence = 0;
    bool is_signed = false;
    ByteView payload;  ///< as it came: without trailing zeros
    ByteView bytes;    ///< all of the frame
};

/// What a receiver has seen. Sums of the whole stream.
struct LinkStatistics {
    std::uint64_t frames = 0;           ///< handed out
    std::uint64_t lost = 0;             ///< sequence numbers left out, also for a while
    std::uint64_t unknown = 0;          ///< messages that Limpet does not speak, skipped
    std::uint64_t mavlink1 = 0;         ///< frames of version 1, skipped
    std::uint64_t bad_checksum = 0;     ///< frames of a known message, or what looked like one
    std::uint64_t incompatible = 0;     ///< beginnings with flags that nobody has defined
    std::uint64_t discarded_bytes = 0;  ///< that belonged to no frame
};

/// Puts header and checksum around a payload.
/// @param out            holds the payload from kHeader_bytes on
/// @param payload_bytes  1..255, trailing zeros included
/// @return the frame, in `out`; `from.sequence` has gone on by one
/// @throws InternalError for a payload of no or too many bytes
[[nodiscard]] ByteView finish_frame(FrameBuffer& out, std::size_t payload_bytes, std::uint32_t id,
                                    std::uint8_t crc_extra, Sender& from);

/// @param covered  header, start byte included, and payload as it is sent
[[nodiscard]] std::uint16_t frame_checksum(ByteView covered, std::uint8_t crc_extra);

namespace detail {

template <std::size_t bytes>
using BitsOf = std::conditional_t<
    bytes == 8, std::uint64_t,
    std::conditional_t<bytes == 4, std::uint32_t,
                       std::conditional_t<bytes == 2, std::uint16_t, std::uint8_t>>>;

/// Bytes of a number, little-endian whatever the machine; floats by their IEEE 754 bits.
template <class T>
void put_element(std::uint8_t* to, T value) {
    BitsOf<sizeof(T)> bits = 0;
    std::memcpy(&bits, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        to[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(bits) >> (8 * i));
    }
}

template <class T>
void get_element(const std::uint8_t* from, T& value) {
    std::uint64_t wide = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        wide |= static_cast<std::uint64_t>(from[i]) << (8 * i);
    }
    const auto bits = static_cast<BitsOf<sizeof(T)>>(wide);
    std::memcpy(&value, &bits, sizeof(T));
}

template <class Value, class Each>
void for_each_element(Value& value, Each&& each) {
    if constexpr (WireType<std::remove_const_t<Value>>::kIsArray) {
        for (auto& element : value) {
            each(element);
        }
    } else {
        each(value);
    }
}

}  // namespace detail

/// Frames a message, unsigned.
/// @return the frame's bytes, in `out`; `from.sequence` has gone on by one
template <class Message>
[[nodiscard]] ByteView encode(const Message& message, Sender& from, FrameBuffer& out) {
    constexpr auto& kPlace = kLayout<Message>;
    std::size_t index = 0;
    for_each_field(message, [&](std::string_view, const auto& value) {
        std::uint8_t* to = out.data() + kHeader_bytes + kPlace.offset[index++];
        detail::for_each_element(value, [&](const auto& element) {
            detail::put_element(to, element);
            to += sizeof(element);
        });
    });
    return finish_frame(out, kPlace.payload_bytes, Message::kId, kPlace.crc_extra, from);
}

/// What is not in the payload is zero: trailing zeros, and extensions that the sender lacks. What a
/// newer dialect has added at its end is left out.
/// @return nothing when the frame holds another message
template <class Message>
[[nodiscard]] std::optional<Message> decode(const Frame& frame) {
    if (frame.id != Message::kId) {
        return std::nullopt;
    }
    std::array<std::uint8_t, kLayout<Message>.payload_bytes> payload = {};
    if (!frame.payload.empty()) {
        std::memcpy(payload.data(), frame.payload.data(),
                    frame.payload.size() < payload.size() ? frame.payload.size() : payload.size());
    }
    Message message;
    std::size_t index = 0;
    for_each_field(message, [&](std::string_view, auto& value) {
        const std::uint8_t* at = payload.data() + kLayout<Message>.offset[index++];
        detail::for_each_element(value, [&](auto& element) {
            detail::get_element(at, element);
            at += sizeof(element);
        });
    });
    return message;
}

/// Bytes in, frames out, whatever the bytes.
///
///   while (const auto frame = parser.next(bytes)) { ... }
///
/// A candidate begins at a start byte. Its checksum decides; where that is wrong, only the start
/// byte is thrown away and the rest is looked through again, so that a frame behind half a frame is
/// found. The checksum of a message that Limpet does not speak cannot be checked: it is skipped
/// whole by its length, but only where it follows upon a frame or begins the stream, and a start
/// byte follows upon it; else it is taken for garbage, which might otherwise swallow a frame.
class Parser {
public:
    /// @param bytes  what has arrived; its front is taken until a frame is whole or none is left
    /// @return a frame with a right checksum, of a message that Limpet speaks; nothing when all of
    ///         `bytes` is taken
    [[nodiscard]] std::optional<Frame> next(ByteView& bytes);

    [[nodiscard]] const LinkStatistics& statistics() const { return statistics_; }

private:
    /// Senders whose sequence numbers are watched; with more, the oldest gives way.
    static constexpr std::size_t kMaxSenders = 16;
    struct Heard {
        std::uint8_t system = 0;
        std::uint8_t component = 0;
        std::uint8_t expected = 0;
    };
    struct Candidate {
        std::size_t header_bytes = 0;
        std::size_t frame_bytes = 0;
        Frame frame;
    };
    enum class Watch {
        everybody,
        known_senders,
    };

    [[nodiscard]] std::size_t wanted_bytes() const;
    [[nodiscard]] std::size_t frame_bytes() const;
    [[nodiscard]] Candidate candidate() const;
    [[nodiscard]] std::optional<Frame> judge();
    void fill(std::size_t wanted, ByteView& bytes);
    void skip_to_start(ByteView& bytes);
    void discard();
    void drop(std::size_t count);
    void watch_sequence(const Frame& frame, Watch whom);

    /// The largest candidate and the byte behind it.
    std::array<std::uint8_t, kLargestFrame_bytes + 1> buffer_ = {};
    std::size_t begin_ = 0;  ///< of the candidate
    std::size_t end_ = 0;    ///< of what is there
    bool in_step_ = true;    ///< the candidate follows upon a frame
    std::array<Heard, kMaxSenders> heard_ = {};
    std::size_t senders_ = 0;
    std::size_t oldest_ = 0;
    LinkStatistics statistics_;
};

}  // namespace limpet::mavlink
