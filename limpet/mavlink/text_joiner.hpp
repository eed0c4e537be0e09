// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

private:
    /// @return what has come so far of a text in chunks, if any
    [[nodiscard]] std::optional<std::string> give_up();

    std::string text_;
    std::uint16_t id_ = 0;
    int next_chunk_ = 0;
};

}  // namespace limpet::mavlink
