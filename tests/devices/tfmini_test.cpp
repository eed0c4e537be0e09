// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/tfmini.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/devices/packet.hpp"

namespace limpet::devices {
namespace {

using packets::Bytes;
using packets::hex;

std::vector<TfminiFrame> all_of(TfminiParser& parser, const Bytes& bytes) {
    std::vector<TfminiFrame> frames;
    for (const std::byte byte : bytes) {
        if (const auto frame = parser.parse(byte)) {
            frames.push_back(*frame);
        }
    }
    return frames;
}

// 121 cm, strength 500, temp 2248 = 25 degC: 59+59+79+00+f4+01+c8+08 = 0x2f0
const Bytes kFrame = hex("59 59 79 00 f4 01 c8 08 f0");

TEST(Tfmini, ReadsAFrameOfTheManualsLayout) {
    TfminiParser parser;
    const auto frames = all_of(parser, kFrame);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].distance_cm, 121);
    EXPECT_EQ(frames[0].strength, 500);
    EXPECT_EQ(frames[0].temperature_degC, 25.0);
    EXPECT_TRUE(range_reading(frames[0]).valid);
    EXPECT_DOUBLE_EQ(range_reading(frames[0]).distance_m, 1.21);
}

TEST(Tfmini, EncodesTheSameBytes) {
    const auto bytes =
        encode(TfminiFrame{.distance_cm = 121, .strength = 500, .temperature_degC = 25.0});
    EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), kFrame);
}

TEST(Tfmini, WeakSaturatedAndFarEchoesAreInvalid) {
    const auto valid = [](int distance_cm, int strength) {
        return range_reading({.distance_cm = static_cast<std::uint16_t>(distance_cm),
                              .strength = static_cast<std::uint16_t>(strength)})
            .valid;
    };
    EXPECT_TRUE(valid(100, 100));
    EXPECT_FALSE(valid(100, 99));
    EXPECT_TRUE(valid(100, 65534));
    EXPECT_FALSE(valid(100, 65535));
    EXPECT_TRUE(valid(10, 1000));
    EXPECT_FALSE(valid(9, 1000));
    EXPECT_TRUE(valid(1200, 1000));
    EXPECT_FALSE(valid(1201, 1000));
}

TEST(Tfmini, AReadingGoesThereAndBackToTheCentimetre) {
    const RangeReading back = range_reading(tfmini_frame({.distance_m = 2.344, .valid = true}));
    EXPECT_TRUE(back.valid);
    EXPECT_DOUBLE_EQ(back.distance_m, 2.34);
    EXPECT_FALSE(range_reading(tfmini_frame({.distance_m = 2.0, .valid = false})).valid);
}

TEST(Tfmini, FindsTheNextFrameBehindGarbageAndCutFrames) {
    TfminiParser parser;
    Bytes bytes = hex("00 59 11 59 59 79 00 f4");  // noise, and a frame that breaks off
    bytes.insert(bytes.end(), kFrame.begin(), kFrame.end());
    bytes.insert(bytes.end(), kFrame.begin(), kFrame.end());
    EXPECT_EQ(all_of(parser, bytes).size(), 2U);
}

TEST(Tfmini, AWrongChecksumGivesNothing) {
    TfminiParser parser;
    Bytes bytes = kFrame;
    bytes[3] = std::byte{1};
    EXPECT_TRUE(all_of(parser, bytes).empty());
    EXPECT_EQ(all_of(parser, kFrame).size(), 1U);
}

TEST(Tfmini, DistancesThatLookLikeAStartMisleadNobody) {
    // 0x5959 cm and strength 0x5959: four start bytes more in the frame
    TfminiParser parser;
    const auto frame = encode(TfminiFrame{.distance_cm = 0x5959, .strength = 0x5959});
    Bytes bytes;
    for (std::size_t i = 2; i < 4 * frame.size(); ++i) {  // joined in the middle
        bytes.push_back(frame[i % frame.size()]);
    }
    const auto frames = all_of(parser, bytes);
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[2].distance_cm, 0x5959);
}

}  // namespace
}  // namespace limpet::devices
