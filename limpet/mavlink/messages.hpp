// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/mavlink/message_structs.hpp"

/// The messages that Limpet speaks. A new one: its definition in messages.xml, its row in
/// tests/mavlink/message_table.hpp.
namespace limpet::mavlink {

/// As a HEARTBEAT reports it.
inline constexpr std::uint8_t kMavlinkVersion = 3;

/// @return what is known of a message, nullptr when Limpet does not speak it
[[nodiscard]] const MessageInfo* find_message(std::uint32_t id);

/// @param text  a wire field; shorter texts are filled with NUL, longer ones cut
template <std::size_t n>
void set_text(std::array<char, n>& field, std::string_view text) {
    field.fill('\0');
    text.substr(0, n).copy(field.data(), n);
}

/// @return up to the first NUL or the field's end
template <std::size_t n>
[[nodiscard]] std::string_view text_of(const std::array<char, n>& field) {
    const std::string_view whole(field.data(), n);
    return whole.substr(0, whole.find('\0'));
}

}  // namespace limpet::mavlink
