// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/Marker.h>

#include <span>

#include "limpet/record/scene.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::ros {

[[nodiscard]] tf2_msgs::TFMessage tf_message(std::span<const record::PlacedFrame> frames,
                                             const ::ros::Time& stamp);
/// Of the URDF's joints: slider [m], cup_pitch and cup_yaw [rad]; none without a cup. With the
/// force through the slider as its effort [N]; those of the hinges are not known: 0.
[[nodiscard]] sensor_msgs::JointState joint_message(const record::Scene& scene, const Truth& truth);
/// The solid behind the wall's face, in frame "wall".
[[nodiscard]] visualization_msgs::Marker wall_marker(const record::Scene& scene);

/// A simulated vehicle as viewers show it, in truth: /tf, /tf_static, joint_states, the wall as a
/// marker, and the vehicle's URDF under the name robot_description: a parameter of ROS 1, a topic
/// of ROS 2. A robot_state_publisher next to it publishes the same frames twice.
class SceneTopics {
public:
    SceneTopics(::ros::NodeHandle& node, const simulation::FlightModel& model);

    void show(const Truth& truth, const ::ros::Time& now) const;

private:
    record::Scene scene_;
    ::ros::Publisher moving_, standing_, joints_, wall_, description_;
};

}  // namespace limpet::ros
