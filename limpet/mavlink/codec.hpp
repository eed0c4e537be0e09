// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <boost/endian/conversion.hpp>
#include <cstddef>
#include <cstdint>
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

/// A frame that arrived whole. `payload` and `bytes` are the parser's, until its next call.
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
/// @param out  holds the whole payload from kHeader_bytes on
/// @return the frame, in `out`; `from.sequence` has gone on by one
/// @throws InternalError for a payload of no or more than 255 bytes
[[nodiscard]] ByteView finish_frame(FrameBuffer& out, const MessageInfo& message, Sender& from);

/// @param at  a header, of either version
/// @return the message's id
[[nodiscard]] std::uint32_t id_of(const std::uint8_t* at);

/// @param covered  header, start byte included, and payload as it is sent
[[nodiscard]] std::uint16_t frame_checksum(ByteView covered, std::uint8_t crc_extra);

/// Frames a message, unsigned.
/// @return the frame's bytes, in `out`; `from.sequence` has gone on by one
template <class Message>
[[nodiscard]] ByteView encode(const Message& message, Sender& from, FrameBuffer& out) {
    std::uint8_t* to = out.data() + kHeader_bytes;
    for_each_field(message, [&](std::string_view, const auto& value) {
        for_each_element(value, [&](auto element) {
            using Element = decltype(element);
            using boost::endian::order;
            boost::endian::endian_store<Element, sizeof(Element), order::little>(to, element);
            to += sizeof(Element);
        });
    });
    return finish_frame(out, Message::kInfo, from);
}

/// What is not in the payload is zero: trailing zeros, and extensions that the sender lacks. What a
/// newer dialect has added at its end is left out.
/// @return nothing when the frame holds another message
template <class Message>
[[nodiscard]] std::optional<Message> decode(const Frame& frame) {
    if (frame.id != Message::kId) {
        return std::nullopt;
    }
    std::array<std::uint8_t, Message::kInfo.payload_bytes> payload = {};
    std::copy_n(frame.payload.begin(), std::min(frame.payload.size(), payload.size()),
                payload.begin());
    Message message;
    const std::uint8_t* at = payload.data();
    for_each_field(message, [&](std::string_view, auto& value) {
        for_each_element(value, [&](auto& element) {
            using Element = std::remove_reference_t<decltype(element)>;
            using boost::endian::order;
            element = boost::endian::endian_load<Element, sizeof(Element), order::little>(at);
            at += sizeof(Element);
        });
    });
    return message;
}

/// Whether a message with a target is for this system and component; 0 is for all.
template <class Message>
[[nodiscard]] bool addressed_to(const Sender& self, const Message& message) {
    return (message.target_system == 0 || message.target_system == self.system) &&
           (message.target_component == 0 || message.target_component == self.component);
}

/// The answer to a command.
/// @param result  MAV_RESULT
/// @param request  the frame that it came in
[[nodiscard]] inline CommandAck acknowledgement(const CommandLong& command, std::uint8_t result,
                                                const Frame& request) {
    return {.command = command.command,
            .result = result,
            .target_system = request.system,
            .target_component = request.component};
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
