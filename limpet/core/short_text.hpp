// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace limpet {

/// A text that is part of a state: plain, without heap, whole again in another process. What is
/// longer than its capacity is cut.
class ShortText {
public:
    static constexpr std::size_t kRoom = 120;

    ShortText() = default;
    ShortText(std::string_view text) : size_(std::min(text.size(), kRoom)) {
        std::copy_n(text.begin(), size_, text_.begin());
    }
    ShortText(const char* text) : ShortText(std::string_view(text)) {}

    [[nodiscard]] std::string_view view() const { return {text_.data(), std::min(size_, kRoom)}; }
    operator std::string_view() const { return view(); }

    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        each(self.text_, self.size_);
    }

    /// Found for a ShortText alone: any two strings would convert to one.
    [[nodiscard]] friend bool operator==(const ShortText& text, std::string_view other) {
        return text.view() == other;
    }

private:
    std::array<char, kRoom> text_{};
    std::size_t size_ = 0;
};

}  // namespace limpet
