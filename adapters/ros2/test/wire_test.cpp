// SPDX-License-Identifier: Apache-2.0
// The node on the wire, held against another DDS library with types of its own making.
#include <geometry_msgs/PoseStamped.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limpet_ros/State.h>
#include <rcl_interfaces/GetParameters.h>
#include <rcl_interfaces/ListParameters.h>
#include <rcl_interfaces/SetParameters.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <set>

#include "adapters/ros2/dds/node.hpp"
#include "adapters/ros2/dds/parameters.hpp"
#include "adapters/ros2/test/peer.hpp"
#include "peer.h"

namespace limpet::ros2 {
namespace {

constexpr const char* kPoseTopic = "rt/limpet/pose";
using PeerPose = geometry_msgs_msg_dds__PoseStamped_;
using PeerString = std_msgs_msg_dds__String_;
using PeerInfo = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
using PeerRequest = std_srvs_srv_dds__Trigger_Request_;
using PeerResponse = std_srvs_srv_dds__Trigger_Response_;

geometry_msgs::PoseStamped pose() {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = ::ros::Time(12.25);
    pose.header.frame_id = "map";
    pose.pose.position.x = 1.5;
    pose.pose.position.y = -2.5;
    pose.pose.position.z = 1e-3;
    pose.pose.orientation.z = 0.6;
    pose.pose.orientation.w = 0.8;
    return pose;
}

class Ros2Wire : public testing::Test {
protected:
    NodeSettings settings(const char* name) const {
        NodeSettings settings{.name = name};
        settings.domain = domain_;
        return settings;
    }
    /// Nobody else's, most probably.
    int domain_ = 1 + static_cast<int>(getpid() % 100);
    Peer peer_{domain_};
};

TEST_F(Ros2Wire, ThePeerReadsAPose) {
    Node node(settings("limpet"));
    const auto writer =
        node.advertise("/limpet/pose", geometry_msgs::PoseStamped::kType, kSensorData);
    const dds_entity_t reader =
        peer_.reader(kPoseTopic, geometry_msgs_msg_dds__PoseStamped__desc, {.reliable = false});
    ASSERT_TRUE(soon([&] { return Peer::has_writer(reader); }));
    bool received = false;
    EXPECT_TRUE(soon([&] {
        writer->write(encode(pose()));  // best effort: until one arrives
        Peer::take<PeerPose>(reader, [&](const PeerPose& read) {
            received = true;
            EXPECT_EQ(read.header.stamp.sec, 12);
            EXPECT_EQ(read.header.stamp.nanosec, 250'000'000U);
            EXPECT_STREQ(read.header.frame_id, "map");
            EXPECT_EQ(read.pose.position.x, 1.5);
            EXPECT_EQ(read.pose.position.y, -2.5);
            EXPECT_EQ(read.pose.position.z, 1e-3);
            EXPECT_EQ(read.pose.orientation.x, 0.0);
            EXPECT_EQ(read.pose.orientation.z, 0.6);
            EXPECT_EQ(read.pose.orientation.w, 0.8);
        });
        return received;
    }));
}

TEST_F(Ros2Wire, ThePeersPoseIsRead) {
    Node node(settings("limpet"));
    std::mutex mutex;
    std::optional<geometry_msgs::PoseStamped> received;
    const auto subscription = node.subscribe(
        "/limpet/pose", geometry_msgs::PoseStamped::kType, kSensorData, [&](const Bytes& bytes) {
            const std::lock_guard lock(mutex);
            received = decode<geometry_msgs::PoseStamped>(bytes);
        });
    const dds_entity_t writer =
        peer_.writer(kPoseTopic, geometry_msgs_msg_dds__PoseStamped__desc, {.reliable = true});
    ASSERT_TRUE(soon([&] { return Peer::has_reader(writer); }));
    char frame[] = "a frame of another length";
    const PeerPose sent{.header = {.stamp = {.sec = 7, .nanosec = 8}, .frame_id = frame},
                        .pose = {.position = {1, 2, 3}, .orientation = {0.5, -0.5, 0.5, -0.5}}};
    EXPECT_TRUE(soon([&] {
        dds_write(writer, &sent);
        const std::lock_guard lock(mutex);
        return received.has_value();
    }));
    EXPECT_EQ(received->header.stamp.sec, 7);
    EXPECT_EQ(received->header.stamp.nsec, 8U);
    EXPECT_EQ(received->header.frame_id, frame);
    EXPECT_EQ(received->pose.position.z, 3.0);
    EXPECT_EQ(received->pose.orientation.w, -0.5);
}

TEST_F(Ros2Wire, WhatStaysIsToldToWhoComesLater) {
    Node node(settings("limpet"));
    const auto writer = node.advertise("/robot_description", std_msgs::String::kType, kLatched);
    std_msgs::String description;
    description.data = std::string(200'000, 'x');  // over many datagrams
    writer->write(encode(description));
    const dds_entity_t reader = peer_.reader("rt/robot_description", std_msgs_msg_dds__String__desc,
                                             {.reliable = true, .stays = true});
    std::size_t size = 0;
    EXPECT_TRUE(soon([&] {
        Peer::take<PeerString>(reader,
                               [&](const PeerString& read) { size = std::strlen(read.data); });
        return size > 0;
    }));
    EXPECT_EQ(size, description.data.size());
}

TEST_F(Ros2Wire, WhatThePeerToldBeforeIsHeard) {
    const dds_entity_t writer = peer_.writer("rt/mavros/state", mavros_msgs_msg_dds__State__desc,
                                             {.reliable = true, .stays = true});
    char map[] = "", mode[] = "AUTO.LOITER";
    const mavros_msgs_msg_dds__State_ sent{.header = {.stamp = {1, 0}, .frame_id = map},
                                           .connected = true,
                                           .armed = true,
                                           .guided = false,
                                           .manual_input = false,
                                           .mode = mode,
                                           .system_status = 4};
    dds_write(writer, &sent);
    Node node(settings("limpet"));
    std::mutex mutex;
    std::vector<limpet_ros::State> received;
    const auto subscription = node.subscribe(
        "/mavros/state", limpet_ros::State::kType, kLatched, [&](const Bytes& bytes) {
            const std::lock_guard lock(mutex);
            received.push_back(decode<limpet_ros::State>(bytes).value());
        });
    ASSERT_TRUE(soon([&] {
        const std::lock_guard lock(mutex);
        return !received.empty();
    }));
    EXPECT_EQ(received[0].mode, mode);
    EXPECT_EQ(received[0].armed, 1);
    EXPECT_EQ(received[0].guided, 0);
    EXPECT_EQ(received[0].system_status, 4);
}

TEST_F(Ros2Wire, AReliableReaderIsNotPromisedWhatIsSentOnce) {
    Node node(settings("limpet"));
    const auto writer =
        node.advertise("/limpet/pose", geometry_msgs::PoseStamped::kType, kSensorData);
    const dds_entity_t reliable =
        peer_.reader(kPoseTopic, geometry_msgs_msg_dds__PoseStamped__desc, {.reliable = true});
    const dds_entity_t once =
        peer_.reader(kPoseTopic, geometry_msgs_msg_dds__PoseStamped__desc, {.reliable = false});
    ASSERT_TRUE(soon([&] { return Peer::has_writer(once); }));
    EXPECT_FALSE(Peer::has_writer(reliable));
}

TEST_F(Ros2Wire, TheDiscoveryInfoNamesTheNodeAndItsTopics) {
    NodeSettings of_node = settings("perching_node");
    of_node.space = "/uav1";
    Node node(of_node);
    const auto writer =
        node.advertise("/uav1/limpet/pose", geometry_msgs::PoseStamped::kType, kSensorData);
    const auto subscription = node.subscribe("/uav1/mavros/state", limpet_ros::State::kType,
                                             kLatched, [](const Bytes&) {});
    const auto service =
        node.serve("/uav1/perching_node/perch", std_srvs::TriggerRequest::kType,
                   std_srvs::TriggerResponse::kType, [](const Bytes&, const Node::Reply&) {});
    const dds_entity_t infos =
        peer_.reader("ros_discovery_info", rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
                     {.reliable = true, .stays = true});
    const dds_entity_t publications = peer_.discovers(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
    const dds_entity_t subscriptions = peer_.discovers(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
    Peer::Endpoints writers, readers;
    std::set<std::pair<std::string, std::string>> written, read;
    std::string name, space;
    EXPECT_TRUE(soon([&] {
        Peer::discovered(publications, writers);
        Peer::discovered(subscriptions, readers);
        Peer::take<PeerInfo>(infos, [&](const PeerInfo& info) {
            written.clear();
            read.clear();
            ASSERT_EQ(info.node_entities_info_seq._length, 1U);
            const auto& reported = info.node_entities_info_seq._buffer[0];
            name = reported.node_name;
            space = reported.node_namespace;
            const auto names = [](const auto& gids, const auto& known, auto& into) {
                for (std::uint32_t i = 0; i < gids._length; ++i) {
                    std::array<std::uint8_t, 16> key{};
                    std::copy_n(gids._buffer[i].data, key.size(), key.begin());
                    const auto found = known.find(key);
                    if (found != known.end()) {
                        into.emplace(found->second.topic, found->second.type);
                    }
                }
            };
            names(reported.writer_gid_seq, writers, written);
            names(reported.reader_gid_seq, readers, read);
        });
        const auto again = node.advertise("/again", std_msgs::String::kType, {});  // another info
        return written.size() >= 2 && read.size() >= 2;
    }));
    EXPECT_EQ(name, "perching_node");
    EXPECT_EQ(space, "/uav1");
    using Known = std::pair<std::string, std::string>;
    EXPECT_TRUE(
        written.contains(Known("rt/uav1/limpet/pose", "geometry_msgs::msg::dds_::PoseStamped_")));
    EXPECT_TRUE(written.contains(
        Known("rr/uav1/perching_node/perchReply", "std_srvs::srv::dds_::Trigger_Response_")));
    EXPECT_TRUE(read.contains(Known("rt/uav1/mavros/state", "mavros_msgs::msg::dds_::State_")));
    EXPECT_TRUE(read.contains(
        Known("rq/uav1/perching_node/perchRequest", "std_srvs::srv::dds_::Trigger_Request_")));
}

/// Serves as std_srvs/Trigger, and counts the calls.
Handle serve_trigger(Node& node, std::atomic<int>& calls) {
    return node.serve("/limpet/perch", std_srvs::TriggerRequest::kType,
                      std_srvs::TriggerResponse::kType,
                      [&calls](const Bytes& bytes, const Node::Reply& reply) {
                          EXPECT_TRUE(decode<std_srvs::TriggerRequest>(bytes));
                          std_srvs::TriggerResponse response;
                          response.success = 1;
                          response.message = "begins " + std::to_string(++calls);
                          reply(encode(response));
                      });
}

TEST_F(Ros2Wire, ANodesServiceAnswersAnother) {
    Node server(settings("server")), first(settings("first")), second(settings("second"));
    std::atomic<int> calls = 0;
    const auto service = serve_trigger(server, calls);
    const auto of = [](Node& node) {
        return node.client("/limpet/perch", std_srvs::TriggerRequest::kType,
                           std_srvs::TriggerResponse::kType);
    };
    const auto one = of(first), other = of(second);
    for (int turn = 1; turn <= 6; ++turn) {
        std::optional<Bytes> answer;
        ASSERT_TRUE(soon([&] {
            answer = (turn % 2 == 1 ? one : other)->call(encode(std_srvs::TriggerRequest()), 5.0);
            return answer.has_value();
        }));
        EXPECT_EQ(decode<std_srvs::TriggerResponse>(*answer)->message,
                  "begins " + std::to_string(turn));
    }
    const auto nobody = first.client("/limpet/nothing", std_srvs::TriggerRequest::kType,
                                     std_srvs::TriggerResponse::kType);
    EXPECT_FALSE(nobody->call(encode(std_srvs::TriggerRequest()), 5.0));
}

template <class Service>
typename Service::Response called(Node& node, const std::string& name,
                                  const typename Service::Request& request) {
    const auto client = node.client(name, Service::Request::kType, Service::Response::kType);
    std::optional<Bytes> answer;
    EXPECT_TRUE(soon([&] {
        answer = client->call(encode(request), 5.0);
        return answer.has_value();
    })) << name;
    return decode<typename Service::Response>(answer.value()).value();
}

TEST_F(Ros2Wire, ParametersAreAskedForByService) {
    NodeSettings reported =
        read_settings("vehicle_node", {"--ros-args", "-p", "speed:=2.5", "-p", "seed:=7", "-p",
                                       "use_sim_time:=true", "-p", "scenario:=perch_concrete"});
    reported.domain = domain_;
    Node node(reported), other(settings("other"));
    const auto services = serve_parameters(node);
    using namespace rcl_interfaces;
    EXPECT_THAT(called<ListParameters>(other, "/vehicle_node/list_parameters", {}).result.names,
                testing::ElementsAre("speed", "seed", "use_sim_time", "scenario"));
    GetParametersRequest names;
    names.names = {"speed", "seed", "use_sim_time", "scenario", "nothing"};
    const auto values = called<GetParameters>(other, "/vehicle_node/get_parameters", names).values;
    ASSERT_EQ(values.size(), 5U);
    EXPECT_EQ(values[0].double_value, 2.5);
    EXPECT_EQ(values[0].type, ParameterValue::PARAMETER_DOUBLE);
    EXPECT_EQ(values[1].integer_value, 7);
    EXPECT_EQ(values[2].bool_value, 1);
    EXPECT_EQ(values[3].string_value, "perch_concrete");
    EXPECT_EQ(values[4].type, ParameterValue::PARAMETER_NOT_SET);
    SetParametersRequest set;
    set.parameters.resize(1);
    const auto results = called<SetParameters>(other, "/vehicle_node/set_parameters", set).results;
    ASSERT_EQ(results.size(), 1U);
    EXPECT_FALSE(results[0].successful);
    EXPECT_EQ(results[0].reason, "parameters are read once, when the node starts");
}

TEST_F(Ros2Wire, ThePeerCallsAServiceInCyclonesWay) {
    NodeSettings way = settings("limpet");
    way.services = ServiceWay::cyclone;
    Node node(way);
    std::atomic<int> calls = 0;
    const auto service = serve_trigger(node, calls);
    const dds_entity_t requests =
        peer_.writer("rq/limpet/perchRequest", std_srvs_srv_dds__Trigger_Request__desc, {});
    const dds_entity_t replies =
        peer_.reader("rr/limpet/perchReply", std_srvs_srv_dds__Trigger_Response__desc, {});
    ASSERT_TRUE(soon([&] { return Peer::has_reader(requests) && Peer::has_writer(replies); }));
    const PeerRequest request{
        .client = 0x1122334455667788U, .number = 42, .structure_needs_at_least_one_member = 0};
    bool received = false;
    EXPECT_TRUE(soon([&] {
        dds_write(requests, &request);  // again, where the reply came before its reader was known
        Peer::take<PeerResponse>(replies, [&](const PeerResponse& response) {
            received = true;
            EXPECT_EQ(response.client, request.client);
            EXPECT_EQ(response.number, request.number);
            EXPECT_TRUE(response.success);
            EXPECT_THAT(response.message, testing::StartsWith("begins"));
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return received;
    }));
}

TEST_F(Ros2Wire, ThePeersServiceIsCalledInCyclonesWay) {
    NodeSettings way = settings("limpet");
    way.services = ServiceWay::cyclone;
    Node node(way);
    const auto client = node.client("/limpet/perch", std_srvs::TriggerRequest::kType,
                                    std_srvs::TriggerResponse::kType);
    const dds_entity_t replies =
        peer_.writer("rr/limpet/perchReply", std_srvs_srv_dds__Trigger_Response__desc, {});
    const dds_entity_t requests =
        peer_.reader("rq/limpet/perchRequest", std_srvs_srv_dds__Trigger_Request__desc, {});
    std::jthread server([&](const std::stop_token& over) {
        char text[] = "not ready";
        while (!over.stop_requested()) {
            Peer::take<PeerRequest>(requests, [&](const PeerRequest& request) {
                const PeerResponse others{.client = request.client + 1,
                                          .number = request.number,
                                          .success = true,
                                          .message = text};
                dds_write(replies, &others);  // somebody else's
                const PeerResponse response{.client = request.client,
                                            .number = request.number,
                                            .success = false,
                                            .message = text};
                dds_write(replies, &response);
            });
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    });
    std::optional<Bytes> answer;
    ASSERT_TRUE(soon([&] {
        answer = client->call(encode(std_srvs::TriggerRequest()), 0.3);
        return answer.has_value();
    }));
    const auto response = decode<std_srvs::TriggerResponse>(*answer);
    ASSERT_TRUE(response);
    EXPECT_EQ(response->success, 0);
    EXPECT_EQ(response->message, "not ready");
}

}  // namespace
}  // namespace limpet::ros2
