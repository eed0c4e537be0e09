// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/messages.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "message_table.hpp"
#include "samples.hpp"

namespace limpet::mavlink {
namespace {

const TableRow* row_of(std::uint32_t id) {
    for (const TableRow& row : kTable) {
        if (row.id == id) {
            return &row;
        }
    }
    return nullptr;
}

/// As in the table: "name@offset ...".
template <class Message>
std::string offsets_of() {
    constexpr auto& kPlace = kLayout<Message>;
    std::string text;
    for (const std::size_t i : kPlace.order) {
        if (!text.empty()) {
            text += ' ';
        }
        text += kPlace.shapes[i].name;
        text += '@';
        text += std::to_string(kPlace.offset[i]);
    }
    return text;
}

static_assert(kLayout<HilSensor>.crc_extra == 108, "computed when compiling");
static_assert(checksum(kChecksumSeed, std::string_view("123456789")) == 0x6F91,
              "check value of CRC-16/MCRF4XX");

TEST(Messages, LieOnTheWireAsInTheTable) {
    static_assert(std::tuple_size_v<AllMessages> == kTable.size());
    for_each_message([](const auto& message) {
        using Message = std::remove_cvref_t<decltype(message)>;
        SCOPED_TRACE(Message::kName);
        const TableRow* row = row_of(Message::kId);
        ASSERT_NE(row, nullptr);
        EXPECT_EQ(Message::kName, row->name);
        EXPECT_EQ(kLayout<Message>.payload_bytes, row->payload_bytes);
        EXPECT_EQ(kLayout<Message>.bytes_without_extensions, row->bytes_without_extensions);
        EXPECT_EQ(offsets_of<Message>(), row->offsets);
    });
}

TEST(Messages, HaveTheTablesCrcExtra) {
    for (const TableRow& row : kTable) {
        const MessageInfo* info = find_message(row.id);
        ASSERT_NE(info, nullptr) << row.name;
        EXPECT_EQ(info->crc_extra, row.crc_extra) << row.name;
        EXPECT_EQ(info->name, row.name);
    }
}

TEST(Messages, AreFoundByTheirIdAlone) {
    int found = 0;
    for (std::uint32_t id = 0; id < 70'000; ++id) {
        const MessageInfo* info = find_message(id);
        EXPECT_EQ(info != nullptr, row_of(id) != nullptr) << id;
        found += info != nullptr ? 1 : 0;
    }
    EXPECT_EQ(found, static_cast<int>(kTable.size()));
    EXPECT_EQ(find_message(0xFFFFFF), nullptr);
}

TEST(Texts, FillTheirFieldOrEndWithNul) {
    ParamSet set;
    set_text(set.param_id, "FD_FAIL_P");
    EXPECT_EQ(text_of(set.param_id), "FD_FAIL_P");
    EXPECT_EQ(set.param_id[9], '\0');
    set_text(set.param_id, "0123456789abcdef");
    EXPECT_EQ(text_of(set.param_id), "0123456789abcdef");
    set_text(set.param_id, "0123456789abcdefgh");
    EXPECT_EQ(text_of(set.param_id), "0123456789abcdef");
}

}  // namespace
}  // namespace limpet::mavlink
