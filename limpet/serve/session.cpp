// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/session.hpp"

#include <cstring>
#include <utility>

namespace limpet::serve {
namespace {

struct FrameHead {
    std::uint32_t bytes = 0;
    FrameQueue::Kind kind = FrameQueue::Kind::stream;
};

}  // namespace

FrameQueue::FrameQueue(std::size_t most_bytes)
    : most_bytes_(most_bytes), filling_(most_bytes), leaving_(most_bytes) {}

bool FrameQueue::put(Kind kind, std::initializer_list<std::string_view> parts) {
    std::size_t bytes = 0;
    for (const std::string_view part : parts) {
        bytes += part.size();
    }
    const std::lock_guard lock(guards_filling_);
    if (filled_ + sizeof(FrameHead) + bytes > most_bytes_) {
        drop_stream();
    }
    if (filled_ + sizeof(FrameHead) + bytes > most_bytes_) {
        dropped_.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    const FrameHead head = {static_cast<std::uint32_t>(bytes), kind};
    char* to = filling_.data() + filled_;
    std::memcpy(to, &head, sizeof head);
    to += sizeof head;
    for (const std::string_view part : parts) {
        if (!part.empty()) {
            std::memcpy(to, part.data(), part.size());
            to += part.size();
        }
    }
    filled_ += sizeof head + bytes;
    return true;
}

/// What is kept closes up.
void FrameQueue::drop_stream() {
    std::size_t kept = 0;
    std::uint64_t dropped = 0;
    for (std::size_t at = 0; at < filled_;) {
        FrameHead head;
        std::memcpy(&head, filling_.data() + at, sizeof head);
        const std::size_t bytes = sizeof head + head.bytes;
        if (head.kind == Kind::stream) {
            ++dropped;
        } else {
            std::memmove(filling_.data() + kept, filling_.data() + at, bytes);
            kept += bytes;
        }
        at += bytes;
    }
    filled_ = kept;
    dropped_.fetch_add(dropped, std::memory_order_relaxed);
}

bool FrameQueue::next(Frame& frame) {
    if (left_ == to_leave_) {
        left_ = 0;
        const std::lock_guard lock(guards_filling_);
        std::swap(filling_, leaving_);
        to_leave_ = std::exchange(filled_, 0);
    }
    if (to_leave_ == 0) {
        return false;
    }
    FrameHead head;
    std::memcpy(&head, leaving_.data() + left_, sizeof head);
    frame = {head.kind == Kind::text, {leaving_.data() + left_ + sizeof head, head.bytes}};
    left_ += sizeof head + head.bytes;
    return true;
}

bool Session::send_text(std::string_view text) {
    return open_ && queue_.put(FrameQueue::Kind::text, {text});
}

bool Session::send_binary(std::initializer_list<std::string_view> parts) {
    return open_ && queue_.put(FrameQueue::Kind::kept, parts);
}

bool Session::stream(std::initializer_list<std::string_view> parts) {
    return open_ && queue_.put(FrameQueue::Kind::stream, parts);
}

bool Session::send_large(std::string bytes) {
    if (!open_ || (large_bytes_ > 0 && large_bytes_ + bytes.size() > kMostLarge_bytes)) {
        return false;
    }
    large_bytes_ += bytes.size();
    large_.push_back(std::move(bytes));
    return true;
}

bool Session::next(FrameQueue::Frame& frame) {
    if (queue_.next(frame)) {
        return true;
    }
    if (large_.empty()) {
        return false;
    }
    leaving_ = std::move(large_.front());
    large_.pop_front();
    large_bytes_ -= leaving_.size();
    frame = {false, leaving_};
    return true;
}

}  // namespace limpet::serve
