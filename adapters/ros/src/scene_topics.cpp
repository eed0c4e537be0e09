// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/scene_topics.hpp"

#include "adapters/ros/src/description.hpp"
#include "adapters/ros/src/geometry.hpp"
#include "adapters/ros/src/topics.hpp"
#include "limpet/simulation/flight_log.hpp"

namespace limpet::ros {
namespace {

using ros::put;

template <class Message>
void put(const Quaternion& q, Message& message) {
    message.w = q.w();
    put(Vector3(q.vec()), message);
}

constexpr std::uint32_t kAsTf2 = 100;  ///< messages that wait, as tf2's own

}  // namespace

tf2_msgs::TFMessage tf_message(std::span<const record::PlacedFrame> frames,
                               const ::ros::Time& stamp) {
    tf2_msgs::TFMessage message;
    for (const record::PlacedFrame& frame : frames) {
        geometry_msgs::TransformStamped& to = message.transforms.emplace_back();
        to.header.stamp = stamp;
        to.header.frame_id = std::string(frame.parent);
        to.child_frame_id = std::string(frame.child);
        put(frame.p, to.transform.translation);
        put(frame.q, to.transform.rotation);
    }
    return message;
}

sensor_msgs::JointState joint_message(const record::Scene& scene, const Truth& truth) {
    sensor_msgs::JointState message;
    if (scene.has_cup) {
        const record::CupAngles cup = record::cup_angles(truth);
        message.name = {"slider", "cup_pitch", "cup_yaw"};
        message.position = {truth.slider.position_m, cup.pitch_rad, cup.yaw_rad};
        message.effort = {truth.slider.force_N, 0.0, 0.0};
    }
    return message;
}

visualization_msgs::Marker wall_marker(const record::Scene& scene) {
    using visualization_msgs::Marker;
    const record::WallShown shown = record::wall_shown(*scene.wall);
    Marker marker;
    marker.header.frame_id = std::string(record::kWallFrame);
    marker.ns = "wall/" + scene.surface;
    marker.type = shown.box ? Marker::CUBE : Marker::CYLINDER;
    marker.action = Marker::ADD;
    marker.frame_locked = 1;
    put(shown.p, marker.pose.position);
    marker.pose.orientation.w = 1.0;
    put(shown.size_m, marker.scale);
    marker.color.r = scene.wall_colour[0];
    marker.color.g = scene.wall_colour[1];
    marker.color.b = scene.wall_colour[2];
    marker.color.a = 1.0F;
    return marker;
}

SceneTopics::SceneTopics(::ros::NodeHandle& node, const simulation::FlightModel& model)
    : scene_(simulation::scene_of_recording(model)),
      moving_(node.advertise<tf2_msgs::TFMessage>("/tf", kAsTf2)),
      standing_(node.advertise<tf2_msgs::TFMessage>("/tf_static", kAsTf2, true)),
      joints_(node.advertise<sensor_msgs::JointState>("joint_states", kQueue)),
      wall_(node.advertise<visualization_msgs::Marker>("wall", 1, true)),
      description_(publish_description(node, model.scenario->airframe)) {
    standing_.publish(tf_message(standing_frames(scene_), {}));
    if (scene_.wall) {
        wall_.publish(wall_marker(scene_));
    }
}

void SceneTopics::show(const Truth& truth, const ::ros::Time& now) const {
    moving_.publish(tf_message(moving_frames(scene_, truth).span(), now));
    send(joints_, joint_message(scene_, truth), now);
}

}  // namespace limpet::ros
