// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/signing.hpp"

#include <fmt/format.h>
#include <nettle/memops.h>
#include <nettle/sha2.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::array<Verdict, 5> kRefused = {Verdict::not_signed, Verdict::wrong_signature,
                                             Verdict::replayed, Verdict::too_old,
                                             Verdict::too_many_senders};

struct Words {
    std::string_view what;
    std::string_view cause;  ///< what it takes to be so with a peer that is none of bad will
};

Words words(Verdict verdict) {
    switch (verdict) {
        case Verdict::accepted: break;
        case Verdict::not_signed: return {"not signed", ""};
        case Verdict::wrong_signature: return {"signed with another key", ""};
        case Verdict::replayed: return {"played again", ", or its clock was set back"};
        case Verdict::too_old: return {"over a minute too old", ": its clock is behind our time"};
        case Verdict::too_many_senders: return {"of one sender too many", ""};
    }
    throw InternalError("verdict out of range");
}

std::uint64_t of(const Refusals& refusals, Verdict verdict) {
    return refusals.by_verdict[static_cast<std::size_t>(verdict)];
}

std::uint64_t seconds(std::uint64_t signing_time) {
    return signing_time / kSigningSecond;
}

/// 2015-01-01 00:00 UTC, of which MAVLink counts [us since 1970].
constexpr std::uint64_t kEpoch_us = 1'420'070'400'000'000;
constexpr std::size_t kTimestamp_bytes = 6;
constexpr std::size_t kDigest_bytes = 6;

}  // namespace

std::uint64_t signing_time(std::uint64_t unix_us) {
    return unix_us > kEpoch_us ? (unix_us - kEpoch_us) / 10 : 0;
}

std::uint64_t unix_time_us(std::uint64_t signing_time) {
    return kEpoch_us + 10 * signing_time;
}

std::uint64_t stamp_of(const Frame& frame) {
    return boost::endian::load_little_u48(&frame.bytes.last(kSignature_bytes)[1]);
}

Signing::Signing(const SigningKey& key, std::uint8_t link_id) : key_(key), link_id_(link_id) {}

Signing::Digest Signing::digest(ByteView up_to_timestamp) {
    sha256_ctx sha;
    sha256_init(&sha);
    sha256_update(&sha, key_.size(), key_.data());
    sha256_update(&sha, up_to_timestamp.size(), up_to_timestamp.data());
    Digest first = {};
    sha256_digest(&sha, first.size(), first.data());
    return first;
}

ByteView Signing::sign(FrameBuffer& buffer, ByteView frame, std::uint64_t now) {
    require(frame.data() == buffer.data() && frame.size() > kHeader_bytes + kChecksum_bytes &&
                frame.size() + kSignature_bytes <= buffer.size() && buffer[2] == 0,
            "an unsigned frame of encode is signed");
    const MessageInfo* info = find_message(id_of(buffer.data()));
    require(info != nullptr, "encode knows its messages");

    buffer[2] = kSignedFlag;  // which the checksum covers
    const std::size_t covered = frame.size() - kChecksum_bytes;
    boost::endian::store_little_u16(
        &buffer[covered], frame_checksum(ByteView(buffer).first(covered), info->crc_extra));

    stamps_.timestamp = std::min(std::max(stamps_.timestamp + 1, now), kLargestTimestamp);
    buffer[frame.size()] = link_id_;
    boost::endian::store_little_u48(&buffer[frame.size() + 1], stamps_.timestamp);
    const std::size_t hashed = frame.size() + 1 + kTimestamp_bytes;
    const Digest signature = digest(ByteView(buffer).first(hashed));
    std::copy(signature.begin(), signature.end(), &buffer[hashed]);
    return ByteView(buffer).first(hashed + kDigest_bytes);
}

Signing::Heard* Signing::heard(const Frame& frame) {
    const std::uint8_t link_id = frame.bytes.last(kSignature_bytes)[0];
    const auto known = std::span(stamps_.heard).first(stamps_.senders);
    const auto sender = std::find_if(known.begin(), known.end(), [&](const Heard& heard) {
        return heard.system == frame.system && heard.component == frame.component &&
               heard.link_id == link_id;
    });
    return sender == known.end() ? nullptr : &*sender;
}

Signing::Heard* Signing::free_place(std::uint64_t now) {
    if (stamps_.senders < kMaxSenders) {
        return &stamps_.heard[stamps_.senders];
    }
    const std::uint64_t time = std::max(stamps_.timestamp, now);
    const auto gone = std::find_if(
        stamps_.heard.begin(), stamps_.heard.end(),
        [&](const Heard& heard) { return heard.restored && heard.timestamp + kLargestAge < time; });
    return gone == stamps_.heard.end() ? nullptr : &*gone;
}

void Signing::restore(const SigningStamps& stamps) {
    stamps_ = stamps;
    stamps_.are_last = false;
    for (Heard& heard : stamps_.heard) {
        heard.restored = true;
    }
}

Verdict Signing::judge(const Frame& frame, std::uint64_t now) {
    if (!frame.is_signed) {
        return Verdict::not_signed;
    }
    const std::size_t hashed = frame.bytes.size() - kDigest_bytes;
    const Digest expected = digest(frame.bytes.first(hashed));
    if (memeql_sec(expected.data(), frame.bytes.data() + hashed, kDigest_bytes) == 0) {
        return Verdict::wrong_signature;
    }
    const std::uint64_t stamped = stamp_of(frame);
    const Heard* sender = heard(frame);
    if (sender != nullptr && stamped <= sender->timestamp) {
        return Verdict::replayed;
    }
    const bool is_new = sender == nullptr || sender->restored;
    if (is_new && stamped + kLargestAge < std::max(stamps_.timestamp, now)) {
        return Verdict::too_old;
    }
    return sender == nullptr && free_place(now) == nullptr ? Verdict::too_many_senders
                                                           : Verdict::accepted;
}

Verdict Signing::check(const Frame& frame, std::uint64_t now) {
    const Verdict verdict = judge(frame, now);
    if (verdict == Verdict::accepted) {
        const std::uint64_t stamped = stamp_of(frame);
        Heard* sender = heard(frame);
        if (sender == nullptr) {
            sender = free_place(now);
            stamps_.senders = std::min(stamps_.senders + 1, kMaxSenders);
        }
        *sender = {.system = frame.system,
                   .component = frame.component,
                   .link_id = frame.bytes.last(kSignature_bytes)[0],
                   .restored = false,
                   .timestamp = stamped};
        stamps_.timestamp = std::max(stamps_.timestamp, stamped);
    }
    return verdict;
}

std::uint64_t Refusals::total() const {
    return std::accumulate(by_verdict.begin(), by_verdict.end(), version_1);
}

void Refusals::count(Verdict verdict, const Frame& frame, std::uint64_t time, std::uint64_t now) {
    if (verdict == Verdict::accepted) {
        const std::uint64_t stamp = stamp_of(frame);
        most_ahead = std::max(most_ahead, stamp - std::min(stamp, now));
        return;
    }
    ++by_verdict[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::too_old) {
        most_behind = std::max(most_behind, time - stamp_of(frame));
    }
}

std::string reasons_of(const Refusals& refusals) {
    std::string text;
    for (const Verdict verdict : kRefused) {
        if (of(refusals, verdict) > 0) {
            const auto [what, cause] = words(verdict);
            text += fmt::format("{}{}{}", text.empty() ? "" : "; ", what, cause);
        }
    }
    if (refusals.version_1 > 0) {
        text += fmt::format("{}{}", text.empty() ? "" : "; ", kVersion1);
    }
    return text;
}

std::string text_of(const Refusals& refusals) {
    std::vector<std::string> parts;
    for (const Verdict verdict : kRefused) {
        if (of(refusals, verdict) > 0) {
            parts.push_back(fmt::format("{} {}", of(refusals, verdict), words(verdict).what));
        }
    }
    if (refusals.version_1 > 0) {
        parts.push_back(fmt::format("{} in MAVLink 1", refusals.version_1));
    }
    if (refusals.most_behind > 0) {
        parts.push_back(fmt::format("up to {} s behind our time", seconds(refusals.most_behind)));
    }
    std::string text = parts.empty() ? ""
                                     : fmt::format("{} frames refused: {}", refusals.total(),
                                                   fmt::join(parts, ", "));
    if (refusals.most_ahead > Signing::kLargestAge) {
        text += fmt::format("{}a peer's clock is {} s ahead of ours", text.empty() ? "" : "; ",
                            seconds(refusals.most_ahead));
    }
    return text;
}

}  // namespace limpet::mavlink
