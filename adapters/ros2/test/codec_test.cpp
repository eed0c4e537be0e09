// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limpet_ros/PerchingEvent.h>
#include <limpet_ros/State.h>
#include <sensor_msgs/Range.h>
#include <std_srvs/Trigger.h>

namespace limpet::ros2 {
namespace {

using testing::ElementsAreArray;

limpet_ros::State state() {
    limpet_ros::State state;
    state.header.stamp = ::ros::Time(2.5);
    state.header.frame_id = "map";
    state.connected = 1;
    state.armed = 1;
    state.mode = "OFFBOARD";
    state.system_status = 4;
    return state;
}

TEST(Codec, WritesWhatWasReckonedByHand) {
    // RTPS 2.x 10.2 (CDR, little-endian): numbers at multiples of their size after the first four
    // bytes, a text as its length with the closing zero, its characters, a zero.
    const std::vector<int> wanted = {
        0, 1, 0, 0,                          // CDR_LE
        2, 0, 0, 0, 0x00, 0x65, 0xcd, 0x1d,  // 2 s, 500,000,000 ns
        4, 0, 0, 0, 'm',  'a',  'p',  0,     // frame_id
        1, 1, 0, 0,                          // connected, armed, guided, manual_input
        9, 0, 0, 0, 'O',  'F',  'F',  'B',  'O', 'A', 'R', 'D', 0,  // mode
        4};                                                         // system_status
    EXPECT_THAT(encode(state()), ElementsAreArray(wanted));
}

TEST(Codec, ReadsWhatItWrites) {
    limpet_ros::PerchingEvent event;
    event.name = "impact";
    event.value_names = {"speed_m_s", "pitch_deg"};
    event.values = {0.5, -2.0};
    const auto read = decode<limpet_ros::PerchingEvent>(encode(event));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->name, "impact");
    EXPECT_EQ(read->value_names, event.value_names);
    EXPECT_EQ(read->values, event.values);
}

TEST(Codec, ReadsTheOtherByteOrder) {
    const Bytes big = {0, 0, 0,   0,   0,   0,   0,   2,   0x1d, 0xcd, 0x65, 0x00, 0,
                       0, 0, 4,   'm', 'a', 'p', 0,   1,   1,    0,    0,    0,    0,
                       0, 9, 'O', 'F', 'F', 'B', 'O', 'A', 'R',  'D',  0,    4};
    const auto read = decode<limpet_ros::State>(big);
    ASSERT_TRUE(read);
    EXPECT_EQ(encode(*read), encode(state()));
}

TEST(Codec, NothingIsOneByte) {
    EXPECT_EQ(encode(std_srvs::TriggerRequest()).size(), kEncapsulation_bytes + 1);
}

TEST(Codec, ARangeOfHumbleHasNoVariance) {
    sensor_msgs::Range range;
    range.range = 1.5F;
    range.variance = 0.25F;
    Bytes bytes = encode(range);
    bytes.resize(bytes.size() - sizeof range.variance);
    const auto read = decode<sensor_msgs::Range>(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->range, 1.5F);
    EXPECT_EQ(read->variance, 0.0F);
}

TEST(Codec, NoPrefixAndNoNoiseIsTakenForMore) {
    const Bytes whole = encode(state());
    for (std::size_t size = 0; size + 6 < whole.size(); ++size) {  // status and end of the mode
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        const auto read = decode<limpet_ros::State>(cut);
        if (read) {  // it ends between two fields
            EXPECT_TRUE(read->mode.empty()) << size;
        }
    }
    std::uint32_t random = 1;
    for (int turn = 0; turn < 20000; ++turn) {
        Bytes bytes = encode(limpet_ros::PerchingEvent());
        bytes.resize(64);
        for (std::size_t i = 4; i < bytes.size(); ++i) {
            random = random * 1664525U + 1013904223U;
            bytes[i] = static_cast<std::uint8_t>(random >> 24U);
        }
        if (const auto read = decode<limpet_ros::PerchingEvent>(bytes)) {
            EXPECT_LT(read->values.size(), 8U);
            EXPECT_LT(read->value_names.size(), 64U);
        }
    }
}

}  // namespace
}  // namespace limpet::ros2
