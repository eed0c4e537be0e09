// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/message_writer.hpp"

// Fields of ROS 2 messages as CDR, in the order of their definition.
namespace limpet::record {

/// One message as little-endian plain CDR (version 1): the encapsulation of four bytes, then each
/// number at a multiple of its size counted from there, with zeros in between.
/// Source: OMG DDS-XTYPES 1.3, 7.4.1 and 7.6.2
class Cdr {
public:
    /// @param space  holds the whole message
    explicit Cdr(std::span<char> space) : space_(space) {
        constexpr char kPlainLittleEndian[] = {0, 1, 0, 0};
        append(kPlainLittleEndian, sizeof kPlainLittleEndian);
    }

    template <class Number>
    Cdr& operator<<(Number value) {
        numbers(&value, 1);
        return *this;
    }
    /// One after the other, without their count.
    template <class Number>
    void numbers(const Number* values, std::size_t count) {
        static_assert(std::is_arithmetic_v<Number>);
        static_assert(std::endian::native == std::endian::little,
                      "numbers are written as they lie in memory");
        if (count > 0) {
            align(sizeof(Number));
            append(values, count * sizeof(Number));
        }
    }
    /// Bytes written so far.
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    static constexpr std::size_t kEncapsulation = 4;

    void align(std::size_t to) {
        constexpr char kZeros[sizeof(double)] = {};
        append(kZeros, (to - (size_ - kEncapsulation) % to) % to);
    }
    /// @throws InternalError where it does not fit: spaces are made for the largest message of a
    /// channel
    void append(const void* bytes, std::size_t count) {
        require(count <= space_.size() - size_, "a recorded message fits into its space");
        std::memcpy(space_.data() + size_, bytes, count);
        size_ += count;
    }

    std::span<char> space_;
    std::size_t size_ = 0;
};

/// builtin_interfaces/Time and, as far as bytes go, Duration.
struct Stamp {
    std::int64_t time_ns = 0;
};

/// @throws InternalError for a time before 0: a sample that never came is not recorded
[[nodiscard]] inline Stamp stamp(double time_s) {
    require(time_s >= 0.0 && time_s < 1e9, "recorded times are 0 or later, and finite");
    return {std::llround(time_s * 1e9)};
}

/// A text of any length, where others are names and reasons.
struct LongText {
    std::string_view text;
};
/// An array of any length: how many, then each.
template <class Element>
struct Sequence {
    std::span<const Element> elements;
};

template <class Number>
requires std::is_arithmetic_v<Number>
void put(Cdr& cdr, Number number) {
    if constexpr (std::is_same_v<Number, bool>) {
        cdr << static_cast<std::uint8_t>(number);
    } else {
        cdr << number;
    }
}

inline void put(Cdr& cdr, Stamp stamp) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    cdr << static_cast<std::int32_t>(stamp.time_ns / kSecond_ns);
    cdr << static_cast<std::uint32_t>(stamp.time_ns % kSecond_ns);
}

inline void put(Cdr& cdr, LongText text) {
    cdr << static_cast<std::uint32_t>(text.text.size() + 1);
    cdr.numbers(text.text.data(), text.text.size());
    cdr << '\0';
}

inline void put(Cdr& cdr, std::string_view text) {
    constexpr std::size_t kMaxText = 256;
    require(text.size() <= kMaxText, "a recorded text has at most 256 characters");
    put(cdr, LongText{text});
}

inline void put(Cdr& cdr, std::span<const double> numbers) {
    cdr.numbers(numbers.data(), numbers.size());
}

inline void put(Cdr& cdr, const Vector3& v) {
    cdr.numbers(v.data(), 3);
}

/// ROS puts w last, as Eigen does.
inline void put(Cdr& cdr, const Quaternion& q) {
    cdr.numbers(q.coeffs().data(), 4);
}

inline void put(Cdr& cdr, const Euler& angles) {
    put(cdr, Vector3(angles.roll_rad, angles.pitch_rad, angles.yaw_rad));
}

template <class Element>
void put(Cdr& cdr, Sequence<Element> sequence) {
    cdr << static_cast<std::uint32_t>(sequence.elements.size());
    for (const Element& element : sequence.elements) {
        put(cdr, element);
    }
}

template <class... Fields>
void MessageWriter::write(std::uint16_t channel, double time_s, const Fields&... fields) {
    if (channel == kNowhere) {
        return;
    }
    const std::int64_t time_ns = stamp(time_s).time_ns;
    Cdr cdr{std::span(buffer_)};
    (put(cdr, fields), ...);
    const mcap::ByteView bytes(reinterpret_cast<const std::uint8_t*>(buffer_.data()), cdr.size());
    file_.write(channel, static_cast<std::uint64_t>(time_ns), bytes);
    if (mirror_ != nullptr) {
        mirror_->message(channel, static_cast<std::uint64_t>(time_ns), bytes);
    }
    last_time_ns_ = std::max(last_time_ns_, time_ns);
}

template <class... Fields>
void MessageWriter::write_stamped(std::uint16_t channel, double time_s, const Fields&... fields) {
    write(channel, time_s, stamp(time_s), fields...);
}

}  // namespace limpet::record
