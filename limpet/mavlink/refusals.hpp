// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "limpet/mavlink/signing.hpp"

namespace limpet::mavlink {

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
/// a minute ahead is said too. Empty: neither.
[[nodiscard]] std::string text_of(const Refusals& refusals);

}  // namespace limpet::mavlink
