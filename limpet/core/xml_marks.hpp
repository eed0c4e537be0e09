// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace limpet {

/// How many tags and attributes an XML has at most: a parser takes a hundred bytes for each, so
/// that a text of `<a>` alone is thirty times as large in memory. Asked before it is parsed.
[[nodiscard]] inline std::size_t xml_marks(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }));
}

}  // namespace limpet
