// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "../support/files.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/record/recorder.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::record {
namespace {

Scene sample_scene() {
    Scene scene{.robot_description = "<robot name=\"" + std::string(9000, 'x') + "\"/>"};
    scene.wall = WallGeometry{};
    scene.surface = "concrete";
    scene.lidar_p_B_m = {Vector3(0.2, -0.1, 0.0), Vector3(0.2, 0.1, 0.0)};
    scene.joint_B_m = {0.4, 0.0, 0.0};
    scene.lip_m = 0.04;
    scene.rotor_p_B_m = RotorList<Vector3>(4);
    scene.thrust_N_s2 = RotorList<double>(4, 2.5e-5);
    return scene;
}

Truth moving_truth(double time_s) {
    Truth truth;
    truth.time_s = time_s;
    truth.base.p_WF_m = {1.0 + time_s, 2.0, -3.0};
    truth.cup_status.wrench_C.force_N = {-30.0, 0.0, 0.0};
    truth.rotor_speed_rad_s = RotorList<double>(4, 500.0);
    return truth;
}

/// Messages by topic, in the order of the file.
std::map<std::string, std::vector<mcap::Bytes>> messages(const std::filesystem::path& path) {
    std::map<std::string, std::vector<mcap::Bytes>> all;
    const mcap::Contents contents =
        mcap::read(path, [&](const mcap::Contents& so_far, const mcap::Message& message) {
            all[so_far.channels.at(message.channel_id).topic].emplace_back(message.data.begin(),
                                                                           message.data.end());
        });
    EXPECT_EQ(contents.damage, "");
    return all;
}

bool holds(const mcap::Bytes& bytes, std::string_view text) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).find(text) !=
           std::string_view::npos;
}

TEST(Scene, DescriptionAndStandingFramesComeOnceMovingOnesWithEveryTruth) {
    const TestFolder folder;
    RecordingInfo info{.scenario = "a", .version = "0", .attachments = {}, .range_sensor = {}};
    info.scene = sample_scene();
    {
        Recorder recorder(folder / "a.mcap", info);
        for (const double time_s : {0.0, 0.1, 0.2}) {
            recorder.truth(moving_truth(time_s));
        }
        recorder.scene(moving_truth(0.2), {}, {});
        recorder.finish("{}");
    }
    const auto all = messages(folder / "a.mcap");
    EXPECT_EQ(all.at("/tf").size(), 3U);
    ASSERT_EQ(all.at("/robot_description").size(), 1U);
    EXPECT_TRUE(holds(all.at("/robot_description")[0], info.scene->robot_description));
    ASSERT_EQ(all.at("/tf_static").size(), 1U);
    for (const char* frame : {"lidar_left", "lidar_right", "lip", "wall"}) {
        EXPECT_TRUE(holds(all.at("/tf_static")[0], frame)) << frame;
    }
    for (const char* frame : {"map", "base_link", "carriage", "cup_yoke", "cup"}) {
        EXPECT_TRUE(holds(all.at("/tf")[2], frame)) << frame;
    }
    ASSERT_EQ(all.at("/scene").size(), 2U);  // the wall, then what moves
    EXPECT_TRUE(holds(all.at("/scene")[0], "wall/concrete"));
    EXPECT_TRUE(holds(all.at("/scene")[1], "cup_force"));
    EXPECT_TRUE(holds(all.at("/scene")[1], "thrust"));
}

TEST(Scene, APayloadHangsOnItsCableUntilThatParts) {
    const TestFolder folder;
    const auto marked = [&](bool hangs) {
        RecordingInfo info{.scenario = "a", .version = "0", .attachments = {}, .range_sensor = {}};
        info.scene = sample_scene();
        if (hangs) {
            info.scene->hook_B_m = Vector3(0.0, 0.0, 0.05);
        }
        Recorder recorder(folder / "a.mcap", info);
        Truth truth = moving_truth(0.1);
        recorder.scene(truth, {}, {});
        truth.payload.parted = true;
        truth.time_s = 0.2;
        recorder.scene(truth, {}, {});
        recorder.finish("{}");
        return messages(folder / "a.mcap").at("/scene");
    };
    const auto with = marked(true), without = marked(false);
    ASSERT_EQ(with.size(), 3U);  // the wall, then what moves
    EXPECT_TRUE(holds(with[1], "payload"));
    EXPECT_TRUE(holds(with[1], "cable"));
    EXPECT_NE(with[1], with[2]);
    EXPECT_FALSE(holds(without[1], "payload"));
    EXPECT_FALSE(holds(without[1], "cable"));
}

TEST(Scene, IsNotReadBackAsColumnsNorAsDamage) {
    const TestFolder folder;
    RecordingInfo info{.scenario = "a", .version = "0", .attachments = {}, .range_sensor = {}};
    info.scene = sample_scene();
    {
        Recorder recorder(folder / "a.mcap", info);
        recorder.truth(moving_truth(0.0));
        recorder.finish("{}");
    }
    const Recording recording = read_recording(folder / "a.mcap");
    EXPECT_EQ(recording.damage, "");
    for (const Table& table : recording.tables) {
        EXPECT_FALSE(is_of_scene(table.topic)) << table.topic;
    }
    EXPECT_NO_THROW((void)recording.table("/truth/pose"));
}

TEST(Scene, CupAnglesAreThoseOfItsJoint) {
    Truth truth;
    truth.base.q_WF = quaternion_from_euler({0.1, -0.4, 2.0});
    const double pitch_rad = 0.3, yaw_rad = -0.2;
    truth.cup.q_WF = truth.base.q_WF * quaternion_from_rotation_vector({0.0, pitch_rad, 0.0}) *
                     quaternion_from_rotation_vector({0.0, 0.0, yaw_rad});
    EXPECT_NEAR(cup_angles(truth).pitch_rad, pitch_rad, 1e-12);
    EXPECT_NEAR(cup_angles(truth).yaw_rad, yaw_rad, 1e-12);
}

}  // namespace
}  // namespace limpet::record
