// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Messages of ROS 2 (the structs that interfaces.py makes) as bytes on the wire and back: CDR as
// RTPS 2.x carries it, four bytes of encapsulation before it. Written little-endian, read as sent.
namespace limpet::ros2 {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::size_t kEncapsulation_bytes = 4;

class Encoder {
public:
    template <class T>
    void operator()(const T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            align(sizeof value);
            append(&value, sizeof value);
        } else {
            T::visit(value, *this);
        }
    }
    void operator()(const std::string& text) {
        count(text.size() + 1);
        append(text.c_str(), text.size() + 1);
    }
    void operator()(const ::ros::Time& time) {
        (*this)(time.sec);
        (*this)(time.nsec);
    }
    template <class T, std::size_t N>
    void operator()(const std::array<T, N>& elements) {
        for (const T& element : elements) {
            (*this)(element);
        }
    }
    template <class T>
    void operator()(const std::vector<T>& elements) {
        count(elements.size());
        for (const T& element : elements) {
            (*this)(element);
        }
    }
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

private:
    void align(std::size_t size) {
        while ((bytes_.size() - kEncapsulation_bytes) % size != 0) {
            bytes_.push_back(0);
        }
    }
    void append(const void* from, std::size_t size) {
        const auto* first = static_cast<const std::uint8_t*>(from);
        bytes_.insert(bytes_.end(), first, first + size);
    }
    void count(std::size_t size) { (*this)(static_cast<std::uint32_t>(size)); }

    Bytes bytes_ = {0, 1, 0, 0};  ///< CDR, little-endian, no options
};

/// Reads while it is sound; from the first field that does not fit on, nothing more.
class Decoder {
public:
    explicit Decoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
        sound_ = bytes.size() >= kEncapsulation_bytes && bytes[0] == 0 && bytes[1] <= 1;
        swaps_ = sound_ && bytes[1] == 0;
        at_ = kEncapsulation_bytes;
    }

    template <class T>
    void operator()(T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            at_ += (sizeof value - (at_ - kEncapsulation_bytes) % sizeof value) % sizeof value;
            take(&value, sizeof value);
        } else {
            T::visit(value, *this);
        }
    }
    void operator()(std::string& text) {
        std::uint32_t size = 0;
        (*this)(size);
        if (fits(size) && size > 0) {
            text.assign(reinterpret_cast<const char*>(&bytes_[at_]), size - 1);
            sound_ = bytes_[at_ + size - 1] == 0;
            at_ += size;
        }
    }
    void operator()(::ros::Time& time) {
        (*this)(time.sec);
        (*this)(time.nsec);
    }
    template <class T, std::size_t N>
    void operator()(std::array<T, N>& elements) {
        for (T& element : elements) {
            (*this)(element);
        }
    }
    template <class T>
    void operator()(std::vector<T>& elements) {
        std::uint32_t size = 0;
        (*this)(size);
        elements.clear();
        for (std::uint32_t i = 0; i < size && fits(1); ++i) {  // an element is a byte at least
            (*this)(elements.emplace_back());
        }
    }
    [[nodiscard]] bool sound() const { return sound_; }
    /// At most what fills the last four bytes is left: a field that does not fit was never sent.
    [[nodiscard]] bool at_end() const { return sound_ && at_ + 4 > bytes_.size(); }
    /// That field was not meant.
    void end() { sound_ = true, at_ = bytes_.size(); }

private:
    bool fits(std::size_t size) {
        sound_ = sound_ && at_ <= bytes_.size() && size <= bytes_.size() - at_;
        return sound_;
    }
    void take(void* to, std::size_t size) {
        if (!fits(size)) {
            return;
        }
        auto* first = static_cast<std::uint8_t*>(to);
        std::memcpy(first, &bytes_[at_], size);
        if (swaps_) {
            std::reverse(first, first + size);
        }
        at_ += size;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool sound_ = false;
    bool swaps_ = false;
};

template <class Message>
[[nodiscard]] Bytes encode(const Message& message) {
    Encoder encoder;
    encoder(message);
    return encoder.bytes();
}

/// @return nullopt for bytes that are no such message. Fields at its end may be missing, which a
///         newer definition added (the variance of a Range), and unknown ones may follow
template <class Message>
[[nodiscard]] std::optional<Message> decode(std::span<const std::uint8_t> bytes) {
    Message message;
    Decoder decoder(bytes);
    bool first = true;
    Message::visit(message, [&](auto& field) {
        const bool may_lack = !std::exchange(first, false) && decoder.at_end();
        decoder(field);
        if (may_lack && !decoder.sound()) {
            field = {};
            decoder.end();
        }
    });
    return decoder.sound() ? std::optional(message) : std::nullopt;
}

}  // namespace limpet::ros2
