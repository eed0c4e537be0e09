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

/// Whether the text is UTF-8, as JSON, XML and recordings need it.
[[nodiscard]] inline bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto at = [&](std::size_t k) {
            return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
        };
        const unsigned first = at(i);
        const std::size_t more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
        const unsigned second = at(i + 1);
        if (more > 0 && (first < 0xC2 || first > 0xF4 ||       // none, or overlong
                         (first == 0xE0 && second < 0xA0) ||   // overlong
                         (first == 0xED && second > 0x9F) ||   // a surrogate
                         (first == 0xF0 && second < 0x90) ||   // overlong
                         (first == 0xF4 && second > 0x8F))) {  // beyond Unicode
            return false;
        }
        for (std::size_t k = 1; k <= more; ++k) {
            if ((at(i + k) & 0xC0U) != 0x80U) {
                return false;
            }
        }
        i += 1 + more;
    }
    return true;
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

/// The text as a double-quoted scalar of YAML, all in one line.
[[nodiscard]] inline std::string in_yaml(std::string_view text) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            out += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
        } else {
            out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
        }
    }
    return out + "\"";
}

/// The text as one word of a command that a shell is given.
[[nodiscard]] inline std::string for_shell(std::string_view text) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=@%+,";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) {
        return std::string(text);
    }
    std::string word = "'";
    for (const char c : text) {
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return word + "'";
}

}  // namespace limpet
