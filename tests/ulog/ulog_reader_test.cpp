// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../support/allocations.hpp"
#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/ulog/ulog.hpp"

namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

using testing::ElementsAre;
using testing::HasSubstr;

std::string bytes(const auto& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}
std::string message(char type, const std::string& content) {
    return bytes(static_cast<std::uint16_t>(content.size())) + type + content;
}
const std::string kHead = std::string("ULog\x01\x12\x35\x01", 8) + bytes(std::uint64_t{7});

/// A topic with an array, a message in it, padding, and a second instance.
std::string log_of_two() {
    std::string log = kHead + message('B', std::string(40, '\0'));
    log += message('F', "inner:float a;uint8_t b;uint8_t[3] _padding0;");
    log += message('F', "outer:uint64_t timestamp;float[2] xy;inner[2] part;char[4] name;");
    log += message('A', std::string(1, '\0') + bytes(std::uint16_t{5}) + "outer");
    log += message('A', std::string(1, '\1') + bytes(std::uint16_t{6}) + "outer");
    for (const std::uint16_t id : std::initializer_list<std::uint16_t>{5, 6, 5}) {
        const auto k = static_cast<float>(id);
        log +=
            message('D', bytes(id) + bytes(std::uint64_t{2'500'000}) + bytes(k) + bytes(2 * k) +
                             bytes(3 * k) + '\7' + "pad" + bytes(4 * k) + '\10' + "pad" + "text");
    }
    return log + message('L', "6" + bytes(std::uint64_t{1}) + "a text");
}

Recording read(const TestFolder& folder, const std::string& log) {
    const auto path = folder.path() / "x.ulg";
    std::ofstream(path, std::ios::binary) << log;
    return read_ulog(path);
}

std::string refusal(const TestFolder& folder, const std::string& log) {
    try {
        (void)read(folder, log);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

TEST(UlogReader, ReadsArraysPartsAndInstances) {
    const TestFolder folder;
    const Recording log = read(folder, log_of_two());
    ASSERT_EQ(log.tables.size(), 2U);
    EXPECT_EQ(log.tables[1].topic, "outer.1");
    EXPECT_THAT(log.table("outer").time_s, ElementsAre(2.5, 2.5));
    EXPECT_THAT(log.series("outer", "xy[1]").values, ElementsAre(10.0, 10.0));
    EXPECT_THAT(log.series("outer", "part[1].a").values, ElementsAre(20.0, 20.0));
    EXPECT_THAT(log.series("outer.1", "part[0].b").values, ElementsAre(7.0));
    EXPECT_EQ(log.table("outer").columns.size(), 6U);  // neither padding nor text
    EXPECT_TRUE(log.damage.empty());
}

TEST(UlogReader, ReadsOneThatIsCutShortAnywhere) {
    const TestFolder folder;
    const std::string whole = log_of_two();
    for (std::size_t length = kHead.size(); length < whole.size(); ++length) {
        EXPECT_NO_THROW((void)read(folder, whole.substr(0, length))) << length;
    }
    EXPECT_THAT(read(folder, whole.substr(0, whole.size() - 3)).damage, HasSubstr("in the middle"));
}

TEST(UlogReader, RefusesWhatIsNoneInALine) {
    const TestFolder folder;
    EXPECT_THAT(refusal(folder, "PK\3\4"), HasSubstr("is no log of PX4's"));
    EXPECT_THAT(refusal(folder, kHead.substr(0, 9)), HasSubstr("ends in its head"));
    // Nothing but padding, ten thousand times ten thousand times ...
    EXPECT_THAT(
        refusal(folder, kHead + message('F', "x:uint64_t timestamp;y[9999] a;") +
                            message('F', "y:z[9999] a;") + message('F', "z:w[9999] a;") +
                            message('F', "w:uint8_t _padding0;") +
                            message('A', std::string(1, '\0') + bytes(std::uint16_t{0}) + "x")),
        HasSubstr("the format of \"x\" cannot be read: "));
    EXPECT_THAT(refusal(folder, kHead + message('F', "nameless")), HasSubstr("without a name"));
    const std::string of = message('A', std::string(1, '\0') + bytes(std::uint16_t{0}) + "x");
    for (const char* format :
         {"x:uint64_t timestamp;x[2] self;", "x:uint64_t timestamp;float[z] a;",
          "x:uint64_t timestamp;float[99999] a;", "x:float a;", "x:y a;"}) {
        EXPECT_THAT(refusal(folder, kHead + message('F', format) + of),
                    HasSubstr("the format of \"x\" cannot be read: "))
            << format;
    }
}

std::string subscription(std::uint16_t id, const std::string& type, char instance = 0) {
    return message('A', instance + bytes(id) + type);
}

/// What is kept in memory, in time that nobody notices: a refusal, or what little there is to read.
TEST(UlogReader, ASmallFileTakesLittleMemory) {
    const TestFolder folder;
    const std::string name(60'000, 'n');
    const std::string whole = message('D', bytes(std::uint16_t{1}) + std::string(100, '\0'));

    EXPECT_THAT(refusal(folder, kHead + message('F', "a:uint64_t timestamp;float[9000] " + name) +
                                    subscription(1, "a") + whole),
                HasSubstr("a field's name of 60000 characters, allowed 1..128"));

    std::string nested = kHead + message('F', "a:uint64_t timestamp;t0 " + name);
    for (int level = 0; level < 6; ++level) {
        nested += message('F', fmt::format("t{}:t{} {}", level, level + 1, name));
    }
    nested += message('F', "t6:float[9000] " + name) + subscription(1, "a") + whole;
    EXPECT_THAT(refusal(folder, nested), HasSubstr("a field's name of 60000 characters"));

    std::string texts = kHead + message('F', "a:uint64_t timestamp;char[9990] c");
    std::string again = kHead + message('F', "a:uint64_t timestamp;float[9000] x");
    for (int k = 0; k < 65'536; ++k) {
        texts += subscription(static_cast<std::uint16_t>(k), "a");
        again += subscription(1, "a", static_cast<char>(k % 4));
    }
    const std::uint64_t before = allocated_bytes();
    EXPECT_TRUE(read(folder, texts).tables.empty());
    EXPECT_TRUE(read(folder, again).tables.empty());
    EXPECT_LT(allocated_bytes() - before, 200'000'000U);

    std::string instances = kHead + message('F', "a:uint64_t timestamp;float[9000] x");
    for (int k = 0; k < 256; ++k) {
        instances += subscription(static_cast<std::uint16_t>(k), "a", static_cast<char>(k));
    }
    EXPECT_THAT(refusal(folder, instances), HasSubstr("x.ulg: more than 100000 fields"));
}

/// Definitions that are short, and gone through for ever.
TEST(UlogReader, ADefinitionTakesNoTime) {
    const TestFolder folder;
    std::string log = kHead + message('F', "a:uint64_t timestamp;b[9000] x") +
                      message('F', "b:" + std::string(60'000, ';'));
    for (int k = 0; k < 50; ++k) {
        log += message('F', fmt::format("a{}:uint64_t timestamp;b[9000] x", k)) +
               subscription(static_cast<std::uint16_t>(k), fmt::format("a{}", k));
    }
    EXPECT_THAT(refusal(folder, log), HasSubstr("more than 4000000 bytes of message definitions"));
}

/// Rows of eight bytes in a table of nine thousand columns.
TEST(UlogReader, ATableIsBoundedByTheFile) {
    const TestFolder folder;
    std::string log =
        kHead + message('F', "a:uint64_t timestamp;float[9000] x") + subscription(1, "a");
    for (int row = 0; row < 2000; ++row) {
        log += message('D', bytes(std::uint16_t{1}) + bytes(std::uint64_t{1}));
    }
    EXPECT_THAT(refusal(folder, log), HasSubstr("more than 32 MB in memory"));
}

TEST(UlogReader, ATopicThatIsSubscribedAgainGoesOn) {
    const TestFolder folder;
    const auto row = [](std::uint16_t id, std::uint64_t t_us, float x) {
        return message('D', bytes(id) + bytes(t_us) + bytes(x));
    };
    const std::string format = "a:uint64_t timestamp;float x";
    const Recording log =
        read(folder, kHead + message('F', format) + message('F', format) + subscription(1, "a") +
                         row(1, 1'000'000, 2.5F) + subscription(2, "a") + row(2, 2'000'000, 3.5F));
    ASSERT_EQ(log.tables.size(), 1U);
    EXPECT_THAT(log.table("a").time_s, ElementsAre(1.0, 2.0));
    EXPECT_THAT(log.series("a", "x").values, ElementsAre(2.5, 3.5));
    EXPECT_THAT(refusal(folder, kHead + message('F', format) +
                                    message('F', "a:uint64_t timestamp;double x")),
                HasSubstr("two formats of \"a\" that are not alike"));
}

const std::string kSync = message('S', "\x2F\x73\x13\x20\x25\x0C\xBB\x12");

/// Bytes that are lost in the middle: what follows would be read askew, as numbers.
TEST(UlogReader, BehindADamageItGoesOnWhereMessagesBeginAgain) {
    const TestFolder folder;
    const std::string head =
        kHead + message('F', "a:uint64_t timestamp;float x") + subscription(1, "a");
    const auto row = [](float x) {
        return message('D', bytes(std::uint16_t{1}) + bytes(std::uint64_t{1}) + bytes(x));
    };
    const std::string lost = row(2.0F).substr(5);
    const Recording log = read(folder, head + row(1.0F) + lost + row(3.0F) + kSync + row(4.0F));
    EXPECT_THAT(log.series("a", "x").values, ElementsAre(1.0, 4.0));
    EXPECT_THAT(log.damage, HasSubstr("no message begins at byte"));
    const Recording without = read(folder, head + row(1.0F) + lost + row(3.0F));
    EXPECT_THAT(without.series("a", "x").values, ElementsAre(1.0));
    EXPECT_THAT(without.damage, HasSubstr("no message begins at byte"));
    const Recording astray = read(folder, head + row(1.0F) + message('D', std::string(12, '\7')));
    EXPECT_THAT(astray.damage, HasSubstr("under number 1799, which stands for no topic"));
    const Recording later = read(folder, head + message('Z', "of a later version") + row(1.0F));
    EXPECT_THAT(later.series("a", "x").values, ElementsAre(1.0));
    EXPECT_EQ(later.damage, "");
}

TEST(UlogReader, WhatWasAppendedIsRead) {
    const TestFolder folder;
    const std::string format = message('F', "a:uint64_t timestamp;float x");
    const auto row = [](float x) {
        return message('D', bytes(std::uint16_t{1}) + bytes(std::uint64_t{1}) + bytes(x));
    };
    const auto log_with = [&](char needed, std::uint64_t appended) {
        return kHead +
               message('B', std::string(8, '\0') + needed + std::string(7, '\0') + bytes(appended) +
                                std::string(16, '\0')) +
               format + subscription(1, "a") + row(1.0F) + row(2.0F).substr(0, 7);
    };
    const std::uint64_t cut = log_with('\1', 0).size();
    const Recording log = read(folder, log_with('\1', cut) + row(3.0F));
    EXPECT_THAT(log.series("a", "x").values, ElementsAre(1.0, 3.0));
    EXPECT_EQ(log.damage, "");
    EXPECT_THAT(refusal(folder, log_with('\2', 0)), HasSubstr("of a newer kind than 1"));
    EXPECT_NE(read(folder, log_with('\1', 1U << 30U) + row(3.0F)).damage, "");
}

TEST(UlogReader, WhatIsNotInAMessageIsNoNumber) {
    const TestFolder folder;
    const Recording log =
        read(folder, kHead + message('F', "a:uint64_t timestamp;float x;double y") +
                         subscription(1, "a") +
                         message('D', bytes(std::uint16_t{1}) + bytes(std::uint64_t{1}) +
                                          bytes(2.5F) + bytes(7.0).substr(0, 5)));
    EXPECT_THAT(log.series("a", "x").values, ElementsAre(2.5));
    EXPECT_TRUE(std::isnan(log.series("a", "y").values[0]));
}

}  // namespace
}  // namespace limpet::ulog
