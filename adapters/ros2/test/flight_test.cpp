// SPDX-License-Identifier: Apache-2.0
// Vehicle, cup and guidance as three processes that speak ROS 2, commanded by services and watched
// by another DDS library.
#include <gtest/gtest.h>
#include <limpet_msgs/RotorCommand.h>
#include <limpet_msgs/VehicleTruth.h>
#include <limpet_ros/PerchingAction.h>
#include <limpet_ros/PerchingStatus.h>
#include <rcl_interfaces/Log.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>

#include <map>
#include <mutex>

#include "adapters/ros2/dds/node.hpp"
#include "adapters/ros2/test/peer.hpp"
#include "adapters/ros2/test/process.hpp"
#include "peer.h"

namespace limpet::ros2 {
namespace {

class Ros2Flight : public testing::Test {
protected:
    Ros2Flight() { setenv("ROS_DOMAIN_ID", std::to_string(domain_).c_str(), 1); }

    bool status_is(double patience_s,
                   const std::function<bool(const limpet_ros::PerchingStatus&)>& so) {
        return soon(
            [&] {
                const std::lock_guard lock(mutex_);
                return so(status_);
            },
            patience_s);
    }
    std_srvs::TriggerResponse call(const std::string& service) {
        const auto client = node_->client(service, std_srvs::TriggerRequest::kType,
                                          std_srvs::TriggerResponse::kType);
        std::optional<Bytes> answer;
        EXPECT_TRUE(soon([&] {
            answer = client->call(encode(std_srvs::TriggerRequest()), 5.0);
            return answer.has_value();
        })) << service;
        return decode<std_srvs::TriggerResponse>(answer.value_or(Bytes()))
            .value_or(std_srvs::TriggerResponse());
    }

    /// A word of rclcpp's action client.
    template <class Request, class Response>
    Response ask(const std::string& service, const Request& request, double patience_s) {
        const auto client = node_->client(service, Request::kType, Response::kType);
        EXPECT_TRUE(soon([&] { return client->is_served(); })) << service;
        const auto answer = client->call(encode(request), patience_s);
        EXPECT_TRUE(answer) << service;
        return decode<Response>(answer.value_or(Bytes())).value_or(Response());
    }
    bool send_goal(std::uint8_t id) {
        using Action = limpet_ros::PerchingAction;
        Action::SendGoalRequest request;
        request.goal_id.uuid[0] = id;
        return ask<Action::SendGoalRequest, Action::SendGoalResponse>(
                   "/perching_node/take_off/_action/send_goal", request, 5.0)
                   .accepted != 0;
    }

    int domain_ = 1 + static_cast<int>(getpid() % 100);
    std::unique_ptr<Node> node_;
    std::mutex mutex_;
    limpet_ros::PerchingStatus status_;
};

TEST_F(Ros2Flight, PerchesByServiceAndTakesOffAsAnAction) {
    Process vehicle("vehicle_node", {"scenario:=perch_concrete", "speed:=3.0",
                                     "set:=simulation.time_limit_s=3600"});
    Process cup("suction_cup_node", {"as_vehicle:=true", "use_sim_time:=true"});
    Process guidance(
        "perching_node",
        {"as_vehicle:=true", "use_sim_time:=true", "mission:=perch", "asks_for_mode:=true",
         "set:=limits.late_limit_s=0.9"});  // of simulated time, on a busy machine
    Peer peer(domain_);
    node_ = std::make_unique<Node>(read_settings("watch", {}));
    const auto subscription =
        node_->subscribe("/perching_node/status", limpet_ros::PerchingStatus::kType, kLatched,
                         [this](const Bytes& bytes) {
                             const std::lock_guard lock(mutex_);
                             status_ = decode<limpet_ros::PerchingStatus>(bytes).value();
                         });
    std::map<std::string, std::set<std::string>> log;  // of INFO, by node; by mutex_
    const auto rosout =
        node_->subscribe("/rosout", rcl_interfaces::Log::kType,
                         {.transient_local = true, .depth = 100}, [&](const Bytes& bytes) {
                             const auto line = decode<rcl_interfaces::Log>(bytes).value();
                             const std::lock_guard lock(mutex_);
                             if (line.level == rcl_interfaces::Log::INFO) {
                                 log[line.name].insert(line.msg);
                             }
                         });
    const dds_entity_t poses =
        peer.reader("rt/mavros/local_position/pose", geometry_msgs_msg_dds__PoseStamped__desc,
                    {.reliable = false});
    const dds_entity_t truths = peer.reader(
        "rt/limpet/truth/pose", geometry_msgs_msg_dds__PoseStamped__desc, {.reliable = false});
    const dds_entity_t transforms =
        peer.reader("rt/tf", tf2_msgs_msg_dds__TFMessage__desc, {.reliable = true});
    const dds_entity_t descriptions = peer.reader(
        "rt/robot_description", std_msgs_msg_dds__String__desc, {.reliable = true, .stays = true});

    ASSERT_TRUE(status_is(60, [](const auto& s) { return s.phase == "ready"; }));
    EXPECT_FALSE(call("/perching_node/take_off").success);
    EXPECT_FALSE(send_goal(1));
    const auto begins = call("/perching_node/perch");
    ASSERT_TRUE(begins.success) << begins.message;
    ASSERT_TRUE(status_is(90, [](const auto& s) { return s.outcome == "perched"; }));
    EXPECT_TRUE(status_is(1, [](const auto& s) { return s.place == "at rest on the wall"; }));
    EXPECT_FALSE(call("/perching_node/perch").success);

    // What others see of it: the same instant has the same place, by estimate and by truth.
    std::map<std::pair<int, unsigned>, double> truth_x, carriage;
    Peer::take<geometry_msgs_msg_dds__PoseStamped_>(truths, [](const auto&) {});
    int both = 0;
    EXPECT_TRUE(soon([&] {
        Peer::take<geometry_msgs_msg_dds__PoseStamped_>(truths, [&](const auto& pose) {
            truth_x[{pose.header.stamp.sec, pose.header.stamp.nanosec}] = pose.pose.position.x;
        });
        Peer::take<geometry_msgs_msg_dds__PoseStamped_>(poses, [&](const auto& pose) {
            const auto same = truth_x.find({pose.header.stamp.sec, pose.header.stamp.nanosec});
            if (same != truth_x.end()) {
                ++both;
                EXPECT_NEAR(pose.pose.position.x, same->second, 0.05);
            }
        });
        return both >= 20;
    }));
    std::set<std::string> frames;
    Peer::take<tf2_msgs_msg_dds__TFMessage_>(transforms, [&](const auto& message) {
        for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
            frames.insert(message.transforms._buffer[i].child_frame_id);
        }
    });
    EXPECT_TRUE(frames.contains("base_link"));
    EXPECT_TRUE(frames.contains("cup"));
    std::string description;
    Peer::take<std_msgs_msg_dds__String_>(
        descriptions, [&](const std_msgs_msg_dds__String_& text) { description = text.data; });
    EXPECT_NE(description.find("<robot"), std::string::npos);

    using Action = limpet_ros::PerchingAction;
    std::set<std::string> states;  // of the take-off's feedback; by mutex_
    const auto feedback = node_->subscribe(
        "/perching_node/take_off/_action/feedback", Action::FeedbackMessage::kType, {},
        [&](const Bytes& bytes) {
            const std::lock_guard lock(mutex_);
            states.insert(decode<Action::FeedbackMessage>(bytes).value().feedback.state);
        });
    ASSERT_TRUE(send_goal(2));
    Action::GetResultRequest of_goal;
    of_goal.goal_id.uuid[0] = 2;
    const auto end = ask<Action::GetResultRequest, Action::GetResultResponse>(
        "/perching_node/take_off/_action/get_result", of_goal, 120.0);
    constexpr int kSucceeded = 4;
    EXPECT_EQ(end.status, kSucceeded);
    EXPECT_EQ(end.result.outcome, "released") << end.result.reason;
    {
        const std::lock_guard lock(mutex_);
        EXPECT_TRUE(log["perching_node"].contains("ready: all inputs are here"));
        EXPECT_TRUE(log["suction_cup_node"].contains("detached: peeled off"));
        EXPECT_EQ(log.size(), 3U);
        EXPECT_GE(states.size(), 2U);  // on its way it comes through several
    }
    EXPECT_EQ(guidance.end(), 0);
    EXPECT_EQ(cup.end(), 0);
    EXPECT_EQ(vehicle.end(), 0);
}

/// Of a message: none has come.
template <class Message>
class Last {
public:
    Last(Node& node, const std::string& topic)
        : handle_(node.subscribe(topic, Message::kType, {}, [this](const Bytes& bytes) {
              const std::lock_guard lock(mutex_);
              bytes_ = bytes;
          })) {}
    Message wait() {
        EXPECT_TRUE(soon(
            [this] {
                const std::lock_guard lock(mutex_);
                return !bytes_.empty();
            },
            30));
        const std::lock_guard lock(mutex_);
        const auto read = decode<Message>(bytes_);
        EXPECT_TRUE(read);
        const Bytes again = encode(read.value_or(Message()));
        EXPECT_LT(bytes_.size(), again.size() + 4);  // no more than what fills the last four bytes
        bytes_.resize(again.size());
        EXPECT_EQ(again, bytes_);
        return read.value_or(Message());
    }

private:
    std::mutex mutex_;
    Bytes bytes_;
    Handle handle_;  ///< last: gone first
};

TEST_F(Ros2Flight, TellsAsManyRotorsAsThereAre) {
    Process vehicle("vehicle_node", {"scenario:=perch_concrete", "vehicle:=perching_hexa"});
    node_ = std::make_unique<Node>(read_settings("watch", {}));
    Last<limpet_msgs::RotorCommand> commands(*node_, "/limpet/rotor_command");
    Last<limpet_msgs::VehicleTruth> truths(*node_, "/limpet/truth/vehicle");
    const limpet_msgs::RotorCommand command = commands.wait();
    EXPECT_EQ(command.command.size(), 6U);
    EXPECT_EQ(command.armed, 1);
    const limpet_msgs::VehicleTruth truth = truths.wait();
    ASSERT_EQ(truth.rotor_speed_rad_s.size(), 6U);
    EXPECT_GT(truth.rotor_speed_rad_s[5], 100.0);  // it hovers
    EXPECT_GT(truth.battery_remaining, 0.9);       // the last field
    EXPECT_LE(truth.battery_remaining, 1.0);
    EXPECT_EQ(vehicle.end(), 0);
}

}  // namespace
}  // namespace limpet::ros2
