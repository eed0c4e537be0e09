// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "limpet/mavlink/codec.hpp"

/// MAVLink 2 message signing: a frame's origin can be checked, a frame of old cannot be played
/// again. Frames stay readable.
///
///   signed frame: frame with flag 0x01 | link id | timestamp (6) | signature (6)
///   signature:    first 6 bytes of SHA-256(key | frame | link id | timestamp)
///
/// Timestamps count 10 us since 2015-01-01 UTC and rise with every frame. The key is shared
/// beforehand, by other ways.
/// Source: MAVLink message signing guide
namespace limpet::mavlink {

using SigningKey = std::array<std::uint8_t, 32>;

/// @param unix_us  since 1970-01-01 UTC [us]
/// @return signing timestamp [10 us since 2015-01-01 UTC], 0 for times before
[[nodiscard]] std::uint64_t signing_time(std::uint64_t unix_us);
/// The other way [us].
[[nodiscard]] std::uint64_t unix_time_us(std::uint64_t signing_time);
/// @param frame  a signed one
/// @return its signing timestamp [10 us since 2015-01-01 UTC]
[[nodiscard]] std::uint64_t stamp_of(const Frame& frame);

/// One signing time a second.
inline constexpr std::uint64_t kSigningSecond = 100'000;
inline constexpr std::uint64_t kLargestTimestamp = (std::uint64_t{1} << 48U) - 1;

enum class Verdict {
    accepted,
    not_signed,
    wrong_signature,
    replayed,          ///< not after the last frame of its sender on its link
    too_old,           ///< a sender new in this session, more than a minute behind our time
    too_many_senders,  ///< forgetting one would let its frames be played again
};

/// What must outlive a restart, or frames of before can be played again.
struct SigningStamps {
    static constexpr std::size_t kMaxSenders = 16;
    struct Heard {
        std::uint8_t system = 0;
        std::uint8_t component = 0;
        std::uint8_t link_id = 0;
        bool restored = false;        ///< nothing was heard of it since
        std::uint64_t timestamp = 0;  ///< of its last frame [10 us]
    };
    std::uint64_t timestamp = 0;  ///< the last time used or seen [10 us]
    std::array<Heard, kMaxSenders> heard = {};
    std::size_t senders = 0;  ///< so many of `heard`
    bool are_last = true;     ///< nothing was used or heard after them
};

/// One end of a signed link. Time is given by the caller.
class Signing {
public:
    /// A sender that is new may be behind our clock by this [10 us]: a minute.
    static constexpr std::uint64_t kLargestAge = 60 * kSigningSecond;
    static constexpr std::size_t kMaxSenders = SigningStamps::kMaxSenders;

    /// @param link_id  0..255, the same sender's links apart
    Signing(const SigningKey& key, std::uint8_t link_id);

    /// @param buffer  holds a frame that encode has made
    /// @param frame   that frame
    /// @param now     signing time [10 us]; a clock that stands or steps back does no harm
    /// @return the signed frame, in `buffer`
    /// @throws InternalError when `frame` is none of encode's, or is signed already
    [[nodiscard]] ByteView sign(FrameBuffer& buffer, ByteView frame, std::uint64_t now);

    /// Changes what is known of the sender only when it accepts: forgeries cannot lock it out.
    /// @param now  signing time [10 us]
    [[nodiscard]] Verdict check(const Frame& frame, std::uint64_t now);
    /// What check() would say; nothing changes.
    [[nodiscard]] Verdict judge(const Frame& frame, std::uint64_t now);

    /// The last time used or seen [10 us].
    [[nodiscard]] std::uint64_t timestamp() const { return stamps_.timestamp; }
    [[nodiscard]] const SigningStamps& stamps() const { return stamps_; }
    /// Goes on from there: what was sent before that is not signed with, nor taken, again.
    void restore(const SigningStamps& stamps);

private:
    using Digest = std::array<std::uint8_t, 6>;
    using Heard = SigningStamps::Heard;

    [[nodiscard]] Digest digest(ByteView up_to_timestamp);
    /// The last one of a signed frame's sender on its link, or null.
    [[nodiscard]] Heard* heard(const Frame& frame);
    /// Room for one more sender, or null. One of before may give way when its frames would be
    /// too old for a new sender: none of them can be played again.
    [[nodiscard]] Heard* room(std::uint64_t now);

    SigningKey key_;
    std::uint8_t link_id_;
    SigningStamps stamps_;
};

}  // namespace limpet::mavlink
