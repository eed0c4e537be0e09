// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace limpet {

/// What others wrote, fit for one line of a terminal: characters that steer one are blanks. Those
/// of UTF-8 from U+0080 to U+009F do as well: U+009B begins a sequence as ESC [ does.
[[nodiscard]] inline std::string one_line(std::string text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
        };
        if (at(i) < 0x20 || at(i) == 0x7f) {
            text[i] = ' ';
        } else if (at(i) == 0xC2 && at(i + 1) >= 0x80 && at(i + 1) < 0xA0) {
            text.replace(i, 2, "  ");
        }
    }
    return text;
}

}  // namespace limpet
