// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/files.hpp"
#include "files_of_bytes.hpp"
#include "limpet/mcap/reader.hpp"

namespace limpet::mcap {
namespace {

using ::testing::HasSubstr;

// What others pack, byte by byte from the formats' descriptions: the reader has it from their
// libraries.

/// A frame of LZ4 with one block, stored as it is where it is not packed
/// (the frame format of LZ4 1.6.4).
Bytes lz4_frame(ByteView block, bool packed) {
    Expected e;
    e.raw({0x04, 0x22, 0x4D, 0x18, 0x60, 0x40, 0x82});
    e.u32(static_cast<std::uint32_t>(block.size()) | (packed ? 0U : 0x80000000U));
    e.bytes.insert(e.bytes.end(), block.begin(), block.end());
    return e.u32(0).bytes;
}

/// A block of one sequence, literals without a match (the block format of LZ4).
Bytes lz4_literals(ByteView bytes) {
    Bytes block = {0xF0};
    std::size_t left = bytes.size() - 15;
    for (; left >= 255; left -= 255) {
        block.push_back(255);
    }
    block.push_back(static_cast<std::uint8_t>(left));
    block.insert(block.end(), bytes.begin(), bytes.end());
    return block;
}

/// A frame of zstd with raw blocks (RFC 8878, 3.1.1).
Bytes zstd_frame(ByteView bytes) {
    Expected e;
    e.raw({0x28, 0xB5, 0x2F, 0xFD, 0xA0}).u32(static_cast<std::uint32_t>(bytes.size()));
    constexpr std::size_t kBlock = 100'000;
    for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
        const auto block = bytes.subspan(at, std::min(kBlock, bytes.size() - at));
        const bool last = at + block.size() == bytes.size();
        e.u32(static_cast<std::uint32_t>(block.size() << 3U) | (last ? 1U : 0U));
        e.bytes.pop_back();
        e.bytes.insert(e.bytes.end(), block.begin(), block.end());
    }
    return e.bytes;
}

/// A file of a chunk, then a message that is in none.
Bytes file_of_chunk(std::string_view compression, std::size_t size, const Bytes& stored) {
    Expected e;
    e.raw({0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
    e.raw({0x03}).u64(16).raw({1, 0}).u32(1).text("S").u32(0).u32(0).raw({0});
    e.raw({0x04}).u64(18).raw({1, 0, 1, 0}).u32(2).text("/t").u32(0).u32(0);
    e.raw({0x06}).u64(40 + compression.size() + stored.size());
    e.u64(0).u64(0).u64(size).u32(0);
    e.u32(static_cast<std::uint32_t>(compression.size())).text(compression).u64(stored.size());
    e.bytes.insert(e.bytes.end(), stored.begin(), stored.end());
    e.raw({0x05}).u64(22).raw({1, 0}).u32(9).u64(9).u64(9);
    return e.bytes;
}

Bytes messages(std::size_t count) {
    Expected e;
    for (std::size_t k = 0; k < count; ++k) {
        e.raw({0x05}).u64(23).raw({1, 0}).u32(0).u64(k).u64(k).raw({7});
    }
    return e.bytes;
}

TEST(McapReader, ReadsChunksOfLz4) {
    const TestFolder folder;
    const Bytes records = messages(100);
    for (const bool packed : {false, true}) {
        const Bytes frame = lz4_frame(packed ? lz4_literals(records) : records, packed);
        store(folder / "a.mcap", file_of_chunk("lz4", records.size(), frame));
        const ReadBack back = read_all(folder / "a.mcap");
        ASSERT_EQ(back.messages.size(), 101U);
        EXPECT_EQ(back.messages[99].time_ns, 99U);
        EXPECT_EQ(back.contents.skipped_records, 0U);
        for (const std::size_t claimed : {records.size() - 1, records.size() + 1, std::size_t{0}}) {
            store(folder / "b.mcap", file_of_chunk("lz4", claimed, frame));
            EXPECT_THAT(read_all(folder / "b.mcap").contents.damage, HasSubstr("does not unpack"));
        }
        for (std::size_t cut = 0; cut < frame.size(); cut += 7) {
            const Bytes part(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(cut));
            store(folder / "b.mcap", file_of_chunk("lz4", records.size(), part));
            const ReadBack of_part = read_all(folder / "b.mcap");
            EXPECT_EQ(of_part.messages.size(), 1U) << "what follows the chunk is read";
            EXPECT_THAT(of_part.contents.damage, HasSubstr("1 damaged record left out"));
        }
    }
    // Repeats 8 bytes from 8 before, 25 times: LZ4 refers to what it is writing.
    const Bytes block = {0x8F, 1, 2, 3, 4, 5, 6, 7, 8, 8, 0, 173, 0x50, 9, 9, 9, 9, 9};
    store(folder / "a.mcap", file_of_chunk("lz4", 205, lz4_frame(block, true)));
    EXPECT_THAT(read_all(folder / "a.mcap").contents.damage, HasSubstr("ends within a record"));
    store(folder / "a.mcap", file_of_chunk("rle", 8, {1, 2}));
    EXPECT_THAT(read_all(folder / "a.mcap").contents.damage,
                HasSubstr("chunk compressed by \"rle\" (zstd and lz4 are known)"));
}

TEST(McapReader, ReadsFilesThatArePackedAsAWhole) {
    const TestFolder folder;
    const Bytes records = messages(40'000);
    const Bytes plain = file_of_chunk("", records.size(), records);
    ASSERT_GT(plain.size(), 1'000'000U);
    const Bytes whole_lz4 = lz4_frame(lz4_literals(ByteView(plain).first(60'000)), true);
    Bytes two = whole_lz4;
    for (std::size_t at = 60'000; at < plain.size(); at += 60'000) {
        const Bytes more = lz4_frame(
            ByteView(plain).subspan(at, std::min<std::size_t>(60'000, plain.size() - at)), false);
        two.insert(two.end(), more.begin(), more.end());
    }
    for (const Bytes& packed : {zstd_frame(plain), two}) {
        store(folder / "a.mcap.packed", packed);
        const ReadBack back = read_all(folder / "a.mcap.packed");
        EXPECT_EQ(back.messages.size(), 40'001U);
        // Cut short, it is a recording that was cut short.
        const auto half = static_cast<std::ptrdiff_t>(packed.size() / 2);
        store(folder / "b.mcap", Bytes(packed.begin(), packed.begin() + half));
        EXPECT_THAT(read_all(folder / "b.mcap").contents.damage, HasSubstr("cut off"));
        EXPECT_EQ(read_all(folder / "b.mcap").contents.skipped_records, 0U);
    }
    store(folder / "text.zst", zstd_frame(bytes_of("surfaces:\n")));
    expect_refused(folder / "text.zst", "what is packed in it does not begin as an MCAP file does");
    store(folder / "none.zst", Bytes{0x28, 0xB5, 0x2F, 0xFD, 0xFF, 0xFF});
    expect_refused(folder / "none.zst", "what is packed in it does not begin");
}

/// A kilobyte of zstd whose blocks each say "128 kB of zeros".
TEST(McapReader, AFileThatIsPackedUnpacksToNoMoreThanItsSizeMay) {
    const TestFolder folder;
    Expected e;
    e.raw({0x28, 0xB5, 0x2F, 0xFD, 0x00, 0x70});  // window of 16 MB, size unknown
    e.raw({0x40, 0x00, 0x00, 0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
    for (int k = 0; k < 3000; ++k) {
        e.raw({0x02, 0x00, 0x10, 0x00});  // RLE, 131072 times 0
    }
    e.raw({0x03, 0x00, 0x00, 0x00});
    store(folder / "a.mcap.zstd", e.bytes);
    expect_refused(folder / "a.mcap.zstd", "unpacks to more than 257 MB, which no recording of");
}

/// A channel with millions of entries, each empty, in a chunk of a kilobyte.
TEST(McapReader, WhatIsKeptIsBounded) {
    const TestFolder folder;
    constexpr std::uint32_t kBlock = 131'072, kBlocks = 300;
    const auto packed_channel = [&](std::uint32_t blocks) {
        const std::uint32_t map_bytes = blocks * kBlock;
        Expected e;
        e.raw({0x28, 0xB5, 0x2F, 0xFD, 0x00, 0x70}).raw({25 << 3, 0, 0});
        e.raw({0x04}).u64(16 + map_bytes).raw({1, 0, 1, 0}).u32(0).u32(0).u32(map_bytes);
        for (std::uint32_t k = 1; k <= blocks; ++k) {
            e.raw({k == blocks ? 0x03 : 0x02, 0x00, 0x10, 0x00});  // RLE, 131072 times 0
        }
        return file_of_chunk("zstd", 25 + map_bytes, e.bytes);
    };
    store(folder / "a.mcap", packed_channel(1));
    EXPECT_EQ(read_all(folder / "a.mcap").contents.skipped_records, 0U);
    store(folder / "a.mcap", packed_channel(kBlocks));
    expect_refused(folder / "a.mcap", "more than 256 MB in memory");
}

}  // namespace
}  // namespace limpet::mcap
