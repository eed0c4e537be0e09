// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/mavlink/offboard.hpp"

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

TEST(TextJoiner, NoEscapeCodeComesThrough) {
    TextJoiner joiner;
    EXPECT_EQ(joiner.hear(piece("\x1b[2Jgone\a")), "?[2Jgone?");
    EXPECT_EQ(joiner.hear(piece("\xc2\x9b"
                                "31m")),
              "??31m");
}

}  // namespace
}  // namespace limpet::mavlink
