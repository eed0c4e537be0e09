// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "../support/files.hpp"
#include "files_of_bytes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/mcap/writer.hpp"

namespace limpet::mcap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// CRC-32 bit by bit, straight from its polynomial: what zlib's tables are checked against.
std::uint32_t slow_crc32(ByteView bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
        }
    }
    return ~crc;
}

constexpr int kMessages = 600;

/// A file of a few chunks with everything in it; returns its messages.
std::vector<Got> write_sample(const std::filesystem::path& path, bool compress) {
    Writer writer(path, {.chunk_bytes = 4096, .compress = compress});
    writer.add_metadata({"limpet", {{"seed", "7"}, {"scenario", "perch"}}});
    writer.add_attachment({"scenario.yaml", "text/yaml", "vehicle: perching_uav\n", 0});
    const std::uint16_t schema = writer.add_schema("a/msg/A", "ros2msg", "uint8 a\n");
    const std::uint16_t left = writer.add_channel(schema, "/left", "cdr", {{"k", "v"}});
    const std::uint16_t right = writer.add_channel(schema, "/right", "cdr");
    std::vector<Got> messages;
    std::uint32_t sequence[2] = {0, 0};
    for (int i = 0; i < kMessages; ++i) {
        const std::uint16_t channel = i % 3 == 0 ? left : right;
        Bytes data(static_cast<std::size_t>(20 + i % 7));
        for (std::size_t k = 0; k < data.size(); ++k) {
            data[k] = static_cast<std::uint8_t>(k * 31 + static_cast<std::size_t>(i) * 7);
        }
        const std::uint64_t time_ns = static_cast<std::uint64_t>(i) * 1'000'000;
        writer.write(channel, time_ns, data);
        messages.push_back({channel, sequence[channel]++, time_ns, data});
    }
    writer.add_attachment({"summary.json", "application/json", "{}", 599'000'000});
    writer.close();
    return messages;
}

TEST(McapFormat, Crc32IsThatOfTheStandard) {
    EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926u);  // the standard's check value
    EXPECT_EQ(crc32({}), 0u);
    EXPECT_EQ(crc32(bytes_of("6789"), crc32(bytes_of("12345"))), 0xCBF43926u);
    EXPECT_EQ(slow_crc32(bytes_of("123456789")), 0xCBF43926u);
}

TEST(McapWriter, EveryByteOfASmallFileIsAsSpecified) {
    const TestFolder folder;
    Writer writer(folder / "small.mcap", {.compress = false});
    writer.add_metadata({"m", {{"k", "v"}}});
    writer.add_attachment({"a", "t", "xy", 5});
    const auto schema = writer.add_schema("S", "ros2msg", "uint8 a");
    const auto channel = writer.add_channel(schema, "/t", "cdr");
    writer.write(channel, 258, bytes_of("!?"));
    writer.close();

    Expected e;
    e.raw({0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
    e.raw({0x01}).u64(18).u32(4).text("ros2").u32(6).text("limpet");
    const std::size_t metadata = e.bytes.size();
    const Bytes metadata_record = Expected()
                                      .raw({0x0C})
                                      .u64(19)
                                      .u32(1)
                                      .text("m")
                                      .u32(10)
                                      .u32(1)
                                      .text("k")
                                      .u32(1)
                                      .text("v")
                                      .bytes;
    e.bytes.insert(e.bytes.end(), metadata_record.begin(), metadata_record.end());
    const std::size_t attachment = e.bytes.size();
    const Bytes covered =
        Expected().u64(5).u64(0).u32(1).text("a").u32(1).text("t").u64(2).text("xy").bytes;
    e.raw({0x09}).u64(40);
    e.bytes.insert(e.bytes.end(), covered.begin(), covered.end());
    e.u32(slow_crc32(covered));
    const Bytes schema_record = Expected()
                                    .raw({0x03})
                                    .u64(29)
                                    .raw({1, 0})
                                    .u32(1)
                                    .text("S")
                                    .u32(7)
                                    .text("ros2msg")
                                    .u32(7)
                                    .text("uint8 a")
                                    .bytes;
    const Bytes channel_record = Expected()
                                     .raw({0x04})
                                     .u64(21)
                                     .raw({0, 0, 1, 0})
                                     .u32(2)
                                     .text("/t")
                                     .u32(3)
                                     .text("cdr")
                                     .u32(0)
                                     .bytes;
    for (const Bytes& record : {schema_record, channel_record}) {
        e.bytes.insert(e.bytes.end(), record.begin(), record.end());
    }
    const std::size_t chunk = e.bytes.size();
    const Bytes message =
        Expected().raw({0x05}).u64(24).raw({0, 0}).u32(0).u64(258).u64(258).text("!?").bytes;
    e.raw({0x06}).u64(73).u64(258).u64(258).u64(33).u32(slow_crc32(message)).u32(0).u64(33);
    e.bytes.insert(e.bytes.end(), message.begin(), message.end());
    const std::size_t message_index = e.bytes.size();
    e.raw({0x07}).u64(22).raw({0, 0}).u32(16).u64(258).u64(0);
    const std::uint32_t data_crc = slow_crc32(e.bytes);
    e.raw({0x0F}).u64(4).u32(data_crc);

    const std::size_t summary = e.bytes.size();
    for (const Bytes& record : {schema_record, channel_record}) {
        e.bytes.insert(e.bytes.end(), record.begin(), record.end());
    }
    const std::size_t statistics = e.bytes.size();
    e.raw({0x0B}).u64(56).u64(1).raw({1, 0}).u32(1).u32(1).u32(1).u32(1).u64(258).u64(258);
    e.u32(10).raw({0, 0}).u64(1);
    const std::size_t chunk_index = e.bytes.size();
    e.raw({0x08}).u64(74).u64(258).u64(258).u64(chunk).u64(message_index - chunk);
    e.u32(10).raw({0, 0}).u64(message_index).u64(31).u32(0).u64(33).u64(33);
    const std::size_t attachment_index = e.bytes.size();
    e.raw({0x0A})
        .u64(50)
        .u64(attachment)
        .u64(49)
        .u64(5)
        .u64(0)
        .u64(2)
        .u32(1)
        .text("a")
        .u32(1)
        .text("t");
    const std::size_t metadata_index = e.bytes.size();
    e.raw({0x0D}).u64(21).u64(metadata).u64(metadata_record.size()).u32(1).text("m");
    const std::size_t offsets = e.bytes.size();
    const std::size_t starts[] = {summary,          summary + schema_record.size(),
                                  statistics,       chunk_index,
                                  attachment_index, metadata_index,
                                  offsets};
    const int opcodes[] = {0x03, 0x04, 0x0B, 0x08, 0x0A, 0x0D};
    for (std::size_t i = 0; i < 6; ++i) {
        e.raw({0x0E}).u64(17).raw({opcodes[i]}).u64(starts[i]).u64(starts[i + 1] - starts[i]);
    }
    e.raw({0x02}).u64(20).u64(summary).u64(offsets);
    e.u32(slow_crc32(ByteView(e.bytes).subspan(summary)));
    e.raw({0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});

    EXPECT_EQ(load(folder / "small.mcap"), e.bytes);
}

class McapRoundTrip : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Compression, McapRoundTrip, ::testing::Values(false, true),
                         [](const auto& compress) { return compress.param ? "zstd" : "none"; });

TEST_P(McapRoundTrip, GivesBackEverythingInOrder) {
    const TestFolder folder;
    const std::vector<Got> written = write_sample(folder / "a.mcap", GetParam());
    const ReadBack back = read_all(folder / "a.mcap");
    EXPECT_EQ(back.messages, written);
    EXPECT_EQ(back.contents.damage, "");
    EXPECT_FALSE(back.contents.truncated);
    EXPECT_EQ(back.contents.profile, "ros2");
    EXPECT_EQ(back.contents.library, "limpet");
    ASSERT_EQ(back.contents.metadata.size(), 1u);
    EXPECT_EQ(back.contents.metadata[0].values.at("scenario"), "perch");
    ASSERT_EQ(back.contents.attachments.size(), 2u);
    EXPECT_EQ(back.contents.attachments[0].text, "vehicle: perching_uav\n");
    EXPECT_EQ(back.contents.attachments[1].name, "summary.json");
    EXPECT_EQ(back.contents.channels.at(0).metadata.at("k"), "v");
    EXPECT_EQ(back.contents.schemas.at(1).text, "uint8 a\n");
    EXPECT_EQ(back.contents.last_time_ns, 599'000'000u);
}

TEST_P(McapRoundTrip, ACutFileGivesAllThatIsWhole) {
    const TestFolder folder;
    const std::vector<Got> written = write_sample(folder / "a.mcap", GetParam());
    const Bytes file = load(folder / "a.mcap");

    // Where each chunk ends and how many messages there are up to it, from walking over records.
    std::vector<std::pair<std::size_t, std::size_t>> chunk_ends;
    std::size_t messages = 0, data_end = 0;
    for (std::size_t at = 8; at + 9 <= file.size() - 8;) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 8; ++i) {
            length |= static_cast<std::size_t>(file[at + 1 + i]) << (8 * i);
        }
        if (file[at] == 0x07) {  // message index: 16 bytes a message behind 2 + 4
            messages += (length - 6) / 16;
            chunk_ends.back().second = messages;
        } else if (file[at] == 0x06) {
            chunk_ends.emplace_back(at + 9 + length, 0);
        } else if (file[at] == 0x0F) {
            data_end = at;
        }
        at += 9 + length;
    }
    ASSERT_EQ(messages, written.size());
    ASSERT_GT(chunk_ends.size(), 5u);

    for (std::size_t cut = 1; cut < file.size(); cut += GetParam() ? 197 : 149) {
        store(folder / "cut.mcap", ByteView(file).first(cut));
        const ReadBack back = read_all(folder / "cut.mcap");
        EXPECT_TRUE(back.contents.truncated) << cut;
        EXPECT_NE(back.contents.damage, "") << cut;
        std::size_t whole = 0;
        for (const auto& [end, count] : chunk_ends) {
            whole = cut >= end ? count : whole;
        }
        ASSERT_GE(back.messages.size(), whole) << cut;
        ASSERT_LE(back.messages.size(), written.size());
        if (GetParam()) {
            EXPECT_EQ(back.messages.size(), whole) << cut;
        }
        EXPECT_TRUE(std::equal(back.messages.begin(), back.messages.end(), written.begin())) << cut;
        if (cut > data_end) {
            EXPECT_EQ(back.contents.attachments.size(), 2u);
        }
    }
}

TEST(McapReader, GivesWholeMessagesOfACutUncompressedChunk) {
    const TestFolder folder;
    Writer writer(folder / "a.mcap", {.compress = false});
    const auto channel = writer.add_channel(writer.add_schema("S", "ros2msg", ""), "/t", "cdr");
    for (std::uint64_t i = 0; i < 10; ++i) {
        writer.write(channel, i * 1'000'000'000, Bytes(9));  // records of 40 bytes
    }
    writer.close();
    const Bytes file = load(folder / "a.mcap");
    const Bytes head = {0x06, 0xB8, 0x01};  // 40 + 400 bytes of content
    const auto chunk = std::search(file.begin(), file.end(), head.begin(), head.end());
    ASSERT_NE(chunk, file.end());
    const auto records = static_cast<std::size_t>(chunk - file.begin()) + 9 + 40;
    store(folder / "cut.mcap", ByteView(file).first(records + 3 * 40 + 39));

    const ReadBack back = read_all(folder / "cut.mcap");
    EXPECT_EQ(back.messages.size(), 3u);
    EXPECT_EQ(back.contents.unread_bytes, 9u + 40u + 159u);
    EXPECT_EQ(back.contents.damage,
              "cut off: the last 208 bytes cannot be read; messages end at 2.000 s");
}

TEST_P(McapRoundTrip, OneChangedByteIsAlwaysNoticedAndNeverFatal) {
    const TestFolder folder;
    const std::vector<Got> written = write_sample(folder / "a.mcap", GetParam());
    const Bytes file = load(folder / "a.mcap");
    for (std::size_t at = kMagic.size(); at < file.size(); at += at < 500 ? 1 : 83) {
        Bytes changed = file;
        changed[at] ^= static_cast<std::uint8_t>(1u << (at % 8));
        store(folder / "changed.mcap", changed);
        const ReadBack back = read_all(folder / "changed.mcap");
        EXPECT_NE(back.contents.damage, "") << at;
        EXPECT_LE(back.messages.size(), written.size()) << at;
    }
}

TEST(McapReader, ABadChunkCostsItsOwnMessagesAlone) {
    const TestFolder folder;
    const std::vector<Got> written = write_sample(folder / "a.mcap", false);
    Bytes file = load(folder / "a.mcap");
    const Bytes& victim = written[300].data;
    const auto at = std::search(file.begin(), file.end(), victim.begin(), victim.end());
    ASSERT_NE(at, file.end());
    *at ^= 0x10;
    store(folder / "a.mcap", file);

    const ReadBack back = read_all(folder / "a.mcap");
    EXPECT_EQ(back.contents.damage,
              "1 damaged record left out, first a chunk with a wrong checksum");
    EXPECT_LT(back.messages.size(), written.size());
    EXPECT_GT(back.messages.size(), written.size() - 90);  // a chunk of 4096 bytes at 51 or more
    EXPECT_EQ(back.messages.front(), written.front());
    EXPECT_EQ(back.messages.back(), written.back());
    for (const Got& message : back.messages) {
        EXPECT_EQ(message, written[message.time_ns / 1'000'000]);
    }
}

TEST(McapReader, DoesNotBelieveAChunkThatClaimsTerabytes) {
    const TestFolder folder;
    Expected e;
    e.raw({0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
    e.raw({0x06}).u64(48).u64(0).u64(0).u64(1ull << 42).u32(1).u32(4).text("zstd").u64(4).u32(0);
    store(folder / "a.mcap", e.bytes);
    EXPECT_THAT(read(folder / "a.mcap", {}).damage, HasSubstr("chunk larger than 256 MiB"));
}

TEST(McapReader, SkipsWhatItDoesNotKnow) {
    const TestFolder folder;
    Expected e;
    e.raw({0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'});
    e.raw({0x80}).u64(3).text("???");
    e.raw({0x03}).u64(18).raw({1, 0}).u32(1).text("S").u32(0).u32(0).text("new");
    store(folder / "a.mcap", e.bytes);
    const Contents contents = read(folder / "a.mcap", {});
    EXPECT_EQ(contents.schemas.at(1).name, "S");  // and takes no offence at a field added behind
    EXPECT_EQ(contents.skipped_records, 0u);
}

TEST(McapReader, RefusesWhatIsNoRecording) {
    const TestFolder folder;
    expect_refused(folder / "missing.mcap", "no such recording");
    expect_refused(folder.path(), "not a regular file");
    store(folder / "empty.mcap", {});
    expect_refused(folder / "empty.mcap", "empty file");
    store(folder / "text.mcap", bytes_of("surfaces:\n"));
    expect_refused(folder / "text.mcap", "does not begin as an MCAP file");
}

/// Zeros by zstd: 100 MB are some 10 KB.
TEST(McapReader, UnpacksNoMoreThanAFileOfItsSizeMayHold) {
    const TestFolder folder;
    {
        Writer writer(folder / "a.mcap", {.chunk_bytes = 100'000'000});
        const auto channel = writer.add_channel(writer.add_schema("S", "ros2msg", ""), "/t", "cdr");
        const Bytes zeros(99'999'000);
        for (int i = 0; i < 4; ++i) {
            writer.write(channel, 1, zeros);
        }
        writer.close();
    }
    ASSERT_LT(std::filesystem::file_size(folder / "a.mcap"), 1'000'000u);
    expect_refused(folder / "a.mcap", "unpacks to more than");
    EXPECT_EQ(unpacked_allowance_bytes(0), 256'000'000u);
    EXPECT_EQ(unpacked_allowance_bytes(1'000'000'000), 4'000'000'000u);
}

TEST(McapReader, GivesUpOnAFileOfDamagedRecords) {
    const TestFolder folder;
    {
        Writer writer(folder / "a.mcap");
        const auto channel = writer.add_channel(writer.add_schema("S", "ros2msg", ""), "/t", "cdr");
        for (int i = 0; i < 100'001; ++i) {
            writer.write(channel, 1, {});
        }
        writer.close();
    }
    const auto refuse_all = [](const Contents&, const Message&) { throw Malformed("nonsense"); };
    try {
        (void)read(folder / "a.mcap", refuse_all);
        FAIL() << "was read";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("more than 100000 damaged records, first a nonsense"));
    }
}

TEST(McapWriter, IsAtItsPlaceOnlyWhenWhole) {
    const TestFolder folder;
    {
        Writer writer(folder / "a.mcap");
        const auto channel = writer.add_channel(writer.add_schema("S", "ros2msg", ""), "/t", "cdr");
        writer.write(channel, 1, bytes_of("x"));
        EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
    }  // dies without close()
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
    const ReadBack back = read_all(folder / "a.mcap.part");
    EXPECT_EQ(back.messages.size(), 1u);
    EXPECT_THAT(back.contents.damage, HasSubstr("not closed"));

    write_sample(folder / "a.mcap", true);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.mcap"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap.part"));
}

TEST(McapWriter, SaysWhereItCannotWrite) {
    const TestFolder folder;
    const auto message_of = [](const std::filesystem::path& path) -> std::string {
        try {
            Writer writer(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(message_of(folder / "no/such/folder.mcap"), HasSubstr("no/such/folder.mcap"));
    EXPECT_THAT(message_of(folder.path()), HasSubstr("is a directory"));
    EXPECT_THAT(message_of(folder / "new/"), HasSubstr("is a directory"));
    EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
}

TEST(McapWriter, AFullDiskIsSaidAndWhatIsThereStaysReadable) {
    const TestFolder folder;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);  // fwrite then fails as on a full disk
    const rlimit small{.rlim_cur = 20'000, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string said;
    try {
        write_sample(folder / "a.mcap", false);
    } catch (const InputError& error) {
        said = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);

    EXPECT_THAT(said, AllOf(HasSubstr("a.mcap.part: cannot write: "), HasSubstr("large")));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
    EXPECT_GT(read_all(folder / "a.mcap.part").messages.size(), 200u);
}

TEST(McapWriter, NothingIsWrittenAfterClose) {
    const TestFolder folder;
    Writer writer(folder / "a.mcap");
    const auto channel = writer.add_channel(writer.add_schema("S", "ros2msg", ""), "/t", "cdr");
    EXPECT_THROW(writer.write(9, 0, {}), InternalError);
    writer.close();
    EXPECT_THROW(writer.write(channel, 0, {}), InternalError);
    EXPECT_THROW(writer.close(), InternalError);
}

}  // namespace
}  // namespace limpet::mcap
