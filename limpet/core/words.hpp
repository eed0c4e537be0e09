// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <locale.h>  // NOLINT: strtod_l's locale is C's

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

namespace limpet {

/// A text taken apart into words between blanks; knows its line. Ten times as fast as a stream,
/// which a mesh of 100 MB notices. Looks at the text, which outlives it. A byte order mark that the
/// text begins with is passed over.
class Words {
public:
    explicit Words(std::string_view text)
        : text_(text), at_(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0) {}

    /// @return the next word on this line, "" at its end. A backslash at the end of a line joins
    ///         the next to it.
    std::string_view on_line() {
        for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
            if (text_[at_] == '\\' && joint() != text_.npos) {
                at_ = joint();
                ++line_;
                continue;
            }
            if (!is_blank(text_[at_])) {
                return take();
            }
        }
        return {};
    }
    /// To the start of the next line. @return false at the end of the text
    bool next_line() {
        if (line_ == 0) {
            line_ = 1;
            return !text_.empty();
        }
        const std::size_t end = text_.find('\n', at_);
        if (end == text_.npos || end + 1 >= text_.size()) {
            at_ = text_.size();
            return false;
        }
        at_ = end + 1;
        ++line_;
        return true;
    }
    /// @return the next word on whichever line, "" at the end of the text
    std::string_view next() {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '\n') {
                ++line_;
            } else if (!is_blank(text_[at_])) {
                return take();
            }
        }
        return {};
    }
    [[nodiscard]] std::size_t line() const { return line_; }
    /// @return where the line ends, in bytes from the start of the text
    [[nodiscard]] std::size_t end_of_line() const {
        return std::min(text_.find('\n', at_), text_.size());
    }

private:
    static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\n';
    }
    /// @return where the line ends that the backslash here joins to the next, npos where it does
    /// not
    [[nodiscard]] std::size_t joint() const {
        const std::size_t end =
            at_ + 1 < text_.size() && text_[at_ + 1] == '\r' ? at_ + 2 : at_ + 1;
        return end < text_.size() && text_[end] == '\n' ? end : text_.npos;
    }
    std::string_view take() {
        const std::size_t from = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) &&
               (text_[at_] != '\\' || at_ == from || joint() == text_.npos)) {
            ++at_;
        }
        return text_.substr(from, at_ - from);
    }

    std::string_view text_;
    std::size_t at_;
    std::size_t line_ = 0;
};

/// A decimal number, the whole word, in whichever locale the program runs; nothing where it is
/// none.
inline std::optional<double> number_of(std::string_view word) {
    static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
    char text[64];
    if (word.empty() || word.size() >= sizeof text ||
        word.find_first_not_of("0123456789+-.eE") != word.npos) {
        return std::nullopt;
    }
    std::memcpy(text, word.data(), word.size());
    text[word.size()] = '\0';
    char* end = nullptr;
    const double value = strtod_l(text, &end, classic);
    return end == text + word.size() ? std::optional(value) : std::nullopt;
}

/// The same of a whole number.
inline std::optional<long> integer_of(std::string_view word) {
    long value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc() && end == word.data() + word.size() && !word.empty()
               ? std::optional(value)
               : std::nullopt;
}

/// How many tags and attributes an XML has at most: a parser takes a hundred bytes for each, so
/// that a text of `<a>` alone is thirty times as large in memory. Checked before it is parsed.
[[nodiscard]] inline std::size_t xml_marks(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }));
}

}  // namespace limpet
