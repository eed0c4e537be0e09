// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/link.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace limpet::mavlink {
namespace {

/// Of what holds no frame, taken in after the time is up: a flood must not stop who listens.
constexpr int kMostPieces = 256;

}  // namespace

Link::Link(std::unique_ptr<wire::Transport> transport, Sender self)
    : transport_(std::move(transport)), self_(self) {}

void Link::sign(LinkSigning signing) {
    seal_->signing.emplace(signing.key, signing.link_id);
    seal_->unix_us = std::move(signing.unix_us);
    seal_->stamps = std::move(signing.stamps);
    if (seal_->stamps) {
        seal_->signing->restore(seal_->stamps->before());
    }
}

Link::Seal::~Seal() {
    if (stamps) {
        stamps->close_with(signing->stamps());
    }
}

bool Link::Seal::accepts(const Frame& frame, bool check) {
    if (!signing) {
        return true;
    }
    const std::uint64_t now = signing_time(unix_us());
    const std::uint64_t time = std::max(now, signing->timestamp());
    const Verdict verdict = check ? signing->check(frame, now) : signing->judge(frame, now);
    refusals.count(verdict, frame, time, now);
    offer_stamps();
    return verdict == Verdict::accepted;
}

/// Once a second: who keeps them writes more rarely.
void Link::Seal::offer_stamps() {
    if (stamps && signing->timestamp() >= offered + kSigningSecond) {
        offered = signing->timestamp();
        stamps->offer(signing->stamps());
    }
}

void Link::admit_by(std::optional<std::uint32_t> message) {
    transport_->admit([seal = seal_, message](std::span<const std::byte> datagram) {
        ByteView bytes(reinterpret_cast<const std::uint8_t*>(datagram.data()), datagram.size());
        Parser parser;
        while (const auto frame = parser.next(bytes)) {
            if (frame->id == message.value_or(frame->id) && seal->accepts(*frame, false)) {
                return true;
            }
        }
        seal->refusals.version_1 += parser.statistics().mavlink1;  // of no peer
        return false;
    });
}

std::uint64_t Link::generation() const {
    const wire::TransportStatistics& seen = transport_->statistics();
    return seen.peers + seen.peers_lost;
}

wire::TransferStatus Link::send_frame(ByteView frame, std::chrono::nanoseconds timeout) {
    if (seal_->signing) {
        frame = seal_->signing->sign(out_, frame, signing_time(seal_->unix_us()));
        seal_->offer_stamps();
    }
    if (!corked_) {
        return send_bytes(frame, 1, timeout);
    }
    if (kept_bytes_ + frame.size() > kept_.size()) {
        const wire::TransferStatus status = uncork(timeout);
        corked_ = true;
        if (status != wire::TransferStatus::done) {
            ++count_.not_sent;
            return status;
        }
    }
    std::copy(frame.begin(), frame.end(), kept_.data() + kept_bytes_);
    kept_bytes_ += frame.size();
    ++kept_messages_;
    return wire::TransferStatus::done;
}

wire::TransferStatus Link::send_bytes(ByteView bytes, std::uint64_t messages,
                                      std::chrono::nanoseconds timeout) {
    const wire::Transfer transfer = transport_->send(std::as_bytes(bytes), timeout);
    (transfer.status == wire::TransferStatus::done ? count_.sent : count_.not_sent) += messages;
    return transfer.status;
}

wire::TransferStatus Link::uncork(std::chrono::nanoseconds timeout) {
    corked_ = false;
    const ByteView bytes(kept_.data(), kept_bytes_);
    const std::uint64_t messages = kept_messages_;
    kept_bytes_ = 0;
    kept_messages_ = 0;
    return messages == 0 ? wire::TransferStatus::done : send_bytes(bytes, messages, timeout);
}

std::optional<Frame> Link::receive(std::chrono::nanoseconds timeout) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + timeout;
    for (int pieces = 0; pieces < kMostPieces || Clock::now() < end;) {
        while (const auto frame = parser_.next(unread_)) {
            if (seal_->accepts(*frame, true)) {
                ++count_.received;
                return frame;
            }
        }
        const wire::Transfer transfer = transport_->receive(
            in_,
            std::max(std::chrono::nanoseconds(0),
                     std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now())));
        if (transfer.status != wire::TransferStatus::done) {
            return std::nullopt;
        }
        if (generation() != heard_generation_) {  // half a frame of the last peer is nobody's
            before_.lost += parser_.statistics().lost;
            before_.bad_checksum += parser_.statistics().bad_checksum;
            before_.mavlink1 += parser_.statistics().mavlink1;
            before_.discarded_bytes += parser_.statistics().discarded_bytes;
            parser_ = Parser();
            heard_generation_ = generation();
        }
        unread_ = {reinterpret_cast<const std::uint8_t*>(in_.data()), transfer.bytes};
        ++pieces;
    }
    return std::nullopt;
}

LinkCount Link::count() const {
    LinkCount count = count_;
    const LinkStatistics& now = parser_.statistics();
    count.lost = before_.lost + now.lost;
    count.damaged = before_.bad_checksum + now.bad_checksum;
    count.discarded_bytes = before_.discarded_bytes + now.discarded_bytes;
    count.refusals = seal_->refusals;
    count.refusals.version_1 += before_.mavlink1 + now.mavlink1;
    return count;
}

std::string Link::trouble_with_stamps() const {
    return seal_->stamps ? seal_->stamps->trouble() : "";
}

}  // namespace limpet::mavlink
