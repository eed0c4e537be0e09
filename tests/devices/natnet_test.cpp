// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/devices/packet.hpp"

namespace limpet::devices {
namespace {

using packets::Bytes;
using packets::HandMade;
using packets::hex;

constexpr NatNetVersion kOld{3, 0};
constexpr NatNetVersion kNew{4, 1};

HandMade rigid_body(std::int32_t id, float x, std::uint16_t flags = 1) {
    HandMade body;
    body.put(id).put(x).put(2.0F).put(3.0F);
    body.put(0.0F).put(0.6F).put(0.0F).put(0.8F).put(0.0005F).put(flags);
    return body;
}

/// One of everything in each section, so that a wrong stride anywhere loses the suffix.
/// @param precise  with 4.1's optional time stamp
Bytes full_frame(NatNetVersion version, bool precise = false) {
    const bool sized = version == kNew;
    HandMade frame;
    frame.put(std::int32_t{4711});
    const auto section = [&](std::int32_t count, const HandMade& content) {
        frame.put(count);
        if (sized) {
            frame.put(static_cast<std::uint32_t>(content.size()));
        }
        frame.add(content);
    };
    HandMade sets;
    sets.text("Quad").put(std::int32_t{2}).floats(6, 1.0F);
    sets.text("all").put(std::int32_t{1}).floats(3, 1.0F);
    section(2, sets);
    section(1, HandMade().floats(3, 5.0F));
    section(2, rigid_body(7, 10.0F).add(rigid_body(12, 1.5F)));
    HandMade skeletons;
    skeletons.put(std::int32_t{1}).put(std::int32_t{2});
    skeletons.add(rigid_body(12, 99.0F)).add(rigid_body(2, 99.0F));
    section(1, skeletons);
    if (sized) {
        HandMade assets;
        assets.put(std::int32_t{5}).put(std::int32_t{1}).add(rigid_body(12, 98.0F));
        assets.put(std::int32_t{1}).floats(6, 0.0F).put(std::uint16_t{0});
        section(1, assets);
    }
    section(1, HandMade().put(std::int32_t{9}).floats(4, 0.5F).put(std::uint16_t{2}).put(0.1F));
    const auto channels = HandMade()
                              .put(std::int32_t{1})
                              .put(std::int32_t{2})
                              .put(std::int32_t{3})
                              .floats(3, 1.0F)
                              .put(std::int32_t{1})
                              .floats(1, 1.0F);
    section(1, channels);
    section(1, channels);
    frame.put(std::uint32_t{0}).put(std::uint32_t{0}).put(12.25);
    frame.put(std::uint64_t{1000}).put(std::uint64_t{1100}).put(std::uint64_t{1200});
    if (precise) {
        frame.put(std::uint64_t{77});
    }
    frame.put(std::uint16_t{2}).put(std::uint32_t{0});
    return frame.packet(7);
}

void expect_full_frame(const Bytes& packet, NatNetVersion version) {
    const std::optional<NatNetFrame> frame = decode_frame(packet, version, 12);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->number, 4711);
    EXPECT_EQ(frame->motive_time_s, 12.25);
    EXPECT_EQ(frame->mid_exposure_ticks, 1000U);
    EXPECT_EQ(frame->transmit_ticks, 1200U);
    ASSERT_TRUE(frame->body);
    EXPECT_EQ(frame->body->id, 12);
    EXPECT_EQ(frame->body->pose.p_MP_m, Vector3(1.5, 2.0, 3.0));
    EXPECT_NEAR(frame->body->pose.q_MP.w(), 0.8, 1e-7);
    EXPECT_NEAR(frame->body->pose.q_MP.y(), 0.6, 1e-7);
    EXPECT_TRUE(frame->body->tracking_valid);
}

TEST(NatNet, ReadsAFullFrameOfVersion3) {
    expect_full_frame(full_frame(kOld), kOld);
    expect_full_frame(full_frame(kOld), {4, 0});  // the same bytes
}

TEST(NatNet, ReadsAFullFrameOfVersion41WithAndWithoutThePreciseTime) {
    expect_full_frame(full_frame(kNew), kNew);
    expect_full_frame(full_frame(kNew, true), kNew);
}

TEST(NatNet, AFrameOfAnotherVersionIsNotTakenForOurs) {
    EXPECT_FALSE(decode_frame(full_frame(kNew), kOld, 12));
    EXPECT_FALSE(decode_frame(full_frame(kOld), kNew, 12));
    EXPECT_FALSE(decode_frame(full_frame(kOld), {2, 9}, 12));
}

TEST(NatNet, ABodyThatIsNotStreamedIsAbsentAndNotAnother) {
    const std::optional<NatNetFrame> frame = decode_frame(full_frame(kOld), kOld, 2);
    ASSERT_TRUE(frame);
    EXPECT_FALSE(frame->body);  // 2 is a bone of the skeleton
}

TEST(NatNet, EveryCutOfAFrameGivesNothing) {
    for (const NatNetVersion version : {kOld, kNew}) {
        const Bytes packet = full_frame(version);
        for (std::size_t length = 0; length < packet.size(); ++length) {
            EXPECT_FALSE(decode_frame(std::span(packet).first(length), version, 12)) << length;
        }
    }
}

TEST(NatNet, CountsThatTheBytesCannotHoldGiveNothing) {
    Bytes packet = full_frame(kOld);
    const std::int32_t huge = 0x7FFFFFFF;
    std::memcpy(&packet[8], &huge, sizeof(huge));  // marker sets
    EXPECT_FALSE(decode_frame(packet, kOld, 12));
    packet = full_frame(kOld);
    const std::int32_t negative = -1;
    std::memcpy(&packet[8], &negative, sizeof(negative));
    EXPECT_FALSE(decode_frame(packet, kOld, 12));
}

TEST(NatNet, APoseThatIsNoPoseGivesNothingUnlessItIsUntracked) {
    const auto frame_with = [](float x, float w, std::uint16_t flags) {
        HandMade frame;
        frame.put(std::int32_t{1}).put(std::int32_t{0}).put(std::int32_t{0}).put(std::int32_t{1});
        frame.put(std::int32_t{3}).put(x).put(0.0F).put(0.0F);
        frame.floats(3, 0.0F).put(w).put(0.0F).put(flags);
        frame.floats(4, 0.0F);  // four empty sections
        frame.floats(2, 0.0F).put(1.0).floats(6, 0.0F).put(std::uint16_t{0}).put(std::uint32_t{0});
        return frame.packet(7);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ASSERT_TRUE(decode_frame(frame_with(1.0F, 1.0F, 1), kOld, 3));
    EXPECT_FALSE(decode_frame(frame_with(nan, 1.0F, 1), kOld, 3));
    EXPECT_FALSE(decode_frame(frame_with(1.0F, 0.0F, 1), kOld, 3));
    NatNetSeen seen;
    (void)decode_frame(frame_with(1.0F, 1.0F, 1), kOld, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::none);
    (void)decode_frame(frame_with(nan, 1.0F, 1), kOld, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::not_finite);
    (void)decode_frame(frame_with(1.0F, 0.0F, 1), kOld, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::no_attitude);
    (void)decode_frame(frame_with(1.0F, 1.0F, 0), kOld, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::untracked);
    (void)decode_frame(frame_with(1.0F, 1.0F, 1), kOld, 4, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::absent);
    EXPECT_EQ(seen.bodies, 1U);
    EXPECT_EQ(seen.ids[0], 3);
    (void)decode_frame(frame_with(1.0F, 1.0F, 1), {5, 0}, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::version);
    (void)decode_frame(hex("0a00 0000"), kOld, 3, &seen);
    EXPECT_EQ(seen.refusal, NatNetRefusal::not_natnet);
    const std::optional<NatNetFrame> untracked = decode_frame(frame_with(nan, 0.0F, 0), kOld, 3);
    ASSERT_TRUE(untracked);
    EXPECT_FALSE(untracked->body->tracking_valid);
    EXPECT_TRUE(untracked->body->pose.p_MP_m.allFinite());
}

/// Before 4.1 no section says its size: bytes that are left over are another layout. From there on
/// a younger version may append.
TEST(NatNet, BytesLeftOverAreAnotherLayoutBefore41) {
    const auto longer = [](NatNetVersion version, std::size_t more) {
        Bytes packet = full_frame(version);
        packet.resize(packet.size() + more);
        const auto length = static_cast<std::uint16_t>(packet.size() - 4);
        std::memcpy(&packet[2], &length, sizeof(length));
        return packet;
    };
    for (const std::size_t more : {1U, 4U, 8U, 300U}) {
        NatNetSeen seen;
        EXPECT_FALSE(decode_frame(longer(kOld, more), kOld, 12, &seen)) << more;
        EXPECT_EQ(seen.refusal, NatNetRefusal::unreadable);
        EXPECT_EQ(seen.bodies, 0U) << "what cannot be read names no bodies";
        EXPECT_TRUE(decode_frame(longer(kNew, more), kNew, 12)) << more;
        EXPECT_TRUE(decode_frame(longer(kNew, more), {4, 3}, 12)) << more;
    }
    Bytes bare = full_frame(kOld);  // without its end mark
    bare.resize(bare.size() - 4);
    const auto length = static_cast<std::uint16_t>(bare.size() - 4);
    std::memcpy(&bare[2], &length, sizeof(length));
    EXPECT_TRUE(decode_frame(bare, kOld, 12));
}

TEST(NatNet, WhatIsEncodedDecodes) {
    NatNetFrame frame;
    frame.number = 5;
    frame.motive_time_s = 1.25;
    frame.mid_exposure_ticks = 10;
    frame.transmit_ticks = 30;
    frame.body = NatNetBody{.id = 4,
                            .pose = {.p_MP_m = {1.0, 2.0, 3.0}, .q_MP = {0.5, -0.5, 0.5, -0.5}},
                            .tracking_valid = true};
    for (const NatNetVersion version : {kOld, NatNetVersion{3, 1}, NatNetVersion{4, 0}, kNew}) {
        NatNetBuffer buffer;
        const std::optional<NatNetFrame> back =
            decode_frame(encode_frame(frame, version, buffer), version, 4);
        ASSERT_TRUE(back);
        EXPECT_EQ(back->number, 5);
        EXPECT_EQ(back->motive_time_s, 1.25);
        EXPECT_EQ(back->mid_exposure_ticks, 10U);
        EXPECT_EQ(back->transmit_ticks, 30U);
        ASSERT_TRUE(back->body);
        EXPECT_EQ(back->body->pose.p_MP_m, frame.body->pose.p_MP_m);
        EXPECT_EQ(back->body->pose.q_MP.coeffs(), frame.body->pose.q_MP.coeffs());
        EXPECT_TRUE(back->body->tracking_valid);
        EXPECT_FALSE(decode_frame(encode_frame(frame, version, buffer), version, 5)->body);
    }
}

TEST(NatNet, AnEncodedFrameIsLaidOutAsTheProtocolSays) {
    NatNetFrame frame;
    frame.number = 258;
    frame.motive_time_s = 0.5;
    frame.body = NatNetBody{.id = 1, .pose = {.p_MP_m = {1.0, 0.0, 0.0}}, .tracking_valid = true};
    NatNetBuffer buffer;
    const auto packet = encode_frame(frame, kOld, buffer);
    const Bytes expected = hex(R"(0700 7400 02010000
        00000000 00000000 01000000
        01000000 0000803f 00000000 00000000 00000000 00000000 00000000 0000803f 00000000 0100
        00000000 00000000 00000000 00000000
        00000000 00000000 000000000000e03f 0000000000000000 0000000000000000 0000000000000000
        0000 00000000)");
    EXPECT_EQ(Bytes(packet.begin(), packet.end()), expected);
}

TEST(NatNet, ConnectIsLongAsMotiveExpectsIt) {
    NatNetBuffer buffer;
    const auto packet = encode_connect({3, 0}, buffer);
    ASSERT_EQ(packet.size(), 4U + 256U + 4U + 4U);
    EXPECT_EQ(natnet_message(packet), NatNetMessage::connect);
    EXPECT_EQ(std::to_integer<int>(packet[2]) + 256 * std::to_integer<int>(packet[3]), 264);
    EXPECT_EQ(std::to_integer<int>(packet[260]), 3);
    EXPECT_EQ(std::to_integer<int>(packet[264]), 3);
}

TEST(NatNet, ReadsWhatTheServerSaysOfItself) {
    HandMade info;
    info.text("Motive");
    for (int i = 7; i < 256; ++i) {
        info.put('\x7F');  // Motive leaves old bytes behind its name
    }
    info.put(std::uint32_t{0x00000102}).put(std::uint32_t{0x00000104});
    info.put(std::uint64_t{3312787})
        .put(std::uint16_t{1511})
        .put('\0')
        .put(std::uint32_t{0x632AFFEF});  // 239.255.42.99, in network order
    const std::optional<NatNetServer> server = decode_server(info.packet(1));
    ASSERT_TRUE(server);
    EXPECT_EQ(server->version, (NatNetVersion{4, 1}));
    EXPECT_EQ(server->clock_Hz, 3312787U);
    EXPECT_EQ(server->data_port, 1511);
    EXPECT_FALSE(server->multicast);
    EXPECT_EQ(server->group, (std::array<std::uint8_t, 4>{239, 255, 42, 99}));

    NatNetBuffer buffer;
    const auto back = decode_server(encode_server(*server, buffer));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->version, server->version);
    EXPECT_EQ(back->clock_Hz, server->clock_Hz);
    EXPECT_FALSE(back->multicast);
}

TEST(NatNet, OtherMessagesAreNotMistaken) {
    EXPECT_FALSE(natnet_message({}));
    EXPECT_FALSE(natnet_message(hex("0700 0500 00")));  // says five bytes, has one
    EXPECT_FALSE(natnet_message(hex("6300 0000")));
    EXPECT_EQ(natnet_message(hex("0a00 0000")), NatNetMessage::keep_alive);
    EXPECT_FALSE(decode_server(full_frame(kOld)));
}

}  // namespace
}  // namespace limpet::devices
