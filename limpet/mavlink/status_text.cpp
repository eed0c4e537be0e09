// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/status_text.hpp"

#include <utility>

namespace limpet::mavlink {
namespace {

constexpr int kMostChunks = 20;

std::string fit_to_print(std::string_view text) {
    std::string out(text.substr(0, text.find_last_not_of(" \t\r\n") + 1));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return out;
}

}  // namespace

void RecentWarnings::add(std::uint8_t severity, const std::string& text) {
    constexpr std::size_t kMost = 3;
    if (severity > MavSeverity::warning) {
        return;
    }
    texts_.erase(std::remove(texts_.begin(), texts_.end(), text), texts_.end());
    texts_.push_back(text);
    if (texts_.size() > kMost) {
        texts_.erase(texts_.begin());
    }
}

std::optional<std::string> TextJoiner::give_up() {
    id_ = 0;
    next_chunk_ = 0;
    const std::string text = std::exchange(text_, {});
    return text.empty() ? std::nullopt : std::optional(fit_to_print(text) + "...");
}

std::optional<std::string> TextJoiner::hear(const StatusText& message) {
    const std::string_view piece = text_of(message.text);
    if (message.id == 0) {
        return fit_to_print(piece);
    }
    std::optional<std::string> cut;
    if (message.id != id_ || message.chunk_seq != next_chunk_) {
        cut = give_up();
        if (message.chunk_seq != 0) {
            return cut;  // its beginning is lost
        }
        id_ = message.id;
    }
    text_ += piece;
    ++next_chunk_;
    if (piece.size() < message.text.size() || next_chunk_ == kMostChunks) {
        id_ = 0;
        next_chunk_ = 0;
        return fit_to_print(std::exchange(text_, {}));
    }
    return cut;
}

}  // namespace limpet::mavlink
