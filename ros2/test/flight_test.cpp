// SPDX-License-Identifier: Apache-2.0
// Vehicle, cup and guidance as three processes that speak ROS 2, commanded by services and watched
// by another DDS library.
#include <gtest/gtest.h>
#include <limpet_ros/PerchingStatus.h>
#include <spawn.h>
#include <std_srvs/Trigger.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <mutex>

#include "peer.h"
#include "ros2/dds/node.hpp"
#include "ros2/test/peer.hpp"

namespace limpet::ros2 {
namespace {

/// A node's process; ends with this.
class Process {
public:
    Process(const std::string& program, std::vector<std::string> parameters) {
        std::vector<std::string> words = {program, "--ros-args"};
        for (std::string& parameter : parameters) {
            words.insert(words.end(), {"-p", std::move(parameter)});
        }
        std::vector<char*> arguments;
        for (std::string& word : words) {
            arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        const std::string path = std::string(LIMPET_ROS2_NODES) + "/" + program;
        require(posix_spawn(&id_, path.c_str(), nullptr, nullptr, arguments.data(), environ) == 0,
                "a node starts");
    }
    ~Process() { static_cast<void>(end()); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// @return its exit code after Ctrl-C, -1 when it did not end well
    int end() {
        if (id_ == 0) {
            return -1;
        }
        kill(id_, SIGINT);
        int status = 0;
        waitpid(std::exchange(id_, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    pid_t id_ = 0;
};

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

    int domain_ = 1 + static_cast<int>(getpid() % 100);
    std::unique_ptr<Node> node_;
    std::mutex mutex_;
    limpet_ros::PerchingStatus status_;
};

TEST_F(Ros2Flight, PerchesRestsAndTakesOffByService) {
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

    const auto leaves = call("/perching_node/take_off");
    ASSERT_TRUE(leaves.success) << leaves.message;
    EXPECT_TRUE(status_is(120, [](const auto& s) { return s.outcome == "released"; }));
    EXPECT_EQ(guidance.end(), 0);
    EXPECT_EQ(cup.end(), 0);
    EXPECT_EQ(vehicle.end(), 0);
}

}  // namespace
}  // namespace limpet::ros2
