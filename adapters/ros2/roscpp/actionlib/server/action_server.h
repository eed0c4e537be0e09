// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib/goals.hpp>
#include <boost/function.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace actionlib {

/// The part of actionlib's server that nodes use, as an action of ROS 2: three services and two
/// topics under NAME/_action. A goal is accepted or rejected before its callback returns; ROS 2 has
/// no words for why, so the texts that actionlib takes with a result are dropped.
/// @tparam Action  of interfaces.py: limpet_ros::PerchingAction
template <class Action>
class ActionServer {
public:
    using Goal = typename Action::Goal;
    using Result = typename Action::Result;
    using Feedback = typename Action::Feedback;

    class GoalHandle {
    public:
        GoalHandle() = default;

        [[nodiscard]] std::shared_ptr<const Goal> getGoal() const { return goal_; }
        [[nodiscard]] const detail::GoalId& id() const { return id_; }
        void setAccepted(const std::string& /*text*/ = {}) {
            *accepted_ = server_->goals_.accept(id_);
        }
        void setRejected(const Result& /*result*/ = {}, const std::string& /*text*/ = {}) {}
        void setSucceeded(const Result& result, const std::string& /*text*/ = {}) {
            finish(action_msgs::GoalStatus::STATUS_SUCCEEDED, result);
        }
        void setCanceled(const Result& result, const std::string& /*text*/ = {}) {
            finish(action_msgs::GoalStatus::STATUS_CANCELED, result);
        }
        void setAborted(const Result& result, const std::string& /*text*/ = {}) {
            finish(action_msgs::GoalStatus::STATUS_ABORTED, result);
        }
        void publishFeedback(const Feedback& feedback) const {
            server_->feedback_.publish(
                typename Action::FeedbackMessage{.goal_id = id_, .feedback = feedback});
        }

    private:
        friend class ActionServer;
        GoalHandle(ActionServer& server, const detail::GoalId& id, const Goal& goal)
            : server_(&server),
              id_(id),
              goal_(std::make_shared<const Goal>(goal)),
              accepted_(std::make_shared<std::optional<ros::Time>>()) {}
        void finish(std::int8_t status, const Result& result) const {
            server_->goals_.finish(id_, status,
                                   limpet::ros2::encode(typename Action::GetResultResponse{
                                       .status = status, .result = result}));
        }

        ActionServer* server_ = nullptr;
        detail::GoalId id_;
        std::shared_ptr<const Goal> goal_;
        std::shared_ptr<std::optional<ros::Time>> accepted_;  ///< when
    };

    /// @param take    accepts or rejects
    /// @param cancel  the goal of this handle is to stop: it ends as canceled, or as it will
    ActionServer(const ros::NodeHandle& node, std::string name,
                 boost::function<void(GoalHandle)> take, boost::function<void(GoalHandle)> cancel,
                 bool auto_start)
        : node_(node),
          name_(std::move(name)),
          take_(std::move(take)),
          cancel_(std::move(cancel)),
          goals_(
              node_, name_, [this](const detail::GoalId& id) { cancel_(handles_.at(id.uuid)); },
              limpet::ros2::encode(typename Action::GetResultResponse{})),
          feedback_(node_.template advertise<typename Action::FeedbackMessage>(
              name_ + "/_action/feedback", kQueue)) {
        if (auto_start) {
            start();
        }
    }
    ActionServer(const ActionServer&) = delete;
    ActionServer& operator=(const ActionServer&) = delete;

    /// From now on it is served.
    void start() {
        using SendGoal = typename Action::SendGoalRequest;
        using GetResult = typename Action::GetResultRequest;
        goal_services_ = {
            node_.template advertiseService<SendGoal, typename Action::SendGoalResponse>(
                name_ + "/_action/send_goal",
                [this](SendGoal& request, typename Action::SendGoalResponse& response) {
                    send_goal(request, response);
                    return true;
                }),
            node_.template serveLater<GetResult>(
                name_ + "/_action/get_result", Action::GetResultResponse::kType,
                [this](const GetResult& request, const detail::Goals::Reply& reply) {
                    goals_.give_result(request.goal_id, reply);
                })};
    }

private:
    static constexpr std::uint32_t kQueue = 10;

    void send_goal(const typename Action::SendGoalRequest& request,
                   typename Action::SendGoalResponse& response) {
        if (goals_.knows(request.goal_id)) {
            return;  // not accepted a second time
        }
        std::erase_if(handles_, [this](const auto& one) { return !goals_.knows(one.second.id_); });
        const GoalHandle handle(*this, request.goal_id, request.goal);
        take_(handle);
        if (*handle.accepted_) {
            handles_[request.goal_id.uuid] = handle;
            response.accepted = 1;
            response.stamp = **handle.accepted_;
        }
    }

    ros::NodeHandle node_;
    std::string name_;
    boost::function<void(GoalHandle)> take_, cancel_;
    std::map<decltype(detail::GoalId::uuid), GoalHandle> handles_;
    detail::Goals goals_;
    ros::Publisher feedback_;
    std::vector<ros::ServiceServer> goal_services_;
};

}  // namespace actionlib
