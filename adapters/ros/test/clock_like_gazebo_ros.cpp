// SPDX-License-Identifier: Apache-2.0
// What gazebo_ros does in a gzserver, as far as tests need it: the world's time on /clock at each
// update, and where models are in the world (its get_model_state and model_states).
#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>
#include <memory>

namespace limpet::ros {

class ClockLikeGazeboRos final : public gazebo::WorldPlugin {
public:
    void Load(gazebo::physics::WorldPtr world, sdf::ElementPtr /*sdf*/) override {
        if (!::ros::isInitialized()) {
            int argc = 0;
            ::ros::init(argc, nullptr, "gazebo", ::ros::init_options::NoSigintHandler);
        }
        node_ = std::make_unique<::ros::NodeHandle>();
        clock_ = node_->advertise<rosgraph_msgs::Clock>("/clock", 10);
        place_ = node_->advertise<geometry_msgs::PoseStamped>("/gazebo/place", 10);
        on_update_ = gazebo::event::Events::ConnectWorldUpdateBegin(
            [this, world](const gazebo::common::UpdateInfo& info) { publish(*world, info); });
    }

private:
    void publish(const gazebo::physics::World& world, const gazebo::common::UpdateInfo& info) {
        rosgraph_msgs::Clock now;
        now.clock.fromSec(info.simTime.Double());
        clock_.publish(now);
        if (info.simTime.nsec % 20'000'000 != 0) {
            return;
        }
        for (const auto& model : world.Models()) {
            if (!model->IsStatic()) {
                const auto pose = model->WorldPose();
                geometry_msgs::PoseStamped message;
                message.header.stamp = now.clock;
                message.header.frame_id = model->GetName();
                message.pose.position.x = pose.Pos().X();
                message.pose.position.y = pose.Pos().Y();
                message.pose.position.z = pose.Pos().Z();
                message.pose.orientation.w = pose.Rot().W();
                message.pose.orientation.x = pose.Rot().X();
                message.pose.orientation.y = pose.Rot().Y();
                message.pose.orientation.z = pose.Rot().Z();
                place_.publish(message);
            }
        }
    }

    std::unique_ptr<::ros::NodeHandle> node_;
    ::ros::Publisher clock_, place_;
    gazebo::event::ConnectionPtr on_update_;
};

GZ_REGISTER_WORLD_PLUGIN(ClockLikeGazeboRos)

}  // namespace limpet::ros
