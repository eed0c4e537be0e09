// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/mcap/reader.hpp"

// Files byte by byte, and what a reader makes of them.
namespace limpet::mcap {

inline Bytes bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

/// Concatenates byte literals; numbers in a test stand as the bytes that the specification gives.
struct Expected {
    Bytes bytes;
    Expected& raw(std::initializer_list<int> values) {
        for (const int value : values) {
            bytes.push_back(static_cast<std::uint8_t>(value));
        }
        return *this;
    }
    Expected& u64(std::uint64_t value) {
        for (int i = 0; i < 8; ++i) {
            bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        }
        return *this;
    }
    Expected& u32(std::uint32_t value) {
        u64(value);
        bytes.resize(bytes.size() - 4);
        return *this;
    }
    Expected& text(std::string_view value) {
        bytes.insert(bytes.end(), value.begin(), value.end());
        return *this;
    }
};

struct Got {
    std::uint16_t channel_id;
    std::uint32_t sequence;
    std::uint64_t time_ns;
    Bytes data;
    bool operator==(const Got&) const = default;
};

struct ReadBack {
    Contents contents;
    std::vector<Got> messages;
};

inline ReadBack read_all(const std::filesystem::path& path) {
    ReadBack result;
    result.contents = read(path, [&](const Contents&, const Message& m) {
        result.messages.push_back(
            {m.channel_id, m.sequence, m.log_time_ns, {m.data.begin(), m.data.end()}});
    });
    return result;
}

inline void expect_refused(const std::filesystem::path& path, const std::string& why) {
    try {
        (void)read(path, {});
        FAIL() << path << " was read";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(testing::HasSubstr(path.string()), testing::HasSubstr(why)));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

}  // namespace limpet::mcap
