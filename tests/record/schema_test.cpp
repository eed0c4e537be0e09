// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "limpet/core/errors.hpp"
#include "limpet/mcap/format.hpp"
#include "limpet/record/table.hpp"
#include "limpet/record/topics.hpp"
#include "limpet/record/units.hpp"

namespace limpet::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> column_names(const Table& table) {
    std::vector<std::string> names;
    for (const Column& column : table.columns) {
        names.push_back(column.name);
    }
    return names;
}

template <class Action>
std::string input_error(Action&& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Schema, ReadsEveryKindOfLine) {
    const MessageType type = parse_message_type("p/T", R"(
# a comment
uint8 A=1
string B = "x"   # a constant
float64 x        # a field
float64 y 3.5
string<=8 name "none"
int32[3] fixed
float32[] dynamic
float32[<=5] bounded
Other sibling
q/Far[2] far
Header header
builtin_interfaces/Time stamp
)");
    EXPECT_EQ(type.name, "p/msg/T");
    ASSERT_EQ(type.fields.size(), 10u);
    EXPECT_EQ(type.fields[0].name, "x");
    EXPECT_EQ(type.fields[2].primitive, Primitive::string);
    EXPECT_EQ(type.fields[2].shape, Field::Shape::single);
    EXPECT_EQ(type.fields[3].shape, Field::Shape::fixed_array);
    EXPECT_EQ(type.fields[3].count, 3u);
    EXPECT_EQ(type.fields[4].shape, Field::Shape::dynamic_array);
    EXPECT_EQ(type.fields[5].shape, Field::Shape::dynamic_array);
    EXPECT_EQ(type.fields[6].nested_type, "p/msg/Other");
    EXPECT_EQ(type.fields[7].nested_type, "q/msg/Far");
    EXPECT_EQ(type.fields[7].count, 2u);
    EXPECT_EQ(type.fields[8].nested_type, "std_msgs/msg/Header");
    EXPECT_EQ(type.fields[9].primitive, Primitive::time);
}

TEST(Schema, SaysWhichLineIsWrong) {
    EXPECT_THAT(input_error([] { (void)parse_message_type("p/T", "float64 x\nfloat64\n"); }),
                HasSubstr("p/msg/T line 2: no field name"));
    EXPECT_THAT(input_error([] { (void)parse_message_type("p/T", "float64[two] x\n"); }),
                HasSubstr("array length is not a positive number: two"));
    EXPECT_THAT(input_error([] {
                    (void)parse_ros2msg("p/T", "uint8 a\n" + std::string(80, '=') + "\nuint8 b\n");
                }),
                HasSubstr("MSG:"));
}

TEST(MessageDefinitions, EveryTopicHasASchemaThatCanBeFlattened) {
    for (const TopicInfo& topic : kTopics) {
        Table table;
        const auto types = parse_ros2msg(std::string(topic.type), ros2msg_schema(topic.type));
        EXPECT_EQ(types.front().name, topic.type);
        Allowance allowance;
        EXPECT_NO_THROW(TableReader(types, table, allowance)) << topic.type;
        EXPECT_FALSE(table.columns.empty());
    }
}

TEST(MessageDefinitions, OursFollowRosAndCarryUnits) {
    // rosidl accepts no other field names.
    const std::regex allowed("^(?!.*__)(?!.*_$)[a-z][a-z0-9_]*$");
    const std::regex united(
        ".*_(rad|m|m_s|m_s2|rad_s|n|n_m|pa|v|a|j)$|.*(remaining|thrust|command|values|parted|nees|"
        "nis)$");
    for (const MessageDefinition& definition : message_definitions()) {
        const auto type =
            parse_message_type(std::string(definition.type), std::string(definition.text));
        const bool ours = type.name.rfind("limpet_msgs/", 0) == 0;
        for (const Field& field : type.fields) {
            EXPECT_TRUE(std::regex_match(field.name, allowed)) << type.name << " " << field.name;
            if (ours && field.nested_type.empty() && field.primitive == Primitive::float64) {
                EXPECT_TRUE(std::regex_match(field.name, united)) << type.name << " " << field.name;
            }
        }
    }
}

TEST(MessageDefinitions, ConcatenatesAsRosDoes) {
    EXPECT_EQ(ros2msg_schema("limpet_msgs/msg/GuidanceState"),
              "builtin_interfaces/Time stamp\nstring state\nint32 attempt\n" +
                  std::string(80, '=') +
                  "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
    EXPECT_THROW((void)ros2msg_schema("p/msg/Unknown"), InternalError);
}

TEST(Units, ColumnsAreWrittenAsInTheHouse) {
    const auto ours = [](const char* field) {
        return column_name("limpet_msgs/msg/CupState", field);
    };
    EXPECT_EQ(ours("pressure_pa"), "pressure_Pa");
    EXPECT_EQ(ours("peel_n_m"), "peel_N_m");
    EXPECT_EQ(ours("pull_n"), "pull_N");
    EXPECT_EQ(ours("battery_voltage_v"), "battery_voltage_V");
    EXPECT_EQ(ours("rotor_speed_rad_s[3]"), "rotor_speed_rad_s[3]");
    EXPECT_EQ(ours("force_n[0]"), "force_N[0]");
    EXPECT_EQ(column_name("other_msgs/msg/X", "pressure_pa"), "pressure_pa");

    EXPECT_EQ(column_name_with_unit("geometry_msgs/msg/PoseStamped", "pose.position.x"),
              "pose.position.x_m");
    EXPECT_EQ(column_name_with_unit("geometry_msgs/msg/PoseStamped", "pose.orientation.x"),
              "pose.orientation.x");
    EXPECT_EQ(column_name_with_unit("sensor_msgs/msg/Range", "range"), "range_m");
    EXPECT_EQ(column_name_with_unit("limpet_msgs/msg/CupState", "stamp"), "stamp_s");
}

class TableReaderTest : public testing::Test {
protected:
    Allowance allowance;
};

TEST_F(TableReaderTest, AlignsAsCdrDoes) {
    const auto types = parse_ros2msg("p/T",
                                     "bool b\nfloat64 x\nuint8 c\nint16 d\nstring s\n"
                                     "float32 f\nbuiltin_interfaces/Time t\n");
    Table table;
    TableReader reader(types, table, allowance);
    const std::vector<std::uint8_t> message = {
        0, 1, 0,    0,                             // little-endian CDR
        1, 0, 0,    0,    0,    0,    0,    0,     // true, then 7 bytes up to 8
        0, 0, 0,    0,    0,    0,    0xF8, 0x3F,  // 1.5
        7, 0, 0xFE, 0xFF,                          // 7, a byte, -2
        3, 0, 0,    0,    'h',  'i',  0,    0,     // "hi" with its zero, a byte up to 28
        0, 0, 0x20, 0x40,                          // 2.5
        2, 0, 0,    0,    0x00, 0x65, 0xCD, 0x1D,  // 2 s and 500,000,000 ns
    };
    reader.append(9'000'000'000, message);
    EXPECT_THAT(column_names(table), ElementsAre("b", "x", "c", "d", "f", "t"));
    const std::vector<double> expected = {1.0, 1.5, 7.0, -2.0, 2.5, 2.5};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_THAT(table.columns[i].values, ElementsAre(expected[i])) << i;
    }
    EXPECT_THAT(table.find_text("s")->values, ElementsAre("hi"));
    EXPECT_THAT(table.time_s, ElementsAre(9.0));
}

TEST_F(TableReaderTest, FlattensMessagesWithinMessagesAndArrays) {
    const std::string text =
        "q/In[2] in\nuint8[] list\n" + std::string(80, '=') + "\nMSG: q/In\nuint8 a\nuint8 b\n";
    Table table;
    TableReader reader(parse_ros2msg("p/T", text), table, allowance);
    reader.append(0, std::vector<std::uint8_t>{0, 1, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0});
    reader.append(1'000'000'000,
                  std::vector<std::uint8_t>{0, 1, 0, 0, 5, 6, 7, 8, 2, 0, 0, 0, 9, 10});
    EXPECT_THAT(column_names(table), ElementsAre("in[0].a", "in[0].b", "in[1].a", "in[1].b",
                                                 "list.length", "list[0]", "list[1]"));
    EXPECT_THAT(table.find("in[1].a")->values, ElementsAre(3.0, 7.0));
    EXPECT_THAT(table.find("list.length")->values, ElementsAre(0.0, 2.0));
    EXPECT_TRUE(std::isnan(table.find("list[1]")->values[0]));
    EXPECT_EQ(table.find("list[1]")->values[1], 10.0);
}

TEST_F(TableReaderTest, AShortMessageLeavesNoHalfRow) {
    Table table;
    TableReader reader(parse_ros2msg("p/T", "uint8[] list\nfloat64 x\nstring s\n"), table,
                       allowance);
    const std::vector<std::vector<std::uint8_t>> broken = {
        {},
        {0, 1, 0, 0},
        {0, 0, 0, 0, 0, 0, 0, 0},                          // big-endian
        {0, 1, 0, 0, 1, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0},  // x is cut off
        {0, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 1, 2, 3},     // 4 billion elements
    };
    for (const auto& message : broken) {
        EXPECT_THROW(reader.append(0, message), mcap::Malformed);
        EXPECT_TRUE(table.time_s.empty());
        EXPECT_TRUE(std::all_of(table.columns.begin(), table.columns.end(),
                                [](const Column& c) { return c.values.empty(); }));
        EXPECT_TRUE(table.texts.front().values.empty());
    }
}

TEST_F(TableReaderTest, RefusesSchemasWithoutEnd) {
    const auto refused = [this](const std::string& text) {
        return input_error([&] {
            Table table;
            TableReader reader(parse_ros2msg("p/T", text), table, allowance);
        });
    };
    EXPECT_THAT(refused("p/T again\n"), HasSubstr("message within itself"));
    EXPECT_THAT(refused("p/Unknown x\n"), HasSubstr("unknown type: p/msg/Unknown"));
    EXPECT_THAT(refused("p/T[] list\n"), HasSubstr("an array of messages: p/msg/T list"));
    EXPECT_THAT(refused("float64[999999999] x\n"), HasSubstr("more than 10000 fields"));
    EXPECT_THAT(refused("float64 " + std::string(129, 'x') + "\n"), HasSubstr("allowed 1..128"));
}

/// Messages that hold no value cost time all the same.
TEST_F(TableReaderTest, CountsFieldsWithoutAColumn) {
    const std::string separator(80, '=');
    const auto refused = [this](const std::string& text) {
        return input_error([&] {
            Table table;
            TableReader reader(parse_ros2msg("p/T", text), table, allowance);
        });
    };
    EXPECT_THAT(refused("E[4294967295] x\n" + separator + "\nMSG: p/E\n"),
                HasSubstr("more than 10000 fields"));
    std::string tree = "T1 a\nT1 b\n";
    for (int depth = 1; depth < 16; ++depth) {  // 2^16 leaves
        tree += separator + "\nMSG: p/T" + std::to_string(depth) + "\n";
        for (const char* name : {"a", "b"}) {
            tree += "T" + std::to_string(depth + 1) + " " + name + "\n";
        }
    }
    EXPECT_THAT(refused(tree + separator + "\nMSG: p/T16\n"), HasSubstr("more than 10000 fields"));
}

/// ROS 2 gives a message without fields a byte, in which a constant is no field.
TEST_F(TableReaderTest, ANestedMessageWithoutFieldsIsAByte) {
    const std::string end = "\n" + std::string(80, '=') + "\nMSG: p/";
    Table table;
    TableReader reader(parse_ros2msg("p/T", "uint8 a\nE e\nuint8 b\nE[3] list\nfloat64 c" + end +
                                                "E\nuint8 KIND=3\n"),
                       table, allowance);
    const std::vector<std::uint8_t> message = {0, 1, 0, 0,                  // head
                                               7, 0, 8, 0, 0, 0, 0, 0,      // and two up to 8
                                               0, 0, 0, 0, 0, 0, 4, 0x40};  // 2.5
    reader.append(1, message);
    EXPECT_EQ(table.columns.size(), 3U);
    EXPECT_EQ(table.find("a")->values[0], 7.0);
    EXPECT_EQ(table.find("b")->values[0], 8.0);
    EXPECT_EQ(table.find("c")->values[0], 2.5);
    EXPECT_THROW(reader.append(2, std::span(message).first(8)), mcap::Malformed);
    EXPECT_EQ(table.time_ns.size(), 1U);
}

TEST_F(TableReaderTest, WholeNumbersKeepTheirDigits) {
    Table table;
    TableReader reader(
        parse_ros2msg("p/T", "uint64 u\nint64 i\nbuiltin_interfaces/Time t\nuint64[] list\n"),
        table, allowance);
    std::vector<std::uint8_t> message = {0, 1, 0, 0};
    const auto put = [&message](auto value) {
        for (std::size_t k = 0; k < sizeof value; ++k) {
            message.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
        }
    };
    put(std::uint64_t{1'700'000'000'123'456'789});
    put(std::int64_t{-9'007'199'254'740'993});
    put(std::int32_t{1'700'000'000});
    put(std::uint32_t{123'456'789});
    put(std::uint32_t{1});
    put(std::uint32_t{0});
    put(~std::uint64_t{0});
    reader.append(1'700'000'000'000'000'001, message);
    EXPECT_EQ(table.time_ns[0], 1'700'000'000'000'000'001U);
    EXPECT_EQ(table.find("u")->whole[0], 1'700'000'000'123'456'789);
    EXPECT_EQ(table.find("u")->values[0], 1'700'000'000'123'456'789.0);
    EXPECT_EQ(table.find("i")->whole[0], -9'007'199'254'740'993);
    EXPECT_EQ(table.find("t")->whole[0], 1'700'000'000'123'456'789);
    EXPECT_EQ(table.find("list[0]")->kind, Whole::uint64);
    EXPECT_EQ(table.find("list[0]")->whole[0], -1);
    EXPECT_EQ(table.find("list[0]")->values[0], 18'446'744'073'709'551'615.0);
    EXPECT_THROW(reader.append(2, std::span(message).first(10)), mcap::Malformed);
    EXPECT_EQ(table.find("u")->whole.size(), 1U);
}

TEST(Schema, NamesOfServicesStay) {
    EXPECT_EQ(full_type_name("p/T"), "p/msg/T");
    EXPECT_EQ(full_type_name("p/msg/T"), "p/msg/T");
    EXPECT_EQ(full_type_name("p/srv/T_Event"), "p/srv/T_Event");
}

TEST_F(TableReaderTest, TheAllowanceIsTheWholeRecordings) {
    const auto many = parse_ros2msg("p/T", "uint8[6000] x\n");
    const auto open = [&](int times) {
        return input_error([&] {
            for (int i = 0; i < times; ++i) {
                Table table;
                TableReader reader(many, table, allowance);
            }
        });
    };
    EXPECT_EQ(open(16), "");
    EXPECT_EQ(open(1), "more than 100000 fields in its messages");
    EXPECT_EQ(input_error([&] { allowance.take_definition(4'000'001); }),
              "more than 4000000 bytes of message definitions");
}

/// Rows of four bytes, a column of 64 elements behind each array: a small file, a large table.
TEST_F(TableReaderTest, TheMemoryOfATableIsBounded) {
    Allowance little(1'000'000);
    Table table;
    TableReader reader(parse_ros2msg("p/T", "uint8[] list\n"), table, little);
    std::vector<std::uint8_t> full = {0, 1, 0, 0, 64, 0, 0, 0};
    full.resize(72, 1);
    const std::vector<std::uint8_t> empty = {0, 1, 0, 0, 0, 0, 0, 0};
    reader.append(0, full);
    EXPECT_EQ(input_error([&] {
                  for (int row = 0; row < 2000; ++row) {
                      reader.append(1'000'000'000, empty);
                  }
              }),
              "more than 1 MB in memory");
    EXPECT_THROW(TableReader(parse_ros2msg("p/T", "uint8[9999] x\n"), table, little), TooMuch);
}

TEST_F(TableReaderTest, AnArrayGrowsNoMoreColumnsThanFieldsAreAllowed) {
    std::string text;
    for (int i = 0; i < 157; ++i) {  // 157 * 65 columns
        text += "uint8[] c" + std::to_string(i) + "\n";
    }
    Table table;
    TableReader reader(parse_ros2msg("p/T", text), table, allowance);
    std::vector<std::uint8_t> message = {0, 1, 0, 0};
    for (int i = 0; i < 157; ++i) {
        message.insert(message.end(), {64, 0, 0, 0});
        message.insert(message.end(), 64, 1);
    }
    EXPECT_THAT(input_error([&] { reader.append(0, message); }),
                HasSubstr("more than 10000 fields"));
}

/// For others, who read it by its definition.
TEST(Schema, APayloadsColumnsAreItsMessages) {
    const auto fields = [](const std::string& text) {
        std::vector<std::string> names;
        const auto types = parse_ros2msg(std::string(kPayloadType), text);
        for (const Field& field : types.front().fields) {
            names.push_back(field.name);
        }
        return names;
    };
    EXPECT_EQ(fields(ros2msg_schema(kPayloadType)), fields(column_schema(kPayloadColumns)));
}

}  // namespace
}  // namespace limpet::record
