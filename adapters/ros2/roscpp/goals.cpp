// SPDX-License-Identifier: Apache-2.0
#include <actionlib/goals.hpp>
#include <utility>

namespace actionlib::detail {

using action_msgs::CancelGoalRequest;
using action_msgs::CancelGoalResponse;
using action_msgs::GoalStatus;
using action_msgs::GoalStatusArray;

Goals::Goals(const ros::NodeHandle& node, const std::string& action,
             std::function<void(const GoalId&)> cancel, limpet::ros2::Bytes unknown)
    : cancel_(std::move(cancel)),
      unknown_(std::move(unknown)),
      status_(node.advertise<GoalStatusArray>(action + "/_action/status", 1, true)),
      cancels_(node.advertiseService(action + "/_action/cancel_goal", &Goals::cancel, this)) {
    publish();
}

ros::Time Goals::accept(const GoalId& id) {
    Goal& goal = goals_[id.uuid];
    goal.entry.goal_info = {.goal_id = id, .stamp = ros::Time::now()};
    goal.entry.status = GoalStatus::STATUS_EXECUTING;
    publish();
    return goal.entry.goal_info.stamp;
}

void Goals::finish(const GoalId& id, std::int8_t status, limpet::ros2::Bytes result) {
    const auto found = goals_.find(id.uuid);
    if (found == goals_.end() || !found->second.result.empty()) {
        return;
    }
    Goal& goal = found->second;
    goal.entry.status = status;
    goal.result = std::move(result);
    for (const Reply& reply : std::exchange(goal.waiting, {})) {
        reply(goal.result);
    }
    over_.push_back(id.uuid);
    if (over_.size() > kKept) {
        goals_.erase(over_.front());
        over_.pop_front();
    }
    publish();
}

void Goals::give_result(const GoalId& id, const Reply& reply) {
    const auto found = goals_.find(id.uuid);
    if (found == goals_.end()) {
        reply(unknown_);
    } else if (found->second.result.empty()) {
        found->second.waiting.push_back(reply);
    } else {
        reply(found->second.result);
    }
}

/// No goal named: all; a time with it: those too that were accepted until then.
bool Goals::cancel(CancelGoalRequest& request, CancelGoalResponse& response) {
    const Key& named = request.goal_info.goal_id.uuid;
    const ros::Time& until = request.goal_info.stamp;
    const bool one = named != Key{};
    const bool timed = !until.isZero();
    if (one && !timed && !goals_.contains(named)) {
        response.return_code = CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID;
        return true;
    }
    const auto not_after = [](const ros::Time& a, const ros::Time& b) {
        return std::pair(a.sec, a.nsec) <= std::pair(b.sec, b.nsec);
    };
    for (auto& [key, goal] : goals_) {
        const bool meant = (one && key == named) || (!one && !timed) ||
                           (timed && not_after(goal.entry.goal_info.stamp, until));
        if (meant && goal.entry.status == GoalStatus::STATUS_EXECUTING) {
            goal.entry.status = GoalStatus::STATUS_CANCELING;
            response.goals_canceling.push_back(goal.entry.goal_info);
        }
    }
    if (one && !timed && response.goals_canceling.empty()) {
        response.return_code = CancelGoalResponse::ERROR_GOAL_TERMINATED;
    }
    publish();
    for (const action_msgs::GoalInfo& goal : response.goals_canceling) {
        cancel_(goal.goal_id);
    }
    return true;
}

void Goals::publish() const {
    GoalStatusArray all;
    for (const auto& [key, goal] : goals_) {
        all.status_list.push_back(goal.entry);
    }
    status_.publish(all);
}

}  // namespace actionlib::detail
