// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

#include "limpet/campaign/sampling.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/ranks/rank_link.hpp"

/// What the ranks of a campaign send each other.
namespace limpet::ranks {

using std::chrono::microseconds;

/// The first byte of a message.
enum class Word : char {
    hello = 'h',      ///< to rank 0: who I am, what I was started for
    cannot = 'c',     ///< to rank 0 in hello's place: why I cannot
    begin = 'g',      ///< from rank 0: all were started for the same
    shut_down = 'n',  ///< from rank 0: they were not, or all is flown
    report = 'r',     ///< to rank 0: number of runs wanted, rows
    assign = 'd',     ///< from rank 0: whether these are the last, runs
    bad_input = 'i',  ///< to rank 0: text; this rank ends with what it has in the air
    our_fault = 'f',  ///< likewise
    stop = 's',       ///< either way: break off
    bye = 'b',        ///< to rank 0: nothing is in the air here any more
};

/// Writes a message.
class Writer {
public:
    explicit Writer(Word word) : bytes_(1, static_cast<char>(word)) {}

    template <class Value>
    Writer& put(const Value& value) {
        if constexpr (std::is_same_v<Value, campaign::SampledValue>) {
            std::visit([this](const auto& held) { put(held); }, value);
        } else if constexpr (std::is_same_v<Value, std::string>) {
            put(static_cast<std::uint32_t>(value.size()));
            bytes_ += value;
        } else {
            static_assert(std::is_arithmetic_v<Value>);
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        return *this;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Reads a message.
class Reader {
public:
    /// @param bytes  outlive the reader
    explicit Reader(const std::string& bytes) : left_(bytes) {}

    [[nodiscard]] Word word() { return static_cast<Word>(get<char>()); }
    template <class Value>
    [[nodiscard]] Value get() {
        Value value;
        read(value);
        return value;
    }
    /// @param value  a sampled one says by what it holds whether a number or a name follows
    template <class Value>
    void read(Value& value) {
        if constexpr (std::is_same_v<Value, campaign::SampledValue>) {
            std::visit([this](auto& held) { read(held); }, value);
        } else if constexpr (std::is_same_v<Value, std::string>) {
            value = take(get<std::uint32_t>());
        } else {
            std::memcpy(&value, take(sizeof value).data(), sizeof value);
        }
    }

private:
    std::string_view take(std::size_t size) {
        require(size <= left_.size(), "a rank's message is whole");
        const std::string_view taken = left_.substr(0, size);
        left_.remove_prefix(size);
        return taken;
    }

    std::string_view left_;
};

/// How long until the next look at what has come: short while there is traffic.
class Patience {
public:
    void traffic() { next_ = kShort; }
    [[nodiscard]] microseconds next() {
        return std::exchange(next_, std::min(2 * next_, microseconds(kLong)));
    }
    void wait() { std::this_thread::sleep_for(next()); }

private:
    static constexpr microseconds kShort{50};
    static constexpr microseconds kLong{2000};
    microseconds next_ = kShort;
};

/// Waits for it.
[[nodiscard]] inline RankLink::Message next_message(RankLink& link) {
    Patience patience;
    while (true) {
        if (auto message = link.receive()) {
            return std::move(*message);
        }
        patience.wait();
    }
}

}  // namespace limpet::ranks
