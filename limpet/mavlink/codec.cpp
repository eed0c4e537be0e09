// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/codec.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "limpet/core/errors.hpp"

namespace limpet::mavlink {

using boost::endian::load_little_u16;

namespace {

/// 0xFE, length, sequence, system, component, id.
constexpr std::size_t kHeader1_bytes = 6;
/// From here on a candidate's flags are there.
constexpr std::size_t kFlags_bytes = 3;
/// A gap of more sequence numbers is a sender that began anew, or datagrams out of order.
constexpr std::uint8_t kLargestGap = 127;

/// CRC-16/MCRF4XX: [k][byte] is what a byte leaves of itself once k more have followed.
constexpr auto kAfter = [] {
    constexpr std::uint32_t kPolynomial = 0x8408;  // 0x1021, its bits in the order of the wire
    std::array<std::array<std::uint16_t, 256>, 8> after{};
    for (std::size_t k = 0; k < after.size(); ++k) {
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t left = byte;
            for (std::size_t bit = 0; bit < 8 * (k + 1); ++bit) {
                left = (left >> 1U) ^ ((left & 1U) != 0 ? kPolynomial : 0U);
            }
            after[k][byte] = static_cast<std::uint16_t>(left);
        }
    }
    return after;
}();

std::uint32_t add_byte(std::uint32_t crc, std::uint8_t byte) {
    return (crc >> 8U) ^ kAfter[0][(crc ^ byte) & 0xFFU];
}

bool is_start(std::uint8_t byte) {
    return byte == kStart1 || byte == kStart2;
}

/// Flags of MAVLink 2 that change a frame in a way that nobody has defined.
bool has_odd_flags(const std::uint8_t* at) {
    return at[0] == kStart2 && (at[2] & ~kSignedFlag) != 0;
}

template <class... Messages>
constexpr auto infos(const std::tuple<Messages...>*) {
    return std::array{Messages::kInfo...};
}

}  // namespace

const MessageInfo* find_message(std::uint32_t id) {
    static constexpr auto kInfos = infos(static_cast<const AllMessages*>(nullptr));
    const auto* at =
        std::lower_bound(kInfos.begin(), kInfos.end(), id,
                         [](const MessageInfo& info, std::uint32_t key) { return info.id < key; });
    return at != kInfos.end() && at->id == id ? at : nullptr;
}

std::uint32_t id_of(const std::uint8_t* at) {
    return at[0] == kStart1 ? at[5] : boost::endian::load_little_u24(at + 7);
}

std::uint16_t frame_checksum(ByteView covered, std::uint8_t crc_extra) {
    std::uint32_t crc = 0xFFFF;
    ByteView rest = covered.subspan(1);
    for (; rest.size() >= kAfter.size(); rest = rest.subspan(kAfter.size())) {
        crc ^= load_little_u16(rest.data());
        crc = kAfter[7][crc & 0xFFU] ^ kAfter[6][crc >> 8U];
        for (std::size_t k = 2; k < kAfter.size(); ++k) {
            crc ^= kAfter[7 - k][rest[k]];
        }
    }
    for (const std::uint8_t byte : rest) {
        crc = add_byte(crc, byte);
    }
    return static_cast<std::uint16_t>(add_byte(crc, crc_extra));
}

ByteView finish_frame(FrameBuffer& out, const MessageInfo& message, Sender& from) {
    std::size_t payload_bytes = message.payload_bytes;
    require(payload_bytes >= 1 && payload_bytes <= 255, "a payload has 1 to 255 bytes");
    while (payload_bytes > 1 && out[kHeader_bytes + payload_bytes - 1] == 0) {
        --payload_bytes;
    }
    out[0] = kStart2;
    out[1] = static_cast<std::uint8_t>(payload_bytes);
    out[2] = 0;
    out[3] = 0;
    out[4] = from.sequence++;
    out[5] = from.system;
    out[6] = from.component;
    boost::endian::store_little_u24(&out[7], message.id);
    const std::size_t covered = kHeader_bytes + payload_bytes;
    boost::endian::store_little_u16(
        &out[covered], frame_checksum(ByteView(out).first(covered), message.crc_extra));
    return ByteView(out).first(covered + kChecksum_bytes);
}

std::optional<Frame> Parser::next(ByteView& bytes) {
    for (;;) {
        if (begin_ == end_) {
            skip_to_start(bytes);
        }
        const std::size_t wanted = wanted_bytes();
        if (end_ - begin_ < wanted) {
            fill(wanted, bytes);
            if (end_ - begin_ < wanted) {
                return std::nullopt;
            }
            continue;  // what came may need more
        }
        if (const auto frame = judge()) {
            return frame;
        }
    }
}

/// @return bytes that the candidate needs before it can be judged, as far as that is known
std::size_t Parser::wanted_bytes() const {
    const std::size_t there = end_ - begin_;
    const std::uint8_t* at = buffer_.data() + begin_;
    if (there == 0 || !is_start(at[0])) {
        return 1;
    }
    if (there < kFlags_bytes || has_odd_flags(at)) {
        return kFlags_bytes;
    }
    const std::size_t header = at[0] == kStart1 ? kHeader1_bytes : kHeader_bytes;
    if (there < header) {
        return header;
    }
    const bool is_known = find_message(id_of(at)) != nullptr;
    return frame_bytes() + (is_known ? 0 : 1);  // the byte behind it vouches for the other
}

/// @return length of the candidate, whose first bytes are there
std::size_t Parser::frame_bytes() const {
    const std::uint8_t* at = buffer_.data() + begin_;
    if (at[0] == kStart1) {
        return kHeader1_bytes + at[1] + kChecksum_bytes;
    }
    const bool is_signed = (at[2] & kSignedFlag) != 0;
    return kHeader_bytes + at[1] + kChecksum_bytes + (is_signed ? kSignature_bytes : 0);
}

/// Reads the header of a candidate that is there whole.
Parser::Candidate Parser::candidate() const {
    const std::uint8_t* at = buffer_.data() + begin_;
    Candidate found;
    found.frame_bytes = frame_bytes();
    const bool is_version_1 = at[0] == kStart1;
    found.header_bytes = is_version_1 ? kHeader1_bytes : kHeader_bytes;
    const std::uint8_t* names = at + (is_version_1 ? 2 : 4);
    found.frame.sequence = names[0];
    found.frame.system = names[1];
    found.frame.component = names[2];
    found.frame.id = id_of(at);
    found.frame.is_signed = !is_version_1 && (at[2] & kSignedFlag) != 0;
    found.frame.payload = ByteView(at + found.header_bytes, at[1]);
    found.frame.bytes = ByteView(at, found.frame_bytes);
    return found;
}

/// Decides on the candidate and drops what it was.
std::optional<Frame> Parser::judge() {
    const std::uint8_t* at = buffer_.data() + begin_;
    if (!is_start(at[0])) {
        discard();
        return std::nullopt;
    }
    if (has_odd_flags(at)) {
        ++statistics_.incompatible;
        discard();
        return std::nullopt;
    }
    const Candidate found = candidate();
    const bool is_version_1 = at[0] == kStart1;
    const MessageInfo* info = find_message(found.frame.id);
    if (info == nullptr) {
        if (!in_step_ || !is_start(at[found.frame_bytes])) {
            discard();
            return std::nullopt;
        }
        ++(is_version_1 ? statistics_.mavlink1 : statistics_.unknown);
        watch_sequence(found.frame, Watch::known_senders);
        drop(found.frame_bytes);
        return std::nullopt;
    }
    const std::size_t covered = found.header_bytes + found.frame.payload.size();
    if (frame_checksum(found.frame.bytes.first(covered), info->crc_extra) !=
        load_little_u16(at + covered)) {
        ++statistics_.bad_checksum;
        discard();
        return std::nullopt;
    }
    in_step_ = true;
    watch_sequence(found.frame, Watch::everybody);
    drop(found.frame_bytes);
    if (is_version_1) {
        ++statistics_.mavlink1;
        return std::nullopt;
    }
    ++statistics_.frames;
    return found.frame;  // dropping moves an index, the bytes stay until the next call
}

/// Takes no byte beyond the candidate, so that one buffer's length is enough.
void Parser::fill(std::size_t wanted, ByteView& bytes) {
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    const std::size_t count = std::min(wanted - end_, bytes.size());
    std::copy_n(bytes.begin(), count, buffer_.begin() + static_cast<std::ptrdiff_t>(end_));
    end_ += count;
    bytes = bytes.subspan(count);
}

/// With nothing in the buffer, garbage need not go through it.
void Parser::skip_to_start(ByteView& bytes) {
    const auto start = std::find_if(bytes.begin(), bytes.end(), is_start);
    const auto count = static_cast<std::size_t>(start - bytes.begin());
    if (count > 0) {
        in_step_ = false;
        statistics_.discarded_bytes += count;
        bytes = bytes.subspan(count);
    }
}

/// The candidate is none: what begins at its second byte is the next one.
void Parser::discard() {
    in_step_ = false;
    ++statistics_.discarded_bytes;
    drop(1);
}

void Parser::drop(std::size_t count) {
    begin_ += count;
}

/// Counts the numbers that are missing. An unknown message counts as well, else each would pass for
/// a loss; but as nothing vouches for it, it makes no new sender.
void Parser::watch_sequence(const Frame& frame, Watch whom) {
    const auto next = static_cast<std::uint8_t>(frame.sequence + 1);
    for (std::size_t i = 0; i < senders_; ++i) {
        Heard& heard = heard_[i];
        if (heard.system == frame.system && heard.component == frame.component) {
            const auto gap = static_cast<std::uint8_t>(frame.sequence - heard.expected);
            statistics_.lost += gap <= kLargestGap ? gap : 0;
            heard.expected = next;
            return;
        }
    }
    if (whom == Watch::known_senders) {
        return;
    }
    Heard& place = senders_ < kMaxSenders ? heard_[senders_++] : heard_[oldest_++ % kMaxSenders];
    place = {frame.system, frame.component, next};
}

}  // namespace limpet::mavlink
