// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/mcap/writer.hpp"
#include "limpet/record/recorder.hpp"

namespace limpet::record {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

void record_flight(Recorder& recorder, int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
        Truth truth;
        truth.time_s = tick * 1e-3;
        truth.base.p_WF_m = {0.001 * tick, std::sin(0.1 * tick), std::cos(0.3 * tick)};
        truth.thrust_N = std::sqrt(tick);
        recorder.truth(truth);
        if (tick % 100 == 0) {
            recorder.event(make_event(truth.time_s, "guidance", EventName::level));
        }
    }
}

RecordingInfo short_info() {
    return {.scenario = "hover",
            .seed = 1,
            .version = "0.1.0",
            .attachments = {{"scenario.yaml", "text/yaml", "a: 1\n", 0},
                            {"model.xml", "text/xml", std::string(5000, 'x'), 0}},
            .range_sensor = {}};
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Recording, NamesWhatIsThereWhenAskedForWhatIsNot) {
    const TestFolder folder;
    Recorder recorder(folder / "a.mcap", short_info());
    record_flight(recorder, 3);
    recorder.finish("{}");
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_THAT(message_of([&] { (void)recording.series("/cup", "pressure_hPa"); }),
                AllOf(HasSubstr("a.mcap"), HasSubstr("no column pressure_hPa in /cup"),
                      HasSubstr("pressure_Pa, pull_N")));
    EXPECT_THAT(message_of([&] { (void)recording.series("/nose", "x"); }),
                AllOf(HasSubstr("no topic /nose"), HasSubstr("/truth/pose, /truth/twist")));
    EXPECT_EQ(recording.series("/truth/vehicle", "thrust_N").values.size(), 3u);
}

TEST(Recording, CutAnywhereItKeepsWhatWasWhole) {
    const TestFolder folder;
    {
        Recorder recorder(folder / "a.mcap", short_info());
        record_flight(recorder, 1500);
        recorder.finish("{}");
    }
    const mcap::Bytes file = load(folder / "a.mcap");
    ASSERT_GT(file.size(), 40 * 997u);
    const Recording whole = read_recording(folder / "a.mcap");
    EXPECT_EQ(whole.damage, "");
    const Series thrust = whole.series("/truth/vehicle", "thrust_N");

    std::size_t rows_before = 0;
    for (std::size_t cut = 997; cut < file.size(); cut += 997) {
        store(folder / "cut.mcap", mcap::ByteView(file).first(cut));
        const Recording part = read_recording(folder / "cut.mcap");
        EXPECT_NE(part.damage, "") << cut;
        EXPECT_EQ(part.damage.find('\n'), std::string::npos);
        if (cut > 6000) {  // attachments stand ahead of the data
            EXPECT_EQ(part.metadata.at("limpet").at("scenario"), "hover");
            ASSERT_NE(part.attachment("model.xml"), nullptr);
        }
        std::size_t rows = 0;
        if (!part.tables.empty()) {
            const Series kept = part.series("/truth/vehicle", "thrust_N");
            rows = kept.values.size();
            EXPECT_TRUE(std::equal(kept.values.begin(), kept.values.end(), thrust.values.begin()));
        }
        EXPECT_GE(rows, rows_before) << cut;
        rows_before = rows;
    }
    EXPECT_EQ(rows_before, thrust.values.size());
}

TEST(Recording, AFlightThatDiedIsReadFromItsPart) {
    const TestFolder folder;
    {
        Recorder recorder(folder / "a.mcap", short_info());
        record_flight(recorder, 500);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
    const Recording recording = read_recording(folder / "a.mcap.part");
    EXPECT_EQ(recording.series("/truth/pose", "pose.position.x").values.size(), 500u);
    EXPECT_EQ(recording.events.size(), 5u);
    EXPECT_THAT(recording.damage, AllOf(HasSubstr("not closed"), HasSubstr("0.499 s")));
    EXPECT_EQ(recording.attachment("summary.json"), nullptr);
}

TEST(Recording, ReadsOtherPeoplesTopicsAndNamesThoseItCannot) {
    const TestFolder folder;
    {
        mcap::Writer writer(folder / "a.mcap");
        const auto point = writer.add_schema("p/msg/P", "ros2msg", "float64 height_pa\n");
        const auto json = writer.add_schema("J", "jsonschema", "{}");
        const auto good = writer.add_channel(point, "/good", "cdr");
        const auto bad = writer.add_channel(json, "/bad", "json");
        const mcap::Bytes message = {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
        writer.write(good, 1, message);
        writer.write(bad, 2, message);
        writer.write(good, 3, mcap::ByteView(message).first(6));
        writer.close();
    }
    const Recording recording = read_recording(folder / "a.mcap");
    ASSERT_EQ(recording.tables.size(), 1u);
    EXPECT_EQ(recording.series("/good", "height_pa").values.size(), 1u);
    EXPECT_EQ(recording.damage,
              "1 damaged record left out, first a message that is shorter than its schema");
    EXPECT_THAT(recording.remarks,
                testing::ElementsAre("topic /bad is not taken: messages in \"json\" with a schema "
                                     "in \"jsonschema\"; those in cdr with a schema in ros2msg "
                                     "are"));
}

TEST(Recording, WhatDoesNotBecomeColumnsIsNamedAndNoDamage) {
    const TestFolder folder;
    {
        mcap::Writer writer(folder / "a.mcap");
        const mcap::Bytes message = {0, 1, 0, 0, 0, 0, 0, 0};
        const std::string end = "\n" + std::string(80, '=') + "\nMSG: p/";
        const std::pair<const char*, std::string> kinds[] = {
            {"p/msg/Cloud", "Point[] points" + end + "Point\nfloat64 x\n"},
            {"p/srv/Add_Event", "Add_Request[<=1] request" + end + "srv/Add_Request\nint64 a\n"},
            {"p/msg/Wide", "wstring text\n"}};
        for (const auto& [type, text] : kinds) {
            const auto schema = writer.add_schema(type, "ros2msg", text);
            writer.write(writer.add_channel(schema, type, "cdr"), 1, message);
        }
        writer.close();
    }
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_EQ(recording.damage, "");
    ASSERT_EQ(recording.remarks.size(), 3U);
    EXPECT_THAT(recording.remarks[0], HasSubstr("an array of messages: p/msg/Point points"));
    EXPECT_THAT(recording.remarks[1], HasSubstr("a service's events"));
    EXPECT_THAT(recording.remarks[2], HasSubstr("wstring"));
}

TEST(Recording, EventsOfAllChannelsAreInOrder) {
    const TestFolder folder;
    {
        mcap::Writer writer(folder / "a.mcap");
        const auto event = writer.add_schema("limpet_msgs/msg/Event", "ros2msg", "string name\n");
        const auto one = writer.add_channel(event, "/events", "cdr");
        const auto other = writer.add_channel(event, "/events", "cdr");
        const auto write = [&](std::uint16_t channel, std::uint64_t time_ns, char name) {
            writer.write(channel, time_ns,
                         mcap::Bytes{0, 1, 0, 0, 2, 0, 0, 0, static_cast<std::uint8_t>(name), 0});
        };
        write(one, 1, 'a');
        write(other, 2, 'b');
        write(one, 3, 'c');
        writer.close();
    }
    std::string names;
    for (const RecordedEvent& event : read_recording(folder / "a.mcap").events) {
        names += event.name;
    }
    EXPECT_EQ(names, "abc");
}

TEST(Recording, AClocksTimesCountFromTheFirstMessage) {
    const TestFolder folder;
    constexpr std::int64_t kBegins_ns = 1'710'000'000'000'000'003;
    {
        mcap::Writer writer(folder / "a.mcap");
        const auto point = writer.add_schema("p/msg/P", "ros2msg", "float64 height_pa\n");
        const auto channel = writer.add_channel(point, "/good", "cdr");
        const mcap::Bytes message = {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
        for (const std::int64_t after_ns : {0, 26'000'001, -1'000'000}) {
            writer.write(channel, kBegins_ns + after_ns, message);
        }
        writer.close();
    }
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_EQ(recording.origin_ns, std::uint64_t{kBegins_ns});
    EXPECT_THAT(
        recording.tables.at(0).time_s,
        testing::ElementsAre(0.0, testing::DoubleEq(0.026000001), testing::DoubleEq(-0.001)));
}

TEST(Recording, ATopicWithoutEndCostsThatTopicAlone) {
    const TestFolder folder;
    {
        mcap::Writer writer(folder / "a.mcap");
        const mcap::Bytes message = {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
        const auto good = writer.add_schema("p/msg/P", "ros2msg", "float64 x\n");
        writer.write(writer.add_channel(good, "/good", "cdr"), 1, message);
        const auto loop = writer.add_schema("p/msg/L", "ros2msg", "L again\n");
        for (int i = 0; i < 30; ++i) {
            writer.write(writer.add_channel(loop, "/loop" + std::to_string(i), "cdr"), 2, message);
        }
        writer.close();
    }
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_EQ(recording.tables.size(), 1u);
    EXPECT_THAT(recording.damage, AllOf(HasSubstr("/loop4 is not read: p/msg/L: message within"),
                                        HasSubstr("; 25 topics more are not read")));
}

TEST(Recording, WhatIsBeyondAllIsRefusedAsAWhole) {
    const TestFolder folder;
    {
        mcap::Writer writer(folder / "a.mcap");
        const auto wide = writer.add_schema("p/msg/W", "ros2msg",
                                            "uint8 x\n#" + std::string(2'100'000, '-') + "\n");
        for (const char* topic : {"/one", "/two"}) {
            writer.write(writer.add_channel(wide, topic, "cdr"), 1, mcap::Bytes{0, 1, 0, 0, 1});
        }
        writer.close();
    }
    EXPECT_EQ(message_of([&] { (void)read_recording(folder / "a.mcap"); }),
              (folder / "a.mcap").string() + ": more than 4000000 bytes of message definitions");
}

TEST(Recording, ASummaryThatIsNoFlightsIsNotTaken) {
    Recording recording;
    EXPECT_EQ(summary_text(recording), "");
    recording.attachments = {{"summary.json", "application/json", "{}", 0}};
    EXPECT_EQ(summary_text(recording), "{}");
    recording.attachments[0].text.assign(1'000'001, '[');
    EXPECT_EQ(summary_text(recording), "");
    EXPECT_EQ(begins_as_recording("\x89MCAP0\r\n"), true);
    EXPECT_EQ(begins_as_recording(std::string("\x04\x22\x4D\x18`@\x82x")), true);
    EXPECT_EQ(begins_as_recording(std::string("ULog\x01\x12\x35\x01")), false);
}

TEST(Recording, RefusesWhatIsNone) {
    const TestFolder folder;
    EXPECT_THROW((void)read_recording(folder / "none.mcap"), InputError);
    EXPECT_THROW((void)read_recording(folder.path()), InputError);
}

}  // namespace
}  // namespace limpet::record
