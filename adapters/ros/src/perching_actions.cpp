// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/perching_actions.hpp"

#include <actionlib/server/action_server.h>
#include <limpet_ros/PerchingAction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "adapters/ros/src/manoeuvre_goal.hpp"

namespace limpet::ros {
namespace {

using companion::PerchingSession;
using Server = actionlib::ActionServer<limpet_ros::PerchingAction>;

constexpr double kFeedback_s = 0.1;

limpet_ros::PerchingFeedback feedback_of(const PerchingSession& session, double time_s) {
    const guidance::PerchingMemory& memory = session.memory();
    const bool flies = session.phase() == companion::SessionPhase::flying;
    limpet_ros::PerchingFeedback feedback;
    feedback.phase = std::string(to_string(session.phase()));
    feedback.state =
        std::string(guidance::to_string(flies ? memory.state : guidance::PerchingState::hovering));
    feedback.state_s = flies ? time_s - memory.since_s : 0.0;
    feedback.place = std::string(companion::to_string(session.place()));
    feedback.obstacle = session.obstacle();
    feedback.attempt = static_cast<std::uint8_t>(std::min(memory.attempt, 255));
    return feedback;
}

bool says_the_same(const limpet_ros::PerchingFeedback& a, const limpet_ros::PerchingFeedback& b) {
    return a.phase == b.phase && a.state == b.state && a.place == b.place &&
           a.obstacle == b.obstacle && a.attempt == b.attempt;
}

/// One of the three.
class Action {
public:
    Action(const ::ros::NodeHandle& own, Manoeuvre manoeuvre, PerchingSession& session)
        : manoeuvre_(manoeuvre),
          session_(session),
          server_(
              own, std::string(to_string(manoeuvre)),
              [this](const Server::GoalHandle& goal) { take(goal); },
              [this](const Server::GoalHandle&) { cancel(); }, false) {
        server_.start();
    }

    void tick(double time_s) {
        if (!goal_) {
            return;
        }
        const limpet_ros::PerchingFeedback now = feedback_of(session_, time_s);
        // Simulated time may begin anew.
        if (!says_the_same(now, told_) || std::abs(time_s - told_s_) >= kFeedback_s) {
            told_ = now;
            told_s_ = time_s;
            handle_.publishFeedback(now);
        }
        if (const auto end = goal_->look(session_)) {
            finish(*end);
        }
    }

private:
    void take(Server::GoalHandle handle) {
        const companion::Answer answer =
            goal_ ? companion::Answer{false, "a goal of this action is under way"}
                  : request(session_, manoeuvre_, ::ros::Time::now().toSec());
        ROS_INFO("%s: %s", std::string(to_string(manoeuvre_)).c_str(), answer.message.c_str());
        if (!answer.done) {
            limpet_ros::PerchingResult result;
            result.reason = answer.message;
            handle.setRejected(result, answer.message);
            return;
        }
        handle.setAccepted(answer.message);
        handle_ = handle;
        goal_.emplace(manoeuvre_);
        told_ = {};
    }
    void cancel() {
        if (goal_) {
            ROS_INFO("%s canceled: %s", std::string(to_string(manoeuvre_)).c_str(),
                     session_.abort().message.c_str());
            goal_->cancel();
        }
    }
    void finish(const GoalEnd& end) {
        limpet_ros::PerchingResult result;
        result.success = end.success ? 1 : 0;
        result.outcome = end.outcome;
        result.reason = end.reason;
        goal_.reset();
        if (end.canceled) {
            handle_.setCanceled(result, result.reason);
        } else if (end.success) {
            handle_.setSucceeded(result, result.reason);
        } else {
            handle_.setAborted(result, result.reason);
        }
    }

    Manoeuvre manoeuvre_;
    PerchingSession& session_;
    std::optional<ManoeuvreGoal> goal_;  ///< under way
    Server::GoalHandle handle_;          ///< its
    limpet_ros::PerchingFeedback told_;
    double told_s_ = 0.0;
    Server server_;  ///< last: calls the others
};

}  // namespace

struct PerchingActions::Servers {
    std::array<Action, 3> all;
};

PerchingActions::PerchingActions(const ::ros::NodeHandle& own, PerchingSession& session)
    : servers_(new Servers{{Action{own, Manoeuvre::perch, session},
                            Action{own, Manoeuvre::take_off, session},
                            Action{own, Manoeuvre::abort, session}}}) {}

PerchingActions::~PerchingActions() = default;

void PerchingActions::tick(double time_s) {
    for (Action& action : servers_->all) {
        action.tick(time_s);
    }
}

}  // namespace limpet::ros
