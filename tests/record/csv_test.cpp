// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Recording sample() {
    Recording recording;
    recording.tables.push_back({.topic = "/truth/pose",
                                .type = "geometry_msgs/msg/PoseStamped",
                                .time_s = {0.0, 0.001},
                                .columns = {{"header.stamp", {0.0, 0.001}},
                                            {"pose.position.x", {0.1, -1e-300}},
                                            {"pose.orientation.w", {1.0, 0.5}}},
                                .texts = {{"header.frame_id", {"map", "a,\"b\""}}}});
    recording.tables.push_back({.topic = "/cup",
                                .type = "limpet_msgs/msg/CupState",
                                .time_s = {0.5},
                                .columns = {{"pressure_Pa", {101325.0}},
                                            {"gap_m", {std::numeric_limits<double>::infinity()}}},
                                .texts = {}});
    recording.tables.push_back({.topic = "/events",
                                .type = "limpet_msgs/msg/Event",
                                .time_s = {1.0},
                                .columns = {},
                                .texts = {}});
    recording.events = {
        {1.0, "guidance", "impact", "below -20 N, twice", {{"force_N", -30.5}, {"speed_m_s", 1.1}}},
        {2.0, "cup", "attached", "", {}}};
    return recording;
}

TEST(Csv, QuotesAsRfc4180) {
    EXPECT_EQ(csv_field("plain text"), "plain text");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("say \"no\""), "\"say \"\"no\"\"\"");
    EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csv_field(""), "");
}

TEST(Csv, StopsWhereItIsAsked) {
    const TestFolder folder;
    const std::atomic<bool> stop = true;
    EXPECT_THROW((void)write_csv(sample(), folder / "made", {.stop = &stop}), Interrupted);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "made"));
}

TEST(Csv, OneFileATopicWithUnits) {
    const TestFolder folder;
    const auto files = write_csv(sample(), folder / "made/here");
    EXPECT_THAT(files, ElementsAre(folder / "made/here/truth_pose.csv",
                                   folder / "made/here/cup.csv", folder / "made/here/events.csv"));
    EXPECT_EQ(load_text(files[0]),
              "time_s,header.stamp_s,pose.position.x_m,pose.orientation.w,header.frame_id\n"
              "0,0,0.1,1,map\n"
              "0.001,0.001,-1e-300,0.5,\"a,\"\"b\"\"\"\n");
    EXPECT_EQ(load_text(files[1]), "time_s,pressure_Pa,gap_m\n0.5,101325,inf\n");
    EXPECT_EQ(load_text(files[2]),
              "time_s,station,name,reason,values\n"
              "1,guidance,impact,\"below -20 N, twice\",force_N=-30.5;speed_m_s=1.1\n"
              "2,cup,attached,,\n");
}

TEST(Csv, NoFileIsWrittenOverAnother) {
    const TestFolder folder;
    Recording recording;
    const auto add = [&recording](const char* topic, double x) {
        recording.tables.push_back({.topic = topic,
                                    .type = "p/msg/P",
                                    .time_s = {0.0},
                                    .columns = {{"x", {x}}},
                                    .texts = {}});
    };
    add("/a/b", 1.0);
    add("/a_b", 2.0);
    add("/a/b", 3.0);  // another channel
    add("/A/B", 4.0);  // the same, to some file systems
    add("/events", 5.0);
    add("/a_b_2", 6.0);
    add("/note", 7.0);
    add(std::string(300, 'n').c_str(), 8.0);
    recording.attachments = {{"note.csv", "", "mine", 0},
                             {"note.csv", "", "again", 0},
                             {"x.part", "", "part", 0},
                             {"x", "", "whole", 0}};
    const auto files = write_csv(recording, folder / "made");
    EXPECT_THAT(csv_names(recording),
                ElementsAre("a_b.csv", "a_b_2.csv", "a_b_3.csv", "A_B_4.csv", "events_2.csv",
                            "a_b_2_2.csv", "note_3.csv", std::string(200, 'n') + ".csv"));
    ASSERT_EQ(files.size(), 9U);
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(load_text(files[static_cast<std::size_t>(i)]),
                  "time_s,x\n0," + std::to_string(i + 1) + "\n");
    }
    EXPECT_EQ(load_text(files[8]), "time_s,station,name,reason,values\n");
    const auto attached = write_attachments(recording, folder / "made");
    ASSERT_EQ(attached.size(), 4U);
    for (std::size_t i = 0; i < attached.size(); ++i) {
        EXPECT_EQ(load_text(attached[i]), recording.attachments[i].text);
    }
    EXPECT_EQ(load_text(folder / "made/note_3.csv"), "time_s,x\n0,7\n");
    EXPECT_THAT(renamed_topics(recording),
                testing::Contains("topic \"/a_b\" is in a_b_2.csv: another file has the name"));
}

TEST(Csv, WholeNumbersAndTimesKeepTheirDigits) {
    const TestFolder folder;
    Recording recording;
    recording.tables.push_back(
        {.topic = "/t",
         .type = "p/msg/P",
         .time_s = {1'700'000'000.1234567, 0.001},
         .columns =
             {{"u",
               {1.7e18, 1.8446744073709552e19},
               Whole::uint64,
               {1'700'000'000'123'456'789, -1}},
              {"i", {-9.2e18, kNaN}, Whole::int64, {-9'223'372'036'854'775'807, 0}},
              {"t", {-0.5, 1.7e9}, Whole::nanoseconds, {-500'000'000, 1'700'000'000'000'000'001}}},
         .texts = {},
         .time_ns = {1'700'000'000'123'456'789, 1'000'000}});
    EXPECT_EQ(load_text(write_csv(recording, folder / "made")[0]),
              "time_s,u,i,t\n"
              "1700000000.123456789,1700000000123456789,-9223372036854775807,-0.5\n"
              "0.001,18446744073709551615,nan,1700000000.000000001\n");
}

TEST(Csv, TimesOfAClockKeepAllDigits) {
    const TestFolder folder;
    Recording recording = sample();
    recording.origin_ns = 1'710'000'000'000'000'001;
    const auto files = write_csv(recording, folder.path());
    EXPECT_THAT(load_text(files[1]), HasSubstr("\n1710000000.500000001,101325"));
    EXPECT_THAT(load_text(files[2]), HasSubstr("\n1710000001.000000001,guidance,impact"));
}

TEST(Csv, WritesAttachmentsUnderTheirNamesAlone) {
    const TestFolder folder;
    Recording recording = sample();
    recording.path = "a.mcap";
    recording.attachments = {{"scenario.yaml", "text/yaml", "a: 1\n", 0}};
    EXPECT_NO_THROW(require_plain_names(recording));
    EXPECT_THAT(write_attachments(recording, folder.path()), ElementsAre(folder / "scenario.yaml"));
    EXPECT_EQ(load_text(folder / "scenario.yaml"), "a: 1\n");
    for (const std::string& name :
         {std::string("../../F"), std::string("/tmp/F"), std::string("a/b"), std::string(".."),
          std::string("."), std::string(""), std::string("a\0b", 3), std::string("a\nb"),
          std::string(201, 'x')}) {
        recording.attachments.back().name = name;
        try {
            require_plain_names(recording);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.mcap: attachment \""));
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

TEST(Csv, NoTopicLeadsOutOfTheFolder) {
    const TestFolder folder;
    Recording recording = sample();
    recording.tables.front().topic = "/../../x\n";
    const auto files = write_csv(recording, folder.path());
    EXPECT_EQ(files.front(), folder / ".._.._x_.csv");
}

TEST(Csv, LeavesNothingHalfWritten) {
    const TestFolder folder;
    store(folder / "file", {});
    try {
        write_csv(sample(), folder / "file");
        FAIL() << "wrote into a file";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr((folder / "file").string()));
    }
    std::filesystem::create_directories(folder / "out/cup.csv/in_the_way");
    EXPECT_THROW(write_csv(sample(), folder / "out"), InputError);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        EXPECT_NE(entry.path().extension(), ".part");
    }
}

TEST(Csv, ATopicsNameDoesNotLeadOutOfTheFolder) {
    const TestFolder folder;
    Recording recording = sample();
    recording.tables[0].topic = "/../../evil";
    const auto files = write_csv(recording, folder / "out");
    EXPECT_EQ(files[0], folder / "out/.._.._evil.csv");
}

}  // namespace
}  // namespace limpet::record
