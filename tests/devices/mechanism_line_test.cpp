// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/mechanism_line.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace limpet::devices {
namespace {

std::string with_checksum(const std::string& text) {
    return fmt::format("{}*{:02X}", text, line_checksum(text));
}

std::vector<MechanismLine> all_of(MechanismParser& parser, std::string_view text) {
    std::vector<MechanismLine> lines;
    for (const char letter : text) {
        if (const auto line = parser.parse(static_cast<std::byte>(letter))) {
            lines.push_back(*line);
        }
    }
    return lines;
}

TEST(MechanismLine, ChecksumIsTheCatalogues) {
    // CRC-8/SMBUS in the catalogue of parametrised CRC algorithms
    EXPECT_EQ(line_checksum("123456789"), 0xF4);
    EXPECT_EQ(line_checksum(""), 0x00);
}

TEST(MechanismLine, TheLinesOfTheDocumentationAreRight) {
    MechanismBuffer buffer;
    EXPECT_EQ(encode({.pump_on = true, .valve_open = false}, buffer), "P1 V0*E4\n");
    const auto command = decode_line("P1 V0*E4");
    ASSERT_TRUE(command);
    EXPECT_EQ(command->pump_on, true);
    EXPECT_EQ(command->valve_open, false);
    EXPECT_FALSE(command->force_N);

    const auto report = decode_line(with_checksum("P1 V0 F-12.30 A88123"));
    ASSERT_TRUE(report);
    EXPECT_DOUBLE_EQ(*report->force_N, -12.3);
    EXPECT_EQ(report->pressure_Pa, 88123.0);
}

TEST(MechanismLine, GoesThereAndBack) {
    for (const double force_N : {-12.34, 0.0, 40.5}) {
        for (const bool pump : {false, true}) {
            MechanismBuffer buffer;
            std::string text(encode(
                {.pump_on = pump, .valve_open = !pump, .force_N = force_N, .pressure_Pa = 27451.0},
                buffer));
            text.pop_back();
            const auto back = decode_line(text);
            ASSERT_TRUE(back) << text;
            EXPECT_EQ(back->pump_on, pump);
            EXPECT_EQ(back->valve_open, !pump);
            EXPECT_NEAR(*back->force_N, force_N, 1e-9);
            EXPECT_EQ(back->pressure_Pa, 27451.0);
        }
    }
}

TEST(MechanismLine, EveryWrongLetterIsFoundOut) {
    const std::string right = with_checksum("P1 V0 F-12.30 A88123");
    for (std::size_t i = 0; i < right.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string wrong = right;
            wrong[i] = static_cast<char>(wrong[i] ^ (1 << bit));
            EXPECT_FALSE(decode_line(wrong)) << wrong;
        }
    }
}

TEST(MechanismLine, FieldsThatSayNothingAreRefused) {
    for (const char* text : {"P2", "P", "P1 P1", "V0.5", "F", "F-", "F.", "F1e3", "Fnan", "A1 ",
                             " A1", "P1  V0", "F1.2.3", "p1", "A10000001", "*1"}) {
        EXPECT_FALSE(decode_line(with_checksum(text))) << text;
    }
    EXPECT_FALSE(decode_line("P1"));
    EXPECT_FALSE(decode_line("*00"));
    EXPECT_FALSE(decode_line(""));
    EXPECT_FALSE(decode_line("\r"));
}

TEST(MechanismLine, ANewerDeviceMaySayMore) {
    const auto line = decode_line(with_checksum("P1 V0 T23.5 A100000"));
    ASSERT_TRUE(line);
    EXPECT_EQ(line->pressure_Pa, 100000.0);
}

TEST(MechanismLine, TheParserFindsTheNextLineBehindGarbage) {
    MechanismParser parser;
    const std::string right = with_checksum("P1 V0");
    EXPECT_TRUE(all_of(parser, "\xff\xfe V0*E4\n").empty());
    EXPECT_EQ(all_of(parser, right + "\r\n").size(), 1U);
    EXPECT_TRUE(all_of(parser, std::string(500, 'P') + right + "\n").empty());
    EXPECT_EQ(all_of(parser, right + "\n" + right + "\n").size(), 2U);
}

TEST(MechanismLine, TheLongestLineThatIsMadeIsReadWhole) {
    MechanismBuffer buffer;
    const std::string_view longest =
        encode({.pump_on = true, .valve_open = true, .force_N = -1e6, .pressure_Pa = 1e6}, buffer);
    EXPECT_LE(longest.size(), kMechanismLongestLine);
    MechanismParser parser;
    EXPECT_EQ(all_of(parser, longest).size(), 1U);
}

}  // namespace
}  // namespace limpet::devices
