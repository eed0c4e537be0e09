// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/autopilot_calls.hpp"

#include <limpet_ros/CommandLong.h>
#include <limpet_ros/SetMode.h>

#include <chrono>
#include <utility>

#include "limpet/mavlink/translate.hpp"

namespace limpet::ros {

AutopilotCalls::AutopilotCalls(double retry_s) : retry_s_(retry_s) {
    ::ros::NodeHandle node;
    mode_call_ = node.serviceClient<limpet_ros::SetMode>("mavros/set_mode");
    command_call_ = node.serviceClient<limpet_ros::CommandLong>("mavros/cmd/command");
    thread_ = std::jthread([this](const std::stop_token& over) { work(over); });
}

void AutopilotCalls::want(std::string mode, std::optional<bool> armed) {
    const std::lock_guard lock(mutex_);
    const bool news = mode != mode_ || armed != armed_;
    mode_ = std::move(mode);
    armed_ = armed;
    if (news) {
        changed_.notify_all();
    }
}

void AutopilotCalls::work(const std::stop_token& over) {
    std::unique_lock lock(mutex_);
    while (!over.stop_requested()) {
        const std::string mode = mode_;
        const std::optional<bool> armed = armed_;
        const auto news = [&] { return mode != mode_ || armed != armed_; };
        if (mode.empty() && !armed) {
            changed_.wait(lock, over, news);
            continue;
        }
        lock.unlock();
        call(mode, armed);
        lock.lock();
        changed_.wait_for(lock, over, std::chrono::duration<double>(retry_s_), news);
    }
}

void AutopilotCalls::send(::ros::ServiceClient& client, auto& call, const char* name) {
    if (client.call(call)) {
        return;
    }
    // roscpp gives no reason.
    const bool there = ::ros::service::exists(name, false);
    ROS_WARN_THROTTLE(5.0, "%s: %s (%s, md5 %s)", name,
                      there ? "the call failed: is its definition another one than ours?"
                            : "nobody answers: is MAVROS up?",
                      ::ros::service_traits::datatype(call), ::ros::service_traits::md5sum(call));
}

void AutopilotCalls::call(const std::string& mode, std::optional<bool> armed) {
    if (!mode.empty()) {
        limpet_ros::SetMode call;
        call.request.custom_mode = mode;
        send(mode_call_, call, "mavros/set_mode");
    }
    if (armed) {
        limpet_ros::CommandLong call;
        call.request.command = mavlink::MavCmd::component_arm_disarm;
        call.request.param1 = *armed ? 1.0F : 0.0F;
        call.request.param2 = *armed ? 0.0F : mavlink::kForce;  // PX4 needs it off the ground
        send(command_call_, call, "mavros/cmd/command");
    }
}

}  // namespace limpet::ros
