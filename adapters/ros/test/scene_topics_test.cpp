// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/scene_topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/diagnostics.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight_log.hpp"

namespace limpet::ros {
namespace {

using testing::ElementsAre;

/// perch_concrete's vehicle, nose up by 60 deg before its wall, its cup square on the wall.
class AScene : public testing::Test {
protected:
    AScene() {
        const auto model = simulation::build_model(scenario::load_scenario("perch_concrete"));
        scene_ = simulation::scene_of_recording(*model);
        truth_.base.p_WF_m = {1.0, 2.0, -3.0};
        truth_.base.q_WF = quaternion_from_euler({.pitch_rad = radians(60.0)});
        truth_.slider = {.position_m = -0.02, .force_N = -12.0};
    }
    record::Scene scene_;
    Truth truth_;
};

TEST_F(AScene, StandsInTfAsItDoes) {
    const auto message = tf_message(moving_frames(scene_, truth_).span(), ros_time(12.5));
    std::vector<std::string> tree;
    for (const auto& transform : message.transforms) {
        EXPECT_EQ(transform.header.stamp.toSec(), 12.5);
        tree.push_back(transform.header.frame_id + ">" + transform.child_frame_id);
    }
    EXPECT_THAT(tree, ElementsAre("map>base_link", "base_link>carriage", "carriage>cup_yoke",
                                  "cup_yoke>cup"));
    const auto& base = message.transforms[0].transform;
    EXPECT_EQ(base.translation.x, 2.0);  // east
    EXPECT_EQ(base.translation.y, 1.0);
    EXPECT_EQ(base.translation.z, 3.0);
    EXPECT_NEAR(message.transforms[1].transform.translation.x, scene_.joint_B_m.x() - 0.02, 1e-12);
    // The hinge turns the cup back by what the nose is up: about y, which points left.
    const auto& hinge = message.transforms[2].transform.rotation;
    EXPECT_NEAR(hinge.y, std::sin(radians(30.0)), 1e-9);
    EXPECT_NEAR(hinge.w, std::cos(radians(30.0)), 1e-9);
}

TEST_F(AScene, HasWhatStandsStillInTfStatic) {
    std::vector<std::string> tree;
    for (const auto& transform : tf_message(standing_frames(scene_), {}).transforms) {
        tree.push_back(transform.header.frame_id + ">" + transform.child_frame_id);
    }
    EXPECT_THAT(
        tree, ElementsAre("base_link>lidar_left", "base_link>lidar_right", "cup>lip", "map>wall"));
}

TEST_F(AScene, TellsItsJointsByTheUrdfsNames) {
    const auto message = joint_message(scene_, truth_);
    EXPECT_THAT(message.name, ElementsAre("slider", "cup_pitch", "cup_yaw"));
    EXPECT_EQ(message.position.at(0), -0.02);
    EXPECT_NEAR(message.position.at(1), -radians(60.0), 1e-9);
    EXPECT_NEAR(message.position.at(2), 0.0, 1e-9);
    EXPECT_EQ(message.effort.at(0), -12.0);
    for (const std::string& name : message.name) {
        EXPECT_NE(scene_.robot_description.find("joint name=\"" + name + "\""), std::string::npos);
    }
    scene_.has_cup = false;
    EXPECT_TRUE(joint_message(scene_, truth_).name.empty());
}

TEST_F(AScene, ShowsTheSolidBehindTheWallsFace) {
    const auto wall = wall_marker(scene_);
    EXPECT_EQ(wall.header.frame_id, "wall");
    EXPECT_EQ(wall.type, visualization_msgs::Marker::CUBE);
    EXPECT_NEAR(wall.pose.position.x, 0.5 * wall.scale.x, 1e-12) << "x is into the wall";
    EXPECT_EQ(wall.scale.y, 2.0 * scene_.wall->half_width_m);
    EXPECT_EQ(wall.color.a, 1.0F);
}

TEST(RosDiagnostics, APartIsCalledAfterItsNode) {
    const auto status =
        status_message("suction_cup_node", {.name = "cup",
                                            .level = Diagnosis::Level::warn,
                                            .message = "nothing is felt",
                                            .values = {{"pressure_hPa", "1013.2"}}});
    EXPECT_EQ(status.name, "suction_cup_node: cup");
    EXPECT_EQ(static_cast<int>(status.level), 1);
    EXPECT_EQ(status.values.at(0).key, "pressure_hPa");
    EXPECT_EQ(status.values.at(0).value, "1013.2");
}

}  // namespace
}  // namespace limpet::ros
