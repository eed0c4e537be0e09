// SPDX-License-Identifier: Apache-2.0
// Hashes of types (REP 2011), as another DDS library reads them from our endpoints. The numbers are
// those of ROS 2 Jazzy: what rosidl makes of its own definitions, and of ours (packages.py).
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <limpet_ros/PerchingAction.h>
#include <limpet_ros/State.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>

#include "adapters/ros2/dds/node.hpp"
#include "adapters/ros2/test/peer.hpp"

namespace limpet::ros2 {
namespace {

using UserData = std::map<std::string, std::string>;  ///< user data, by topics

UserData reported(dds_entity_t discovers, std::size_t count) {
    Peer::Endpoints found;
    EXPECT_TRUE(soon([&] {
        Peer::discovered(discovers, found);
        return found.size() >= count;
    }));
    UserData reported;
    for (const auto& [key, endpoint] : found) {
        reported[endpoint.topic] = endpoint.user_data;
    }
    return reported;
}

TEST(Ros2TypeHash, IsToldByReadersAndWriters) {
    NodeSettings settings{.name = "limpet"};
    settings.domain = 1 + static_cast<int>(getpid() % 100);
    Peer peer(settings.domain);
    Node node(settings);
    using Feedback = limpet_ros::PerchingAction::FeedbackMessage;
    const auto pose = node.advertise("/pose", geometry_msgs::PoseStamped::kType, kSensorData);
    const auto feedback = node.advertise("/feedback", Feedback::kType, {});
    const auto no_type = node.advertise("/other", "other_msgs::msg::dds_::Other_", {});
    const auto state =
        node.subscribe("/state", limpet_ros::State::kType, kLatched, [](const Bytes&) {});
    const auto service =
        node.serve("/perch", std_srvs::TriggerRequest::kType, std_srvs::TriggerResponse::kType,
                   [](const Bytes&, const Node::Reply&) {});

    const std::string of_trigger =
        "typehash=RIHS01_eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f;";
    const UserData written = reported(peer.discovers(DDS_BUILTIN_TOPIC_DCPSPUBLICATION), 5);
    EXPECT_EQ(written.at("rt/pose"),
              "typehash=RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8;");
    EXPECT_EQ(written.at("rt/feedback"),
              "typehash=RIHS01_af6ea666e04f424347f7460cd8dd77134346a6f10b2497e12626f21726d47e56;");
    EXPECT_EQ(written.at("rr/perchReply"), of_trigger);
    EXPECT_NE(written.at("ros_discovery_info"), "");
    EXPECT_EQ(written.at("rt/other"), "");

    const UserData read = reported(peer.discovers(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION), 2);
    EXPECT_EQ(read.at("rt/state"),
              "typehash=RIHS01_11ba7686163d22281871f1cb42557e8957407469b0be813bdb1a8922c66e3131;");
    EXPECT_EQ(read.at("rq/perchRequest"), of_trigger);
}

}  // namespace
}  // namespace limpet::ros2
