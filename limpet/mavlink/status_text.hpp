// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "limpet/mavlink/messages.hpp"

namespace limpet::mavlink {

/// Texts of one sender, whole again where they came in chunks, and fit for a terminal: what is not
/// printable ASCII becomes `?`, blanks at the end go.
/// Source: common.xml, STATUSTEXT: an id of 0 is a text by itself; else chunks count from 0, and
/// one that its field's NUL ends is the last.
class TextJoiner {
public:
    /// @return a text that is complete; one whose rest never came when the next begins, with "..."
    [[nodiscard]] std::optional<std::string> hear(const StatusText& message);
    /// @return what has come so far of a text in chunks, with "...", if any
    [[nodiscard]] std::optional<std::string> give_up();

private:
    std::string text_;
    std::uint16_t id_ = 0;
    int next_chunk_ = 0;
};

/// The other end: texts of any length, in chunks where they need more than one. Allocates nothing.
class TextSplitter {
public:
    /// @param send  called with each StatusText, in order
    template <class Send>
    void split(std::uint8_t severity, std::string_view text, const Send& send) {
        StatusText message{.severity = severity};
        constexpr std::size_t kChunk = std::tuple_size_v<decltype(message.text)>;
        if (text.size() <= kChunk) {
            set_text(message.text, text);
            send(message);
            return;
        }
        id_ = static_cast<std::uint16_t>(id_ == 65535 ? 1 : id_ + 1);
        message.id = id_;
        // A NUL ends it: a text that fills its last chunk is followed by an empty one.
        for (bool ended = false; !ended; ++message.chunk_seq) {
            ended = text.size() < kChunk;
            set_text(message.text, text.substr(0, kChunk));
            text.remove_prefix(std::min(kChunk, text.size()));
            send(message);
        }
    }

private:
    std::uint16_t id_ = 0;  ///< of the last text in chunks
};

/// The last few different warnings and errors of a sender: the cause of a refusal is often in one
/// before the last ("Preflight Fail: ..." before "Arming denied: ...").
class RecentWarnings {
public:
    void add(std::uint8_t severity, const std::string& text);
    void clear() { texts_.clear(); }
    [[nodiscard]] const std::vector<std::string>& texts() const {
        return texts_;
    }  ///< the last last

private:
    std::vector<std::string> texts_;
};

}  // namespace limpet::mavlink
