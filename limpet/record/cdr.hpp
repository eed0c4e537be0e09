// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/message_writer.hpp"

// Fields of ROS 2 messages as CDR, in the order of their definition.
namespace limpet::record {

/// Here, so that put() is found for every field.
struct Cdr : eprosima::fastcdr::Cdr {
    using eprosima::fastcdr::Cdr::Cdr;
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
    cdr.serializeArray(text.text.data(), text.text.size());
    cdr << '\0';
}

inline void put(Cdr& cdr, std::string_view text) {
    constexpr std::size_t kMaxText = 256;
    require(text.size() <= kMaxText, "a recorded text has at most 256 characters");
    put(cdr, LongText{text});
}

inline void put(Cdr& cdr, std::span<const double> numbers) {
    cdr.serializeArray(numbers.data(), numbers.size());
}

inline void put(Cdr& cdr, const Vector3& v) {
    cdr.serializeArray(v.data(), 3);
}

/// ROS puts w last, as Eigen does.
inline void put(Cdr& cdr, const Quaternion& q) {
    cdr.serializeArray(q.coeffs().data(), 4);
}

inline void put(Cdr& cdr, const Euler& angles) {
    cdr << angles.roll_rad << angles.pitch_rad << angles.yaw_rad;
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
    // Fast-CDR skips the bytes that align the next value; they must not carry the last message.
    std::fill_n(buffer_.begin(), used_, '\0');
    eprosima::fastcdr::FastBuffer stream(buffer_.data(), buffer_.size());
    Cdr cdr(stream, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    (put(cdr, fields), ...);
    used_ = cdr.getSerializedDataLength();
    const mcap::ByteView bytes(reinterpret_cast<const std::uint8_t*>(buffer_.data()), used_);
    file_.write(channel, static_cast<std::uint64_t>(time_ns), bytes);
    if (beside_ != nullptr) {
        beside_->message(channel, static_cast<std::uint64_t>(time_ns), bytes);
    }
    last_time_ns_ = std::max(last_time_ns_, time_ns);
}

template <class... Fields>
void MessageWriter::write_stamped(std::uint16_t channel, double time_s, const Fields&... fields) {
    write(channel, time_s, stamp(time_s), fields...);
}

}  // namespace limpet::record
