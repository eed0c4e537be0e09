// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace limpet::devices::packets {

using Bytes = std::vector<std::byte>;

/// Bytes of hexadecimal digits; anything else between them is for people.
inline Bytes hex(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    Bytes bytes;
    int high = -1;
    for (const char letter : text) {
        const std::size_t digit = kDigits.find(letter);
        if (digit == std::string_view::npos) {
            continue;
        }
        if (high < 0) {
            high = static_cast<int>(digit);
        } else {
            bytes.push_back(static_cast<std::byte>(16 * high + static_cast<int>(digit)));
            high = -1;
        }
    }
    return bytes;
}

/// A NatNet packet put together by hand, field by field; the encoder has no part in it.
class HandMade {
public:
    template <class T>
    HandMade& put(T value) {
        const auto* from = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), from, from + sizeof(T));
        return *this;
    }
    HandMade& text(std::string_view letters) {
        for (const char letter : letters) {
            put(letter);
        }
        return put('\0');
    }
    HandMade& floats(std::size_t count, float value) {
        for (std::size_t i = 0; i < count; ++i) {
            put(value);
        }
        return *this;
    }
    HandMade& add(const HandMade& other) {
        bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
        return *this;
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

    /// @return all of it behind a header
    [[nodiscard]] Bytes packet(std::uint16_t id) const {
        HandMade whole;
        whole.put(id).put(static_cast<std::uint16_t>(bytes_.size())).add(*this);
        return whole.bytes_;
    }

private:
    Bytes bytes_;
};

}  // namespace limpet::devices::packets
