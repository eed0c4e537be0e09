// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "limpet/mavlink/codec.hpp"

namespace limpet::mavlink {

/// Calls each(Message{}) for every message.
template <class Each>
void for_each_message(Each&& each) {
    std::apply([&](const auto&... message) { (each(message), ...); }, AllMessages{});
}

enum class Filling {
    lowest,
    highest,
    counted,  ///< every element another value
    odd_floats,
};

/// @param count  of the element in its message
template <class T>
[[nodiscard]] T sample_value(Filling filling, int count) {
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_floating_point_v<T>) {
        constexpr std::array kOdd = {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
                                     Limits::denorm_min(), -T{0}};
        if (filling == Filling::odd_floats) {
            return kOdd[static_cast<std::size_t>(count) % kOdd.size()];
        }
    }
    switch (filling) {
        case Filling::lowest: return Limits::lowest();
        case Filling::highest: return Limits::max();
        case Filling::counted:
        case Filling::odd_floats: break;
    }
    if constexpr (std::is_same_v<T, char>) {
        return static_cast<char>('a' + count % 26);
    } else if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(0.37 * count - 1.1);
    } else {
        const auto wide = 0x0123456789ABCDEFULL * static_cast<unsigned long long>(count + 1);
        return static_cast<T>(wide);
    }
}

template <class Message>
[[nodiscard]] Message filled(Filling filling) {
    Message message;
    int count = 0;
    for_each_field(message, [&](std::string_view, auto& value) {
        for_each_element(value, [&](auto& element) {
            element = sample_value<std::remove_reference_t<decltype(element)>>(filling, count++);
        });
    });
    return message;
}

/// Out of line: a few hundred fields come here, which compilers need not inline one by one.
void note_difference(std::vector<std::string>& names, std::string_view name, const void* a,
                     const void* b, std::size_t bytes);

/// @return names of fields whose bits differ; NaN is like itself
template <class Message>
[[nodiscard]] std::vector<std::string> differences(const Message& a, const Message& b) {
    std::vector<std::string> names;
    std::apply(
        [&](const auto&... each) {
            (note_difference(names, each.name, &(a.*each.member), &(b.*each.member),
                             sizeof(a.*each.member)),
             ...);
        },
        Message::fields());
    return names;
}

/// @return the frames in `bytes`, each as a copy of its bytes
[[nodiscard]] std::vector<std::vector<std::uint8_t>> frames_in(Parser& parser, ByteView bytes);

}  // namespace limpet::mavlink
