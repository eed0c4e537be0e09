// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/messages.hpp"

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "limpet/mavlink/translate.hpp"
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
    std::string text;
    std::size_t offset = 0;
    Message message;
    for_each_field(message, [&](std::string_view name, const auto& value) {
        text += text.empty() ? "" : " ";
        text += std::string(name) + '@' + std::to_string(offset);
        offset += sizeof(value);
    });
    return text;
}

static_assert(HilSensor::kInfo.crc_extra == 108, "known when compiling");

TEST(FrameChecksum, HasTheCheckValueOfItsCrc) {  // CRC-16/MCRF4XX of 123456789
    constexpr std::array<std::uint8_t, 9> kBytes = {kStart2, '1', '2', '3', '4',
                                                    '5',     '6', '7', '8'};
    EXPECT_EQ(frame_checksum(kBytes, '9'), 0x6F91);
}

TEST(FrameChecksum, IsThatOfBoostAtEveryLength) {
    std::mt19937 random(16);  // NOLINT: the same bytes each time
    std::vector<std::uint8_t> bytes;
    for (std::size_t length = 1; length <= 280; ++length) {
        bytes.push_back(static_cast<std::uint8_t>(random()));
        const auto extra = static_cast<std::uint8_t>(random());
        boost::crc_optimal<16, 0x1021, 0xFFFF, 0, true, true> crc;
        crc.process_bytes(bytes.data() + 1, bytes.size() - 1);
        crc.process_byte(extra);
        ASSERT_EQ(frame_checksum(bytes, extra), crc.checksum()) << length;
    }
}

TEST(Messages, LieOnTheWireAsInTheTable) {
    static_assert(std::tuple_size_v<AllMessages> == kTable.size());
    for_each_message([](const auto& message) {
        using Message = std::remove_cvref_t<decltype(message)>;
        SCOPED_TRACE(Message::kName);
        const TableRow* row = row_of(Message::kId);
        ASSERT_NE(row, nullptr);
        EXPECT_EQ(Message::kName, row->name);
        EXPECT_EQ(Message::kInfo.payload_bytes, row->payload_bytes);
        EXPECT_EQ(Message::kInfo.bytes_without_extensions, row->bytes_without_extensions);
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

/// Masks as numbers, as PX4's and other ground stations' documentation has them.
TEST(Masks, AreTheNumbersOfTheWire) {
    EXPECT_EQ(kPositionYaw, 0x9F8);
    EXPECT_EQ(kPositionVelocityYaw, 0x9C0);
    EXPECT_EQ(kVelocityYaw, 0x9C7);
    EXPECT_EQ(kVelocityAccelerationYaw, 0x807);
    EXPECT_EQ(kAttitudeThrust, 7);
    EXPECT_EQ(kImuFields, 0x3FU);
    EXPECT_EQ(kMagnetometerFields, 0x1C0U);
    EXPECT_EQ(kBarometerFields, 0x1A00U);
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
