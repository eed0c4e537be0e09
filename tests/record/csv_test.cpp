// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"

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
