// SPDX-License-Identifier: Apache-2.0
// Ten million bytes of mutated frames. The seeds are the test vectors and every message filled.
#include <gtest/gtest.h>

#include <random>

#include "limpet/mavlink/signing.hpp"
#include "samples.hpp"
#include "vectors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace limpet::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> seeds() {
    std::vector<Bytes> frames;
    for (const Vector& vector : kVectors) {
        frames.push_back(from_hex(vector.hex));
    }
    Signing signing({}, 0);
    for_each_message([&](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        Sender from{1, 1, 0};
        FrameBuffer buffer = {};
        const ByteView frame = encode(filled<Message>(Filling::counted), from, buffer);
        frames.emplace_back(frame.begin(), frame.end());
        const ByteView whole = signing.sign(buffer, frame, 1);
        frames.emplace_back(whole.begin(), whole.end());
    });
    return frames;
}

class Mutator {
public:
    explicit Mutator(std::uint32_t seed) : random_(seed), seeds_(seeds()) {}

    /// @return some frames in a row, most of them hurt
    Bytes stream() {
        Bytes bytes = {any_byte()};  // the size of the pieces
        for (std::size_t i = 0, frames = 1 + below(8); i < frames; ++i) {
            Bytes frame = seeds_[below(seeds_.size())];
            hurt(frame);
            bytes.insert(bytes.end(), frame.begin(), frame.end());
        }
        return bytes;
    }

private:
    std::size_t below(std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
    }
    std::uint8_t any_byte() { return static_cast<std::uint8_t>(below(256)); }

    void hurt(Bytes& frame) {
        const std::size_t at = below(frame.size());
        const auto place = frame.begin() + static_cast<std::ptrdiff_t>(at);
        switch (below(7)) {
            case 0: break;  // left whole
            case 1: frame[at] = any_byte(); break;
            case 2: frame[at] ^= static_cast<std::uint8_t>(1U << below(8)); break;
            case 3: frame.erase(place, frame.end()); break;
            case 4: frame.insert(place, below(300), any_byte()); break;
            case 5: frame[1 + below(2)] = any_byte(); break;  // length or flags
            case 6: frame.insert(place, below(2) == 0 ? kStart2 : kStart1); break;
        }
    }

    std::mt19937 random_;
    std::vector<Bytes> seeds_;
};

TEST(Fuzz, TenMillionBytesOfMutatedFrames) {
    Mutator mutator(4);
    Parser parser;
    std::size_t frames = 0;
    for (std::size_t bytes = 0; bytes < 10'000'000;) {
        const Bytes stream = mutator.stream();
        ASSERT_EQ(LLVMFuzzerTestOneInput(stream.data(), stream.size()), 0);
        bytes += stream.size();
        frames += frames_in(parser, stream).size();
    }
    EXPECT_GT(frames, 20'000U) << "the decoders have had work";
    EXPECT_GT(parser.statistics().bad_checksum, 20'000U);
}

TEST(Fuzz, TenMillionRandomBytesGiveNoFrameWorthMentioning) {
    std::mt19937 random(5);  // NOLINT: the same bytes each time
    Parser parser;
    Bytes block(10'000);
    std::size_t frames = 0;
    for (int i = 0; i < 1000; ++i) {
        for (auto& byte : block) {
            byte = static_cast<std::uint8_t>(random());
        }
        frames += frames_in(parser, block).size();
    }
    // A false one needs its start byte, defined flags, a known id and a checksum by chance:
    // 1e7 (1/256) (2/256) (39/2^24) 2^-16 are 1e-8.
    EXPECT_EQ(frames, 0U);
    const auto& seen = parser.statistics();
    EXPECT_GT(seen.discarded_bytes, 9'000'000U);
}

TEST(Fuzz, StartBytesAloneDoNotHoldItUp) {
    Parser parser;
    const Bytes starts(1'000'000, kStart1);  // every byte begins a candidate of 262
    EXPECT_TRUE(frames_in(parser, starts).empty());
}

}  // namespace
}  // namespace limpet::mavlink
