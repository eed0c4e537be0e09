// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/status_text.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace limpet::mavlink {
namespace {

StatusText piece(std::string_view text, std::uint16_t id = 0, std::uint8_t chunk = 0) {
    StatusText message;
    set_text(message.text, text);
    message.id = id;
    message.chunk_seq = chunk;
    return message;
}

const std::string kFull(50, 'a');

TEST(TextJoiner, ATextByItselfIsHandedOut) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.hear(piece("Takeoff detected\t")), "Takeoff detected");
}

TEST(TextJoiner, ChunksBecomeOneText) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.hear(piece(kFull, 3, 0)), std::nullopt);
    EXPECT_EQ(joiner.hear(piece(kFull, 3, 1)), std::nullopt);
    EXPECT_EQ(joiner.hear(piece("end", 3, 2)), kFull + kFull + "end");
    EXPECT_EQ(joiner.hear(piece(kFull, 4, 0)), std::nullopt);
    EXPECT_EQ(joiner.hear(piece("", 4, 1)), kFull);  // one that fills its chunks
}

TEST(TextJoiner, WhatIsLostIsTold) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.hear(piece(kFull, 3, 0)), std::nullopt);
    EXPECT_EQ(joiner.hear(piece(kFull, 5, 0)), kFull + "...");  // the next begins
    EXPECT_EQ(joiner.hear(piece("end", 5, 2)), kFull + "...");  // one between is missing
    EXPECT_EQ(joiner.hear(piece("tail", 6, 1)), std::nullopt);  // its beginning is
}

TEST(TextJoiner, AFloodOfChunksEnds) {
    TextJoiner joiner;
    std::size_t longest = 0;
    for (int chunk = 0; chunk < 256; ++chunk) {
        const auto text = joiner.hear(piece(kFull, 9, static_cast<std::uint8_t>(chunk)));
        longest = std::max(longest, text ? text->size() : 0);
    }
    EXPECT_EQ(longest, 1000U);
}

TEST(TextJoiner, WhatHasComeIsGivenUpOnce) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.give_up(), std::nullopt);
    EXPECT_EQ(joiner.hear(piece(kFull, 3, 0)), std::nullopt);
    EXPECT_EQ(joiner.give_up(), kFull + "...");
    EXPECT_EQ(joiner.give_up(), std::nullopt);
}

TEST(RecentWarnings, TheLastThreeDifferentOnes) {
    RecentWarnings warnings;
    warnings.add(MavSeverity::info, "Takeoff detected");
    EXPECT_TRUE(warnings.texts().empty());
    warnings.add(MavSeverity::error, "Preflight Fail: barometer missing");
    warnings.add(MavSeverity::warning, "Arming denied");
    warnings.add(MavSeverity::error, "Preflight Fail: barometer missing");
    EXPECT_EQ(warnings.texts(),
              (std::vector<std::string>{"Arming denied", "Preflight Fail: barometer missing"}));
    warnings.add(MavSeverity::error, "a");
    warnings.add(MavSeverity::error, "b");
    EXPECT_EQ(warnings.texts(),
              (std::vector<std::string>{"Preflight Fail: barometer missing", "a", "b"}));
}

TEST(TextSplitter, TextsOfAnyLengthComeThroughWhole) {
    TextSplitter splitter;
    TextJoiner joiner;
    for (std::size_t length = 0; length < 260; ++length) {
        const std::string text(length, 'x');
        std::vector<std::string> whole;
        splitter.split(6, text, [&](const StatusText& message) {
            EXPECT_EQ(message.severity, 6);
            if (auto joined = joiner.hear(message)) {
                whole.push_back(*joined);
            }
        });
        EXPECT_EQ(whole, std::vector{text});
    }
}

TEST(TextJoiner, NoEscapeCodeComesThrough) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.hear(piece("\x1b[2Jgone\a")), "?[2Jgone?");
    EXPECT_EQ(joiner.hear(piece("\xc2\x9b"
                                "31m")),
              "??31m");
}

}  // namespace
}  // namespace limpet::mavlink
