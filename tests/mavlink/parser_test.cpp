// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "limpet/mavlink/codec.hpp"
#include "samples.hpp"
#include "vectors.hpp"

namespace limpet::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;

const Bytes kGood = from_hex(kVectors[1].hex);   // HIL_SENSOR
const Bytes kOther = from_hex(kVectors[2].hex);  // HIL_GPS

/// Byte by byte: at an insertion of ranges GCC 12 sees copies out of bounds.
Bytes operator+(Bytes a, const Bytes& b) {
    for (const std::uint8_t byte : b) {
        a.push_back(byte);
    }
    return a;
}

/// Of a message that nobody knows; its checksum is what it may be.
Bytes unknown_frame(std::uint8_t sequence, std::uint8_t system = 1, std::uint8_t component = 200,
                    const Bytes& payload = Bytes(40, 0x55)) {
    const Bytes header = {kStart2,   static_cast<std::uint8_t>(payload.size()),
                          0,         0,
                          sequence,  system,
                          component, 0x39,
                          0x30,      0x02};
    return header + payload + Bytes{0xAB, 0xCD};
}

Bytes sequenced(std::uint8_t sequence, std::uint8_t component = 1) {
    Sender from{1, component, sequence};
    FrameBuffer buffer = {};
    const ByteView bytes = encode(filled<Attitude>(Filling::counted), from, buffer);
    return {bytes.begin(), bytes.end()};
}

TEST(Parser, FindsAllFramesHoweverTheBytesArrive) {
    Bytes stream;
    for (const Vector& vector : kVectors) {
        stream = stream + from_hex(vector.hex);
    }
    for (const std::size_t step : {1U, 2U, 3U, 7U, 64U, 281U, 100'000U}) {
        Parser parser;
        Bytes found;
        for (std::size_t at = 0; at < stream.size(); at += step) {
            const ByteView piece = ByteView(stream).subspan(at, std::min(step, stream.size() - at));
            for (const Bytes& frame : frames_in(parser, piece)) {
                found = found + frame;
            }
        }
        EXPECT_EQ(found, stream) << step << " bytes at a time";
        EXPECT_EQ(parser.statistics().frames, kVectors.size());
        EXPECT_EQ(parser.statistics().discarded_bytes, 0U);
    }
}

TEST(Parser, FindsAFrameBehindHalfAFrame) {
    for (std::size_t cut = 1; cut < kOther.size(); ++cut) {
        Parser parser;
        const Bytes half(kOther.begin(), kOther.begin() + static_cast<std::ptrdiff_t>(cut));
        // The second one lets the longest candidate end.
        const auto frames = frames_in(parser, half + kGood + kGood);
        EXPECT_THAT(frames, ElementsAre(kGood, kGood)) << cut;
        EXPECT_EQ(parser.statistics().discarded_bytes, cut);
    }
}

TEST(Parser, CountsABadChecksumAndGoesOn) {
    for (std::size_t at = 10; at < kGood.size(); ++at) {
        Bytes bad = kGood;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 0x04U);
        Parser parser;
        EXPECT_THAT(frames_in(parser, bad + kOther + kGood), ElementsAre(kOther, kGood)) << at;
        EXPECT_GE(parser.statistics().bad_checksum, 1U) << at;
    }
}

TEST(Parser, SkipsAnUnknownMessageWhole) {
    // What looks like a frame in its payload is not taken for one.
    const Bytes unknown = unknown_frame(1);
    const Bytes nested = unknown_frame(2, 1, 200, kOther);
    Parser parser;
    EXPECT_THAT(frames_in(parser, kGood + unknown + nested + kGood), ElementsAre(kGood, kGood));
    EXPECT_EQ(parser.statistics().unknown, 2U);
    EXPECT_EQ(parser.statistics().discarded_bytes, 0U);
}

TEST(Parser, AfterGarbageAnUnknownFrameSwallowsNone) {
    Bytes trap = {0x00, kStart2, 255, 0, 0, 0, 1, 1, 0x39, 0x30, 0x02};
    Parser parser;
    const Bytes many = kGood + kGood + kGood + kGood;
    EXPECT_THAT(frames_in(parser, trap + many), ElementsAre(kGood, kGood, kGood, kGood));
}

TEST(Parser, SkipsFramesOfVersionOne) {
    // HEARTBEAT in MAVLink 1.
    Bytes old = {kStart1, 9, 0, 1, 1, 0, 0, 0, 0, 0, 18, 8, 0, 4, 3};
    const std::uint16_t crc = frame_checksum(old, 50);
    old.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    old.push_back(static_cast<std::uint8_t>(crc >> 8U));
    Parser parser;
    EXPECT_THAT(frames_in(parser, old + kGood + old + kGood), ElementsAre(kGood, kGood));
    EXPECT_EQ(parser.statistics().mavlink1, 2U);
    EXPECT_EQ(parser.statistics().discarded_bytes, 0U);
}

TEST(Parser, RefusesFlagsThatNobodyHasDefined) {
    Bytes flagged = kGood;
    flagged[2] = 0x02;
    Parser parser;
    EXPECT_THAT(frames_in(parser, flagged + kGood), ElementsAre(kGood));
    EXPECT_EQ(parser.statistics().incompatible, 1U);
    EXPECT_EQ(parser.statistics().discarded_bytes, flagged.size());
}

TEST(Parser, CountsLostFramesOfEachSender) {
    Parser parser;
    for (const std::uint8_t sequence : Bytes{254, 255, 0, 1, 5, 6}) {  // 2, 3, 4 are missing
        EXPECT_EQ(frames_in(parser, sequenced(sequence, 1)).size(), 1U);
        EXPECT_EQ(frames_in(parser, sequenced(static_cast<std::uint8_t>(sequence / 2), 2)).size(),
                  1U);
    }
    // Component 2: 127, 127, 0, 0, 2, 3: a repeated one and a start anew are none, 1 is missing.
    EXPECT_EQ(parser.statistics().lost, 3U + 1U);
}

TEST(Parser, AnUnknownMessageTakesANumberAndIsNotLost) {
    Parser parser;
    EXPECT_EQ(frames_in(parser, sequenced(10, 200) + unknown_frame(11) + sequenced(12, 200)).size(),
              2U);
    EXPECT_EQ(parser.statistics().lost, 0U);
    EXPECT_EQ(frames_in(parser, unknown_frame(99, 7, 7) + sequenced(13, 200)).size(), 1U);
    EXPECT_EQ(parser.statistics().lost, 0U);
}

TEST(Parser, ManySendersDoNotHurt) {
    Parser parser;
    for (int round = 0; round < 3; ++round) {
        for (int component = 0; component < 200; ++component) {
            const auto frames = frames_in(parser, sequenced(static_cast<std::uint8_t>(round),
                                                            static_cast<std::uint8_t>(component)));
            EXPECT_EQ(frames.size(), 1U);
        }
    }
    EXPECT_EQ(parser.statistics().frames, 600U);
}

TEST(Parser, FindsEveryFrameAmongRandomBytes) {
    std::mt19937 random(20260101);  // NOLINT: the same bytes each time
    std::uniform_int_distribution<int> byte(0, 255);
    std::uniform_int_distribution<int> length(0, 300);
    Parser parser;
    constexpr std::size_t kFrames = 2000;
    std::size_t found = 0;
    for (std::size_t i = 0; i < kFrames; ++i) {
        Bytes piece(static_cast<std::size_t>(length(random)));
        for (auto& each : piece) {
            each = static_cast<std::uint8_t>(byte(random));
        }
        // A garbage byte that is no start ends the trust in unknown frames.
        piece.insert(piece.begin(), 0x00);
        found += frames_in(parser, piece + kGood).size();
    }
    // What a last false candidate still waits for.
    found += frames_in(parser, Bytes(kLargestFrame_bytes, 0)).size();
    EXPECT_EQ(found, kFrames);
    EXPECT_EQ(parser.statistics().frames, kFrames);
}

}  // namespace
}  // namespace limpet::mavlink
