// SPDX-License-Identifier: Apache-2.0
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <memory>
#include <string>

#include "adapters/gazebo/suction_cup_plugin.hpp"
#include "adapters/ros/gazebo/join_ros.hpp"
#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/topics.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::ros {

/// LimpetRosSuctionCupPlugin: LimpetSuctionCupPlugin (its elements are those of this one too) on
/// ROS as well. CUP is MODEL/PLUGIN there too; stamps are the world's time, frame_id is the link's
/// name. Needs a ROS master; /clock is gazebo_ros's, or a vehicle's.
///   CUP/pressure  sensor_msgs/FluidPressure, out, at publish_rate_Hz
///   CUP/state     limpet_ros/CupState, out, also at once when the phase changes
///   CUP/event     limpet_ros/PerchingEvent: attached, contact_lost, detached; out
///   CUP/pump, CUP/valve   services, std_srvs/SetBool
class RosSuctionCupPlugin final : public gazebo11::SuctionCupPlugin {
public:
    ~RosSuctionCupPlugin() override {
        if (spinner_) {
            spinner_->stop();
        }
    }

protected:
    void join(const std::string& name) override {
        std::string why;
        if (!::ros::names::validate(name, why)) {
            throw InputError("LimpetRosSuctionCupPlugin: \"" + name +
                             "\" is no name of ROS, allowed letters, digits and _ in those of the "
                             "model and of <plugin name>");
        }
        join_ros("LimpetRosSuctionCupPlugin");
        node_ = std::make_unique<::ros::NodeHandle>(name);
        node_->setCallbackQueue(&queue_);
        pressure_ = node_->advertise<sensor_msgs::FluidPressure>("pressure", kQueue);
        state_ = node_->advertise<limpet_ros::CupState>("state", kQueue, true);
        event_ = node_->advertise<limpet_ros::PerchingEvent>("event", kQueue);
        pump_ = node_->advertiseService("pump", &RosSuctionCupPlugin::switch_pump, this);
        valve_ = node_->advertiseService("valve", &RosSuctionCupPlugin::open_valve, this);
        spinner_ = std::make_unique<::ros::AsyncSpinner>(1, &queue_);
        spinner_->start();
    }
    void publish(const suction::CupState& state, double time_s) override {
        const ::ros::Time stamp = ros_time(time_s);
        send_from(pressure_, pressure_message({.pressure_Pa = state.status.pressure_Pa}), stamp);
        send_from(state_, cup_message(state), stamp);
    }
    void publish(const Event& event) override {
        send_from(event_, event_message(event), ros_time(event.time_s));
    }

private:
    template <class Message>
    void send_from(const ::ros::Publisher& to, Message message, const ::ros::Time& stamp) const {
        message.header.frame_id = settings().link;
        send(to, std::move(message), stamp);
    }
    bool switch_pump(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
        response.success = command("pump", request.data != 0) ? 1 : 0;
        response.message = request.data != 0 ? "pump on" : "pump off";
        return true;
    }
    bool open_valve(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
        const bool open = request.data != 0;
        const bool done = command("valve", open);
        response.success = done ? 1 : 0;
        response.message = !done  ? "no valve is fitted: suction.valve_fitted 1"
                           : open ? "valve open"
                                  : "valve shut";
        return true;
    }

    ::ros::CallbackQueue queue_;
    std::unique_ptr<::ros::NodeHandle> node_;
    ::ros::Publisher pressure_, state_, event_;
    ::ros::ServiceServer pump_, valve_;
    std::unique_ptr<::ros::AsyncSpinner> spinner_;  ///< last: stops before what it calls goes
};

GZ_REGISTER_MODEL_PLUGIN(RosSuctionCupPlugin)

}  // namespace limpet::ros
