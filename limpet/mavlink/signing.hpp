// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

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
        bool restored = false;        ///< nothing was received from it since
        std::uint64_t timestamp = 0;  ///< of its last frame [10 us]
    };
    std::uint64_t timestamp = 0;  ///< the last time used or seen [10 us]
    std::array<Heard, kMaxSenders> heard = {};
    std::size_t senders = 0;  ///< so many of `heard`
    bool are_last = true;     ///< nothing was used or received after them
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
    /// Space for one more sender, or null. One of before may give way when its frames would be
    /// too old for a new sender: none of them can be played again.
    [[nodiscard]] Heard* free_place(std::uint64_t now);

    SigningKey key_;
    std::uint8_t link_id_;
    SigningStamps stamps_;
};

/// What a peer speaks that is there and seems silent.
inline constexpr std::string_view kVersion1 =
    "MAVLink 1, which is not read: MAV_PROTO_VER 2 makes a PX4 speak MAVLink 2";

/// What a link has refused, and why: a signed one by signatures, each what is MAVLink 1.
struct Refusals {
    std::array<std::uint64_t, 6> by_verdict = {};  ///< frames; of accepted none
    std::uint64_t version_1 = 0;                   ///< frames of MAVLink 1, which is not read
    std::uint64_t most_behind = 0;  ///< the oldest that was too old, behind our time [10 us]
    std::uint64_t most_ahead = 0;   ///< of what was accepted, ahead of our clock [10 us]

    [[nodiscard]] std::uint64_t total() const;
    /// @param time  ours: the later one of the clock and of what was seen or used before [10 us]
    /// @param now   our clock [10 us]
    void count(Verdict verdict, const Frame& frame, std::uint64_t time, std::uint64_t now);
};

/// Why, for people, without numbers that change with every frame: "not signed; played again, or its
/// clock was set back". Empty: nothing was refused.
[[nodiscard]] std::string reasons_of(const Refusals& refusals);

/// All of it: "12 frames refused: 10 not signed, 2 too old (by up to 3712 s)". A clock that is over
/// a minute ahead is stated too. Empty: neither.
[[nodiscard]] std::string text_of(const Refusals& refusals);

}  // namespace limpet::mavlink
