// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

/// What people type and what their files hold.
namespace limpet {

/// A decimal number, the whole text; nothing where it is none, or not finite.
[[nodiscard]] inline std::optional<double> decimal(const std::string& text) {
    // std::from_chars for doubles came with GCC 11; a stream of the classic locale reads the same.
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    double value = 0.0;
    const bool whole = stream >> value && stream.peek() == std::istringstream::traits_type::eof();
    return whole ? std::optional(value) : std::nullopt;
}

/// The text in quotes, fit for one line of a terminal.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string out = "\"";
    for (const char c : text.substr(0, kLongest)) {
        out += c >= ' ' && c != 127 ? c : '?';
    }
    return out + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace limpet
