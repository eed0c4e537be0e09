// SPDX-License-Identifier: Apache-2.0
// Random and mutated bytes through every decoder; the sanitizers watch.
#include <gtest/gtest.h>

#include <algorithm>

#include "limpet/core/random.hpp"
#include "limpet/devices/mechanism_line.hpp"
#include "limpet/devices/natnet.hpp"
#include "limpet/devices/tfmini.hpp"
#include "tests/devices/packet.hpp"

namespace limpet::devices {
namespace {

using packets::Bytes;

std::size_t below(RandomStream& random, std::size_t limit) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(limit));
}

TEST(DevicesFuzz, NoFrameOfMotionCaptureIsReadBeyondItsEnd) {
    RandomStream random(1, 0, Stream::test);
    NatNetFrame frame;
    frame.body = NatNetBody{.id = 1, .tracking_valid = true};
    std::size_t decoded = 0;
    for (const NatNetVersion version : {NatNetVersion{3, 0}, NatNetVersion{4, 1}}) {
        NatNetBuffer buffer;
        const auto good = encode_frame(frame, version, buffer);
        for (int i = 0; i < 100000; ++i) {
            // a block of its own size: one byte too far is seen
            Bytes packet(good.begin(), good.end());
            packet.resize(4 + below(random, packet.size()));
            for (std::size_t k = below(random, 6); k > 0; --k) {
                packet[below(random, packet.size())] = static_cast<std::byte>(below(random, 256));
            }
            const auto length = static_cast<std::uint16_t>(packet.size() - 4);
            if (random.uniform() < 0.7) {
                std::memcpy(&packet[2], &length, sizeof(length));
            }
            const auto out = decode_frame(packet, version, 1);
            decoded += out ? 1 : 0;
            if (out && out->body) {
                ASSERT_TRUE(out->body->pose.p_MP_m.allFinite());
            }
            (void)decode_server(packet);
        }
    }
    EXPECT_GT(decoded, 100U);  // mutations that hurt nothing: the test reaches the end
}

TEST(DevicesFuzz, TheRangeFinderIsFoundAgainBehindAnyBytes) {
    RandomStream random(2, 0, Stream::test);
    const auto good = encode(TfminiFrame{.distance_cm = 150, .strength = 800});
    for (int i = 0; i < 20000; ++i) {
        TfminiParser parser;
        for (std::size_t k = below(random, 40); k > 0; --k) {
            (void)parser.parse(
                static_cast<std::byte>(random.uniform() < 0.4 ? 0x59 : below(random, 256)));
        }
        // What garbage has begun may swallow a frame, not three.
        bool found = false;
        for (int again = 0; again < 3; ++again) {
            for (const std::byte byte : good) {
                const auto frame = parser.parse(byte);
                found = found || (frame && frame->distance_cm == 150);
            }
        }
        ASSERT_TRUE(found);
    }
}

TEST(DevicesFuzz, TheMechanismIsHeardAgainAfterTheNextLineEnd) {
    RandomStream random(3, 0, Stream::test);
    MechanismBuffer buffer;
    const std::string_view good = encode({.pump_on = true, .force_N = 3.5}, buffer);
    MechanismParser parser;
    for (int i = 0; i < 50000; ++i) {
        for (std::size_t k = below(random, 120); k > 0; --k) {
            (void)parser.parse(static_cast<std::byte>(below(random, 256)));
        }
        (void)parser.parse(std::byte{'\n'});
        std::optional<MechanismLine> line;
        for (const char letter : good) {
            line = parser.parse(static_cast<std::byte>(letter));
        }
        ASSERT_TRUE(line);
        ASSERT_EQ(line->force_N, 3.5);
    }
}

}  // namespace
}  // namespace limpet::devices
