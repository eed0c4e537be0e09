// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <action_msgs/CancelGoal.h>
#include <action_msgs/GoalStatusArray.h>
#include <ros/ros.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace actionlib::detail {

using GoalId = unique_identifier_msgs::UUID;

/// What an action server knows of its goals, whatever their type: their states, published on
/// ACTION/_action/status; who waits for which result; whom a cancel request means. As rcl_action
/// has it. One thread calls.
class Goals {
public:
    using Reply = limpet::ros2::Node::Reply;

    /// @param cancel   called for each accepted goal that is to stop
    /// @param unknown  the answer to a request for the result of an unknown goal
    Goals(const ros::NodeHandle& node, const std::string& action,
          std::function<void(const GoalId&)> cancel, limpet::ros2::Bytes unknown);

    [[nodiscard]] bool knows(const GoalId& id) const { return goals_.contains(id.uuid); }
    /// Accepted, and under way.
    /// @return when
    ros::Time accept(const GoalId& id);
    /// @param result  the response to requests for it
    void finish(const GoalId& id, std::int8_t status, limpet::ros2::Bytes result);
    /// Replies now, or when it has come to its end.
    void give_result(const GoalId& id, const Reply& reply);

private:
    static constexpr std::size_t kKept = 32;  ///< that are over; rcl keeps them for 10 s
    using Key = decltype(GoalId::uuid);
    struct Goal {
        action_msgs::GoalStatus entry;
        limpet::ros2::Bytes result;  ///< once it is over
        std::vector<Reply> waiting;
    };

    bool cancel(action_msgs::CancelGoalRequest& request, action_msgs::CancelGoalResponse& response);
    void publish() const;

    std::function<void(const GoalId&)> cancel_;
    limpet::ros2::Bytes unknown_;
    std::map<Key, Goal> goals_;
    std::deque<Key> over_;
    ros::Publisher status_;
    ros::ServiceServer cancels_;
};

}  // namespace actionlib::detail
